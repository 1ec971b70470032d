//! Prims of curves as one groom.

use glam::Vec3;
use groom::{Attribute, Groom, names};

use super::attribute;
use super::curves::Curves;
use super::stage::Stage;
use crate::join::{self, Part};
use crate::polylines::Polylines;
use crate::{FormatError, Warning};

pub(super) fn merge<B: AsRef<[u8]>>(
    stage: &Stage<B>,
    time: Option<f64>,
    warnings: &mut Vec<Warning>,
) -> Result<(Groom, Vec<Polylines>), FormatError> {
    let file = &*stage.context.file;
    let (mut parts, mut cuts) = (Vec::new(), Vec::new());
    let mut positions: Vec<Vec3> = Vec::new();
    for place in &stage.curves {
        let (curves, points) = Curves::read(stage, place, time, None)?;
        let attributes = attribute::all(&curves, warnings)?.into_iter().collect();
        if let Some(error) = curves.polylines.coarser {
            warnings.push(Warning::CurvesCoarser { error });
        }
        parts.push(Part {
            strand_lens: curves.polylines.strand_lens().collect(),
            points: points.len(),
            attributes,
        });
        // The first prim, often the only one, gives its points away.
        if positions.is_empty() {
            positions = points
        } else {
            positions.extend(points)
        }
        cuts.push(curves.polylines);
    }
    let take = |name: &str, count, size| {
        let taken = stage.context.room.take(count, size);
        taken.map_err(|(found, expected)| {
            FormatError::invalid(file, format!("attribute `{name}`"), found, expected)
        })
    };
    let mut groom = join::groom(parts, positions, stage.context.format, file, &take, warnings)?;
    if groom.attribute(names::RADIUS).is_none() {
        warnings.push(Warning::NoRadius { radius: groom::DEFAULT_RADIUS });
        let radius = Attribute::constant_float(groom::DEFAULT_RADIUS);
        groom.set_attribute(names::RADIUS, radius).map_err(|error| FormatError::groom(file, error))?;
    }
    Ok((groom, cuts))
}
