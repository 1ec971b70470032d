//! COLOR_0 of every point.

use glam::Vec3;
use groom::{Attribute, FloatView, Groom, Vec3View, names};

use super::runs::{Run, runs};
use crate::drawable::Drawable;
use crate::{Format, Warning};

/// The groom's colours and transparencies.
#[derive(Clone, Copy)]
pub(super) struct Colors<'a> {
    color: Vec3View<'a>,
    transparency: FloatView<'a>,
}

impl<'a> Colors<'a> {
    /// Colours with alpha; white and opaque where the groom says nothing, `None` if it says neither.
    pub(super) fn of(groom: &'a Groom) -> Option<Self> {
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

    /// Linear RGBA as glTF normalises it; what lies outside 0 to 1 is clamped.
    #[inline]
    pub(super) fn rgba(&self, strand: usize, vertex: usize) -> [u8; 4] {
        let color = self.color.get(strand, vertex);
        let alpha = 1.0 - self.transparency.get(strand, vertex);
        [color.x, color.y, color.z, alpha].map(in_8_bits)
    }

    /// Warns of what 8 bits lose; says whether there is anything to see through.
    pub(super) fn judge(&self, drawable: Drawable<'_>, format: Format, warnings: &mut Vec<Warning>) -> bool {
        let (mut color, mut alpha) = (Loss::default(), Loss::default());
        for run in runs(drawable) {
            match self.color {
                Vec3View::Constant(value) => color.add(value.to_array(), run.vertices.len()),
                Vec3View::Strand(values) => {
                    each_strand(&run, drawable, |strand, points| {
                        color.add(values[strand].to_array(), points)
                    });
                }
                Vec3View::Vertex(values) => {
                    values[run.vertices.clone()].iter().for_each(|value| color.add(value.to_array(), 1));
                }
            }
            match self.transparency {
                FloatView::Constant(value) => alpha.add([1.0 - value], run.vertices.len()),
                FloatView::Strand(values) => {
                    each_strand(&run, drawable, |strand, points| alpha.add([1.0 - values[strand]], points));
                }
                FloatView::Vertex(values) => {
                    values[run.vertices].iter().for_each(|&value| alpha.add([1.0 - value], 1));
                }
            }
        }
        for (name, loss) in [(names::COLOR, &color), (names::TRANSPARENCY, &alpha)] {
            if loss.clamped > 0 {
                warnings.push(Warning::Clamped { format, name, values: loss.clamped });
            }
            // Below this the value is one that came from 8 bits.
            if loss.error > 1e-6 {
                warnings.push(Warning::Rounded { format, name, error: loss.error });
            }
        }
        alpha.least < u8::MAX
    }
}

fn each_strand(run: &Run, drawable: Drawable<'_>, mut body: impl FnMut(usize, usize)) {
    for strand in run.strands.clone() {
        body(strand, drawable.groom.strand_range(strand).len());
    }
}

/// What an attribute loses in 8 bits.
struct Loss {
    clamped: usize,
    error: f32,
    least: u8,
}

impl Default for Loss {
    fn default() -> Self {
        Loss { clamped: 0, error: 0.0, least: u8::MAX }
    }
}

impl Loss {
    #[inline]
    fn add<const N: usize>(&mut self, channels: [f32; N], points: usize) {
        let mut inside = true;
        for channel in channels {
            inside &= (0.0..=1.0).contains(&channel);
            let stored = in_8_bits(channel);
            self.error = self.error.max((channel.clamp(0.0, 1.0) - f32::from(stored) / 255.0).abs());
            self.least = self.least.min(stored);
        }
        self.clamped += if inside { 0 } else { points };
    }
}

/// A number from 0 to 1 as glTF normalises it, rounded to the nearest; what lies outside is clamped.
#[inline]
fn in_8_bits(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}
