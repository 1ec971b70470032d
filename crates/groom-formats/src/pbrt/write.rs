//! A groom as pbrt's curves.

use std::io::Write;

use groom::{FloatView, Groom, UpAxis, names};

use super::{material, span};
use crate::blocks::{self, strands_among};
use crate::drawable::Drawable;
use crate::numbers::Text;
use crate::{Format, FormatError, Warning, WriteOptions, unstored};

pub(crate) fn write(
    groom: &Groom,
    stream: &mut impl Write,
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let mut warnings = Vec::new();
    Drawable::new(groom, Format::Pbrt, name, &mut warnings)?;
    warnings.extend(unstored::axis_and_unit(groom, Format::Pbrt, UpAxis::Y));
    let material = material::statement(groom, options.look.as_ref(), &mut warnings);
    // A look has the colour's place.
    let held = if options.look.is_some() { &[names::RADIUS][..] } else { &[names::RADIUS, names::COLOR] };
    unstored::left_out(groom, Format::Pbrt, held, &mut warnings);
    let radii = groom.radii();
    let version = env!("CARGO_PKG_VERSION");
    let head = format!("# Written by groomkit {version}\nAttributeBegin\n{material}");
    let written = stream.write_all(head.as_bytes()).and_then(|()| {
        blocks::write(stream, groom.point_count(), |text, points| {
            for (strand, points) in strands_among(groom, points) {
                let all = groom.strand_range(strand);
                // The block that has the root writes the whole strand.
                if points.start == all.start && all.len() > 1 {
                    push_strand(text, groom, strand, radii);
                }
            }
        })?;
        stream.write_all(b"AttributeEnd\n")
    });
    written.map_err(|e| FormatError::io(name, e))?;
    Ok(warnings)
}

fn push_strand(text: &mut Text, groom: &Groom, strand: usize, radii: FloatView<'_>) {
    let (points, range) = (groom.strand(strand), groom.strand_range(strand));
    let width = |index: usize| (2.0 * radii.get(strand, range.start + index)).min(f32::MAX);
    let spans = points.len() - 1;
    let each = if span::is_even((0..points.len()).map(width)) { spans } else { 1 };
    for first in (0..spans).step_by(each) {
        text.push(
            b"Shape \"curve\" \"string type\" \"cylinder\" \"string basis\" \"bezier\" \"point3 P\" [ ",
        );
        for index in first..first + each {
            let controls = span::bezier(points, index);
            // Spans share their ends.
            let shared = usize::from(index > first);
            for point in &controls[shared..] {
                text.floats(&point.to_array(), b" ");
                text.push(b" ");
            }
        }
        text.push(b"] \"float width0\" [ ");
        text.float(width(first));
        text.push(b" ] \"float width1\" [ ");
        text.float(width(first + each));
        text.push(b" ]\n");
    }
}
