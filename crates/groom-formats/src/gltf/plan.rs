//! What goes where in the file, known before the first byte is written.

use std::io::{self, Write};

use glam::{DVec3, Vec3};
use groom::{Attribute, FloatView, Groom, UpAxis, Vec3View, names};

use crate::drawable::Drawable;
use crate::gltf::{bytes, document};
use crate::{Format, FormatError, Warning, WriteOptions, unstored};

/// Vertex index that glTF keeps for restarting primitives.
const RESTART: u64 = u32::MAX as u64;

/// A groom turned into the numbers a glTF file asks for.
pub(crate) struct Plan<'a> {
    pub(super) drawable: Drawable<'a>,
    /// Exact bounds of the points as written.
    pub(super) min: Vec3,
    pub(super) max: Vec3,
    pub(super) colors: Option<Colors<'a>>,
    /// Whether any point as written lets light through.
    pub(super) is_clear: bool,
    warnings: Vec<Warning>,
}

/// COLOR_0 of every point.
#[derive(Clone, Copy)]
pub(super) struct Colors<'a> {
    color: Vec3View<'a>,
    transparency: FloatView<'a>,
}

impl Colors<'_> {
    /// Linear RGBA, not yet clamped.
    pub(super) fn rgba(&self, strand: usize, vertex: usize) -> [f32; 4] {
        let color = self.color.get(strand, vertex);
        [color.x, color.y, color.z, 1.0 - self.transparency.get(strand, vertex)]
    }
}

impl<'a> Plan<'a> {
    pub(crate) fn new(
        groom: &'a Groom,
        format: Format,
        file: &str,
        _options: &WriteOptions,
    ) -> Result<Self, FormatError> {
        let mut warnings = Vec::new();
        let drawable = Drawable::new(groom, format, file, &mut warnings)?;
        unstored::left_out(groom, format, &[names::RADIUS, names::COLOR, names::TRANSPARENCY], &mut warnings);
        let colors = colors_of(groom);
        let (min, max) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let mut plan = Plan { drawable, min, max, colors, is_clear: false, warnings };
        plan.refuse_too_large(format, file)?;
        plan.measure(format, file)?;
        plan.judge_colors(format);
        Ok(plan)
    }

    pub(crate) fn into_warnings(self) -> Vec<Warning> {
        self.warnings
    }

    /// The document; `bytes_name` is the file of bytes beside it, `None` stands for the second chunk of a `.glb`.
    pub(crate) fn json(&self, bytes_name: Option<&[u8]>) -> io::Result<Vec<u8>> {
        document::json(self, bytes_name)
    }

    /// The buffer the document describes.
    pub(crate) fn write_bytes(&self, stream: &mut impl Write) -> io::Result<()> {
        bytes::write(self, stream)
    }

    /// Point `vertex` of the groom, y-up and in metres.
    pub(super) fn point(&self, vertex: usize) -> Vec3 {
        let groom = self.drawable.groom;
        let turned = groom.up_axis.rotate(groom.positions()[vertex], UpAxis::Y);
        (DVec3::from(turned) * groom.meters_per_unit).as_vec3()
    }

    /// Diameter at a point, in metres.
    pub(super) fn width(&self, strand: usize, vertex: usize) -> f32 {
        let groom = self.drawable.groom;
        (2.0 * f64::from(groom.radii().get(strand, vertex)) * groom.meters_per_unit) as f32
    }

    pub(super) fn index_count(&self) -> usize {
        2 * (self.drawable.points - self.drawable.strands)
    }

    /// Bytes of the whole buffer: indices, points, colours, widths.
    pub(super) fn buffer_bytes(&self) -> u64 {
        let a_point = 12 + if self.colors.is_some() { 4 } else { 0 } + 4;
        4 * self.index_count() as u64 + a_point * self.drawable.points as u64
    }

    fn refuse_too_large(&self, format: Format, file: &str) -> Result<(), FormatError> {
        let points = self.drawable.points as u64;
        // Leaves room for the document and the headers of a .glb.
        let bytes_limit = u64::from(u32::MAX) - (1 << 16);
        let counts = [("points", points, RESTART), ("bytes", self.buffer_bytes(), bytes_limit)];
        for (what, found, limit) in counts {
            if found > limit {
                return Err(FormatError::TooLarge { file: file.to_owned(), format, what, found, limit });
            }
        }
        Ok(())
    }

    fn measure(&mut self, format: Format, file: &str) -> Result<(), FormatError> {
        let mut widest = 0.0_f32;
        for (strand, vertex) in self.drawable.vertices() {
            let point = self.point(vertex);
            self.min = self.min.min(point);
            self.max = self.max.max(point);
            widest = widest.max(self.width(strand, vertex));
        }
        if self.min.is_finite() && self.max.is_finite() && widest.is_finite() {
            return Ok(());
        }
        let what = "is in metres, and this groom's points or widths leave 32-bit floats there";
        Err(FormatError::Unsupported { file: file.to_owned(), format, what })
    }

    /// Warns of what 8 bits lose, and notes whether there is anything to see through.
    fn judge_colors(&mut self, format: Format) {
        let Some(colors) = self.colors else { return };
        let mut clamped = [0; 2];
        let mut error = [0.0_f32; 2];
        for (strand, vertex) in self.drawable.vertices() {
            let rgba = colors.rgba(strand, vertex);
            self.is_clear |= bytes::in_8_bits(rgba[3]) < u8::MAX;
            for (part, channels) in [(0, &rgba[..3]), (1, &rgba[3..])] {
                clamped[part] += usize::from(channels.iter().any(|c| !(0.0..=1.0).contains(c)));
                for channel in channels.iter().map(|c| c.clamp(0.0, 1.0)) {
                    error[part] =
                        error[part].max((channel - f32::from(bytes::in_8_bits(channel)) / 255.0).abs());
                }
            }
        }
        for (part, name) in [names::COLOR, names::TRANSPARENCY].into_iter().enumerate() {
            if clamped[part] > 0 {
                self.warnings.push(Warning::Clamped { format, name, values: clamped[part] });
            }
            // Below this the value is one that came from 8 bits.
            if error[part] > 1e-6 {
                self.warnings.push(Warning::Rounded { format, name, error: error[part] });
            }
        }
    }
}

/// Colours with alpha; white and opaque where the groom says nothing, `None` if it says neither.
fn colors_of(groom: &Groom) -> Option<Colors<'_>> {
    let color = groom.colors();
    let transparency = groom.attribute(names::TRANSPARENCY).and_then(Attribute::float_view);
    if color.is_none() && transparency.is_none() {
        return None;
    }
    Some(Colors {
        color: color.unwrap_or(Vec3View::Constant(Vec3::ONE)),
        transparency: transparency.unwrap_or(FloatView::Constant(0.0)),
    })
}

/// Writes a `.glb`: header, document, buffer.
pub(crate) fn write_glb(
    groom: &Groom,
    stream: &mut impl Write,
    file: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let plan = Plan::new(groom, Format::Glb, file, options)?;
    glb(&plan, stream).map_err(|e| FormatError::io(file, e))?;
    Ok(plan.into_warnings())
}

fn glb(plan: &Plan<'_>, stream: &mut impl Write) -> io::Result<()> {
    let mut json = plan.json(None)?;
    json.resize(json.len().next_multiple_of(4), b' ');
    // refuse_too_large saw to it that the sum fits.
    let buffer = plan.buffer_bytes() as u32;
    let document = json.len() as u32;
    stream.write_all(b"glTF")?;
    for word in [2, 12 + 8 + document + 8 + buffer, document] {
        stream.write_all(&word.to_le_bytes())?;
    }
    stream.write_all(b"JSON")?;
    stream.write_all(&json)?;
    stream.write_all(&buffer.to_le_bytes())?;
    stream.write_all(b"BIN\0")?;
    plan.write_bytes(stream)
}
