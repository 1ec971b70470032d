//! The groom as every later step sees it: read or made up, then changed as the pipeline says.

use std::path::Path;

use glam::Vec3;
use groom::{Attribute, Domain, Groom, Values, names};
use groom_formats::ReadOptions;
use hair_render::Motion;

use super::fur;
use crate::schema::{Attributes, Axis, GroomSource, Pipeline, SampleSource, Style};
use crate::{Event, Reporter, TurntableError};

/// Reads or makes the groom.
pub(crate) fn groom(
    pipeline: &Pipeline,
    base: &Path,
    reporter: &dyn Reporter,
) -> Result<Groom, TurntableError> {
    let (source, attributes) = (&pipeline.groom, &pipeline.attributes);
    let mut groom = match (&source.file, &source.sample) {
        (Some(file), _) => read(&base.join(file), source, reporter)?,
        (None, Some(sample)) if sample.style == Style::Fur => fur::grown(sample, pipeline, base)?,
        (None, sample) => make(&sample.clone().unwrap_or_default())?,
    };
    if source.file.is_none() {
        // A made-up groom knows its own unit and axis; the pipeline may still say otherwise.
        groom.up_axis = source.up.map_or(groom.up_axis, up_axis);
        groom.meters_per_unit = source.meters_per_unit.unwrap_or(groom.meters_per_unit);
    }
    change(groom, attributes)
}

pub(crate) fn up_axis(axis: Axis) -> groom::UpAxis {
    match axis {
        Axis::Y => groom::UpAxis::Y,
        Axis::Z => groom::UpAxis::Z,
    }
}

fn read(path: &Path, source: &GroomSource, reporter: &dyn Reporter) -> Result<Groom, TurntableError> {
    let loaded = groom_formats::read(path, &read_options(source))?;
    for warning in &loaded.warnings {
        reporter.event(&Event::Warning(&format!("{}: {warning}", path.display())));
    }
    Ok(loaded.groom)
}

/// What a pipeline says of its groom's file.
pub(super) fn read_options(source: &GroomSource) -> ReadOptions {
    ReadOptions {
        up_axis: source.up.map(up_axis),
        meters_per_unit: source.meters_per_unit,
        repair: source.repair,
        ..ReadOptions::default()
    }
}

fn make(sample: &SampleSource) -> Result<Groom, TurntableError> {
    let style = match sample.style {
        Style::Straight => groom_samples::Style::Straight,
        Style::Wavy => groom_samples::Style::Wavy,
        Style::Curly | Style::Fur => groom_samples::Style::Curly,
    };
    let SampleSource { strands, points, seed, .. } = *sample;
    let options =
        groom_samples::Options { style, strands, points, seed, ..groom_samples::Options::default() };
    groom_samples::hair(&options).map_err(|error| TurntableError::Sample(error.to_string()))
}

/// The same changes made to a groom that moves: its keys lose the same strands and grow by the same factor.
pub(super) fn change_moving(
    mut groom: Groom,
    motion: &Motion,
    attributes: &Attributes,
) -> Result<(Groom, Motion), TurntableError> {
    let name = |key: usize| format!("turntable:key {key}");
    let keys = if motion.moves() { motion.positions() } else { &[] };
    // As attributes they go where their points go.
    for (key, positions) in keys.iter().enumerate() {
        let values = Values::Vec3(positions.clone());
        groom.set_attribute(name(key), Attribute { domain: Domain::Vertex, values })?;
    }
    let mut groom = change(groom, attributes)?;
    let factor = attributes.scale.unwrap_or(1.0);
    let taken = (0..keys.len()).filter_map(|key| match groom.remove_attribute(&name(key))?.values {
        Values::Vec3(positions) => Some(positions.into_iter().map(|position| position * factor).collect()),
        _ => None,
    });
    let taken: Vec<Vec<Vec3>> = taken.collect();
    let motion = if taken.is_empty() { Motion::STILL } else { Motion::keys(taken)? };
    Ok((groom, motion))
}

/// Thins before it dresses: what is left out is not worked on.
fn change(mut groom: Groom, attributes: &Attributes) -> Result<Groom, TurntableError> {
    if let Some(stride) = attributes.stride {
        groom = groom.subsample_by_stride(stride)?;
    }
    if let Some(most) = attributes.max_strands {
        groom = groom.subsample_to(most);
    }
    if let Some(color) = attributes.color {
        set_color(&mut groom, Vec3::from_array(color), attributes.color_variation)?;
    }
    if let Some([root, tip]) = attributes.color_ramp {
        groom.ramp_color(Vec3::from_array(root), Vec3::from_array(tip))?;
    }
    if let Some(width) = attributes.width {
        groom.set_width(width)?;
    }
    if let Some([root, tip]) = attributes.width_ramp {
        groom.ramp_width(root, tip)?;
    }
    if let Some(factor) = attributes.scale {
        groom.scale(factor)?;
    }
    Ok(groom)
}

/// One colour, or one a strand spread about it by up to `variation` stops to either side.
fn set_color(groom: &mut Groom, color: Vec3, variation: Option<f32>) -> Result<(), TurntableError> {
    let Some(stops) = variation else { return Ok(groom.set_color(color)?) };
    let shade = |strand| {
        let lot = groom::random(0, groom.strand_id(strand), "color variation");
        (color * (stops * (2.0 * lot - 1.0)).exp2()).clamp(Vec3::ZERO, Vec3::ONE)
    };
    let values = Values::Vec3((0..groom.strand_count()).map(shade).collect());
    Ok(groom.set_attribute(names::COLOR, Attribute { domain: Domain::Strand, values })?)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn strands(count: u32) -> Groom {
        let points = (0..count * 3).map(|i| Vec3::new(i as f32, (i % 3) as f32, 0.0)).collect();
        Groom::new((0..=count).map(|i| i * 3).collect(), points).unwrap()
    }

    #[test]
    fn changes_add_up_in_their_order() {
        let attributes = Attributes {
            stride: Some(2),
            max_strands: Some(10),
            width_ramp: Some([2.0, 0.0]),
            scale: Some(3.0),
            color: Some([0.5, 0.25, 0.0]),
            color_variation: Some(0.5),
            ..Attributes::default()
        };
        let groom = change(strands(100), &attributes).unwrap();
        assert_eq!(groom.strand_count(), 10);
        assert_eq!((groom.radii().get(0, 0), groom.radii().get(0, 2)), (3.0, 0.0));
        let colors = groom.colors().unwrap();
        let reds: Vec<f32> = (0..10).map(|s| colors.get(s, 3 * s).x).collect();
        assert!(reds.iter().all(|r| (0.35..=0.708).contains(r)), "{reds:?}");
        assert!(reds.windows(2).any(|w| w[0] != w[1]));
        assert_eq!(colors.get(3, 9).y, 0.5 * reds[3]);
    }

    #[test]
    fn what_moves_is_thinned_and_scaled_along() {
        let groom = strands(10);
        let moved = |by: Vec3| groom.positions().iter().map(|p| *p + by).collect::<Vec<_>>();
        let motion = Motion::keys(vec![moved(Vec3::ZERO), moved(Vec3::Y), moved(Vec3::X)]).unwrap();
        let attributes =
            Attributes { stride: Some(3), max_strands: Some(2), scale: Some(2.0), ..Attributes::default() };
        let (thin, keys) = change_moving(groom.clone(), &motion, &attributes).unwrap();
        assert_eq!((thin.strand_count(), keys.key_count()), (2, 3));
        assert!(thin.attributes().all(|(name, _)| !name.contains("key")));
        for (key, by) in keys.positions().iter().zip([Vec3::ZERO, Vec3::Y, Vec3::X]) {
            let expected: Vec<Vec3> = thin.positions().iter().map(|p| *p + 2.0 * by).collect();
            assert_eq!(*key, expected);
        }
        let (_, still) = change_moving(groom, &Motion::STILL, &attributes).unwrap();
        assert_eq!(still.key_count(), 0);
    }

    #[test]
    fn nothing_asked_changes_nothing() {
        assert_eq!(change(strands(5), &Attributes::default()).unwrap(), strands(5));
    }
}
