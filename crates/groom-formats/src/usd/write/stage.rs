//! The stage and its curves, streamed.

use std::io::{self, Write};

use glam::Vec3;
use groom::{Groom, UpAxis};

use crate::drawable::Drawable;
use crate::numbers::{TextOut, shortest};
use crate::usd::write::primvar;
use crate::{Format, FormatError, Warning, WriteOptions};

/// Indentation of the attributes of the curves.
pub(super) const INDENT: &[u8] = b"        ";

pub(crate) fn write(
    groom: &Groom,
    stream: &mut impl Write,
    file: &str,
    _options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let mut warnings = Vec::new();
    let drawable = Drawable::new(groom, Format::Usda, file, &mut warnings)?;
    refuse_too_wide(drawable, file)?;
    let mut out = TextOut::new(stream);
    (|| {
        out.push(header(groom).as_bytes());
        curves(drawable, &mut out)?;
        primvar::write_all(drawable, &mut out, &mut warnings)?;
        out.push(b"    }\n}\n");
        out.finish()
    })()
    .map_err(|e: io::Error| FormatError::io(file, e))?;
    Ok(warnings)
}

fn header(groom: &Groom) -> String {
    let up = match groom.up_axis {
        UpAxis::Y => 'Y',
        UpAxis::Z => 'Z',
    };
    // A still groom has no time samples; the rate is the usual one of film.
    format!(
        r#"#usda 1.0
(
    defaultPrim = "Groom"
    doc = "Written by groomkit {version}"
    metersPerUnit = {unit}
    timeCodesPerSecond = 24
    upAxis = "{up}"
)

def Xform "Groom" (
    kind = "component"
)
{{
    def BasisCurves "Strands"
    {{
        uniform token type = "linear"
        uniform token basis = "catmullRom"
        uniform token wrap = "nonperiodic"
"#,
        version = env!("CARGO_PKG_VERSION"),
        unit = shortest(groom.meters_per_unit),
    )
}

fn curves<W: Write>(drawable: Drawable<'_>, out: &mut TextOut<'_, W>) -> io::Result<()> {
    let groom = drawable.groom;
    out.push(INDENT);
    out.push(b"int[] curveVertexCounts = [");
    for (place, (_, range)) in drawable.strands().enumerate() {
        separate(out, place, place.is_multiple_of(32));
        out.push(range.len().to_string().as_bytes());
        out.hand_on()?;
    }
    end_array(out, None);
    out.push(INDENT);
    out.push(b"point3f[] points = [");
    per_vertex(drawable, out, |out, _, vertex| tuple(out, &groom.positions()[vertex].to_array()))?;
    end_array(out, None);
    let radii = groom.radii();
    out.push(INDENT);
    out.push(b"float[] widths = [");
    per_vertex(drawable, out, |out, strand, vertex| out.float(2.0 * radii.get(strand, vertex)))?;
    end_array(out, Some("vertex"));
    let (min, max) = extent(drawable);
    out.push(INDENT);
    out.push(b"float3[] extent = [");
    tuple(out, &min.to_array());
    out.push(b", ");
    tuple(out, &max.to_array());
    out.push(b"]\n");
    Ok(())
}

/// Bounds of the points grown by half the largest width, as UsdGeomCurves computes it.
fn extent(drawable: Drawable<'_>) -> (Vec3, Vec3) {
    let radii = drawable.groom.radii();
    let (mut min, mut max, mut radius) = (Vec3::INFINITY, Vec3::NEG_INFINITY, 0.0_f32);
    for (strand, vertex) in drawable.vertices() {
        let point = drawable.groom.positions()[vertex];
        min = min.min(point);
        max = max.max(point);
        radius = radius.max(radii.get(strand, vertex));
    }
    (min - radius, max + radius)
}

/// Widths and the extent must be finite too, or the file would hold `inf`.
fn refuse_too_wide(drawable: Drawable<'_>, file: &str) -> Result<(), FormatError> {
    let radii = drawable.groom.radii();
    let (min, max) = extent(drawable);
    let widths = drawable.vertices().all(|(strand, vertex)| (2.0 * radii.get(strand, vertex)).is_finite());
    if widths && min.is_finite() && max.is_finite() && drawable.groom.meters_per_unit.is_finite() {
        return Ok(());
    }
    let what = "holds widths and an extent, and this groom's leave 32-bit floats";
    Err(FormatError::Unsupported { file: file.to_owned(), format: Format::Usda, what })
}

/// One value a point, one line a strand.
pub(super) fn per_vertex<W: Write>(
    drawable: Drawable<'_>,
    out: &mut TextOut<'_, W>,
    push: impl Fn(&mut TextOut<'_, W>, usize, usize),
) -> io::Result<()> {
    let mut place = 0;
    for (strand, range) in drawable.strands() {
        let first = range.start;
        for vertex in range {
            separate(out, place, vertex == first);
            push(out, strand, vertex);
            place += 1;
            out.hand_on()?;
        }
    }
    Ok(())
}

/// What stands before the value at `place` of an array.
pub(super) fn separate<W: Write>(out: &mut TextOut<'_, W>, place: usize, new_line: bool) {
    match (place, new_line) {
        (0, _) => {}
        (_, true) => out.push(b",\n            "),
        (_, false) => out.push(b", "),
    }
}

pub(super) fn end_array<W: Write>(out: &mut TextOut<'_, W>, interpolation: Option<&str>) {
    out.push(b"]");
    if let Some(interpolation) = interpolation {
        out.push(b" (\n            interpolation = \"");
        out.push(interpolation.as_bytes());
        out.push(b"\"\n        )");
    }
    out.push(b"\n");
}

pub(super) fn tuple<W: Write>(out: &mut TextOut<'_, W>, values: &[f32]) {
    out.push(b"(");
    out.floats(values, b", ");
    out.push(b")");
}
