//! A groom as text.

use std::io::Write;

use glam::Vec3;
use groom::{Attribute, FloatView, Groom, UpAxis, Vec3View, names};

use crate::numbers::TextOut;
use crate::{Format, FormatError, Warning, unstored};

/// What follows the position on a line, each with its leading space.
enum Column<'a> {
    /// The same everywhere: turned into text once.
    Constant(Vec<u8>),
    Float(FloatView<'a>),
    Color(Vec3View<'a>),
}

pub(crate) fn write(groom: &Groom, stream: &mut impl Write, file: &str) -> Result<Vec<Warning>, FormatError> {
    if groom.strand_count() == 0 {
        return Err(FormatError::Empty { file: file.to_owned(), format: Format::Text, points: 1 });
    }
    let mut warnings = unstored::warnings(groom, Format::Text, UpAxis::Z);
    let columns = columns(groom, &mut warnings);
    let mut out = TextOut::new(stream);
    for strand in 0..groom.strand_count() {
        if strand > 0 {
            out.push(b"\n");
        }
        for vertex in groom.strand_range(strand) {
            out.floats(&groom.positions()[vertex].to_array(), b" ");
            for column in &columns {
                column.push(&mut out, strand, vertex);
            }
            out.push(b"\n");
            out.hand_on().map_err(|e| FormatError::io(file, e))?;
        }
    }
    out.finish().map_err(|e| FormatError::io(file, e))?;
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
    fn push<W: Write>(&self, out: &mut TextOut<'_, W>, strand: usize, vertex: usize) {
        match self {
            Column::Constant(text) => out.push(text),
            Column::Float(view) => {
                out.push(b" ");
                out.float(view.get(strand, vertex));
            }
            Column::Color(view) => {
                out.push(b" ");
                out.floats(&view.get(strand, vertex).to_array(), b" ");
            }
        }
    }
}

fn as_text(values: &[f32]) -> Vec<u8> {
    let mut text = Vec::new();
    let mut out = TextOut::new(&mut text);
    for &value in values {
        out.push(b" ");
        out.float(value);
    }
    // Writing to memory cannot fail.
    let _ = out.finish();
    text
}
