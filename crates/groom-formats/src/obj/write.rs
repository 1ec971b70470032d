//! A groom as Wavefront OBJ lines.

use std::io::Write;

use groom::{Groom, UpAxis, names};

use crate::blocks::{self, strands_among};
use crate::drawable::Drawable;
use crate::numbers::Text;
use crate::{Format, FormatError, Warning, WriteOptions, unstored};

pub(crate) fn write(
    groom: &Groom,
    stream: &mut impl Write,
    name: &str,
    _options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let mut warnings = Vec::new();
    Drawable::new(groom, Format::Obj, name, &mut warnings)?;
    // The unit and the axis are in comments; that other readers take y for up is told all the same.
    let unsaid = unstored::axis_and_unit(groom, Format::Obj, UpAxis::Y);
    warnings.extend(unsaid.into_iter().filter(|w| matches!(w, Warning::UpAxisNotStored { .. })));
    unstored::left_out(groom, Format::Obj, &[names::COLOR], &mut warnings);
    let colors = groom.colors();
    let written = stream.write_all(header(groom).as_bytes()).and_then(|()| {
        blocks::write(stream, groom.point_count(), |text, points| {
            for (strand, points) in strands_among(groom, points) {
                let all = groom.strand_range(strand);
                for vertex in points.clone() {
                    text.push(b"v ");
                    text.floats(&groom.positions()[vertex].to_array(), b" ");
                    if let Some(colors) = colors {
                        text.push(b" ");
                        text.floats(&colors.get(strand, vertex).to_array(), b" ");
                    }
                    text.push(b"\n");
                }
                // A strand of one point is a vertex in no line, so that the numbers stay simple.
                if points.end == all.end && all.len() > 1 {
                    push_line(text, all.start + 1..=all.end);
                }
            }
        })
    });
    written.map_err(|e| FormatError::io(name, e))?;
    Ok(warnings)
}

fn header(groom: &Groom) -> String {
    let axis = match groom.up_axis {
        UpAxis::Y => "y",
        UpAxis::Z => "z",
    };
    let (version, unit) = (env!("CARGO_PKG_VERSION"), groom.meters_per_unit);
    format!("# Written by groomkit {version}\n# up_axis {axis}\n# meters_per_unit {unit}\n")
}

fn push_line(text: &mut Text, vertices: std::ops::RangeInclusive<usize>) {
    text.push(b"l");
    for vertex in vertices {
        text.push(b" ");
        text.integer(vertex as u64);
    }
    text.push(b"\n");
}
