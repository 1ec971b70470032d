//! A groom as text.

use std::io::Write;

use glam::Vec3;
use groom::{Attribute, FloatView, Groom, UpAxis, Vec3View, names};

use crate::blocks::{self, strands_among};
use crate::numbers::Text;
use crate::{Format, FormatError, Warning, unstored};

/// What follows the position on a line, each with its leading space.
enum Column<'a> {
    /// The same everywhere: turned into text once.
    Constant(Text),
    Float(FloatView<'a>),
    Color(Vec3View<'a>),
}

pub(crate) fn write(groom: &Groom, stream: &mut impl Write, file: &str) -> Result<Vec<Warning>, FormatError> {
    if groom.strand_count() == 0 {
        return Err(FormatError::Empty { file: file.to_owned(), format: Format::Text, points: 1 });
    }
    write_strands(groom, true, stream, file)
}

/// Writes the strands of `groom`, which are the first of the file or follow others.
pub(crate) fn write_strands(
    groom: &Groom,
    first: bool,
    stream: &mut impl Write,
    file: &str,
) -> Result<Vec<Warning>, FormatError> {
    let mut warnings = unstored::warnings(groom, Format::Text, UpAxis::Z);
    let columns = columns(groom, &mut warnings);
    let written = blocks::write(stream, groom.point_count(), |text, points| {
        for (strand, points) in strands_among(groom, points) {
            // A blank line between strands; not where a block begins within one.
            let begins = points.start == groom.strand_range(strand).start;
            if begins && !(first && strand == 0) {
                text.push(b"\n");
            }
            for vertex in points {
                text.floats(&groom.positions()[vertex].to_array(), b" ");
                columns.iter().for_each(|column| column.push(text, strand, vertex));
                text.push(b"\n");
            }
        }
    });
    written.map_err(|e| FormatError::io(file, e))?;
    Ok(warnings)
}

fn columns<'a>(groom: &'a Groom, warnings: &mut Vec<Warning>) -> Vec<Column<'a>> {
    let transparency = groom
        .attribute(names::TRANSPARENCY)
        .and_then(Attribute::float_view)
        // Opaque is what a missing column means.
        .filter(|view| !matches!(view, FloatView::Constant(value) if value.to_bits() == 0));
    let mut colors = groom.colors();
    if transparency.is_some() && colors.is_none() {
        warnings.push(Warning::ColorMadeUp { format: Format::Text });
        colors = Some(Vec3View::Constant(Vec3::ONE));
    }
    let mut columns = vec![Column::float(groom.radii())];
    columns.extend(colors.map(Column::color));
    columns.extend(transparency.map(Column::float));
    columns
}

impl<'a> Column<'a> {
    fn float(view: FloatView<'a>) -> Self {
        match view {
            FloatView::Constant(value) => Column::Constant(as_text(&[value])),
            view => Column::Float(view),
        }
    }

    fn color(view: Vec3View<'a>) -> Self {
        match view {
            Vec3View::Constant(value) => Column::Constant(as_text(&value.to_array())),
            view => Column::Color(view),
        }
    }

    #[inline]
    fn push(&self, text: &mut Text, strand: usize, vertex: usize) {
        match self {
            Column::Constant(constant) => text.push(constant.as_bytes()),
            Column::Float(view) => {
                text.push(b" ");
                text.float(view.get(strand, vertex));
            }
            Column::Color(view) => {
                text.push(b" ");
                text.floats(&view.get(strand, vertex).to_array(), b" ");
            }
        }
    }
}

fn as_text(values: &[f32]) -> Text {
    let mut text = Text::new();
    for &value in values {
        text.push(b" ");
        text.float(value);
    }
    text
}
