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
        let (mut color, mut clear) = (Loss::default(), Loss::default());
        for run in runs(drawable) {
            match self.color {
                Vec3View::Constant(value) => color.add(&[value.to_array()], |_| run.vertices.len()),
                Vec3View::Strand(values) => {
                    color.add::<3>(
                        bytemuck::cast_slice(&values[run.strands.clone()]),
                        lengths(&run, drawable),
                    );
                }
                Vec3View::Vertex(values) => {
                    color.add::<3>(bytemuck::cast_slice(&values[run.vertices.clone()]), |_| 1);
                }
            }
            match self.transparency {
                FloatView::Constant(value) => clear.add(&[[value]], |_| run.vertices.len()),
                FloatView::Strand(values) => {
                    clear.add::<1>(
                        bytemuck::cast_slice(&values[run.strands.clone()]),
                        lengths(&run, drawable),
                    );
                }
                FloatView::Vertex(values) => {
                    clear.add::<1>(bytemuck::cast_slice(&values[run.vertices.clone()]), |_| 1);
                }
            }
        }
        for (name, loss) in [(names::COLOR, &color), (names::TRANSPARENCY, &clear)] {
            if loss.clamped > 0 {
                warnings.push(Warning::Clamped { format, name, values: loss.clamped });
            }
            // Below this the value is one that came from 8 bits.
            let error = loss.error.into_iter().fold(0.0, f32::max) / 255.0;
            if error > 1e-6 {
                warnings.push(Warning::Rounded { format, name, error });
            }
        }
        in_8_bits(1.0 - clear.largest()) < u8::MAX
    }
}

/// Points of the strands of a run.
fn lengths<'a>(run: &'a Run, drawable: Drawable<'a>) -> impl Fn(usize) -> usize + 'a {
    move |i| drawable.groom.strand_range(run.strands.start + i).len()
}

const LANES: usize = 8;

/// What an attribute loses in 8 bits. Lanes let processors look at several numbers at once.
struct Loss {
    clamped: usize,
    /// In 255ths.
    error: [f32; LANES],
    least: [f32; LANES],
    most: [f32; LANES],
}

impl Default for Loss {
    fn default() -> Self {
        let (least, most) = ([f32::INFINITY; LANES], [f32::NEG_INFINITY; LANES]);
        Loss { clamped: 0, error: [0.0; LANES], least, most }
    }
}

impl Loss {
    /// Adds values of `N` channels; `points` says how many points have value `i`.
    fn add<const N: usize>(&mut self, values: &[[f32; N]], points: impl Fn(usize) -> usize) {
        let mut here = Loss::default();
        let (lanes, rest) = values.as_flattened().as_chunks::<LANES>();
        lanes.iter().for_each(|lanes| here.look(lanes));
        rest.iter().for_each(|&value| here.look(&[value; LANES]));
        if here.least.iter().any(|&v| v < 0.0) || here.most.iter().any(|&v| v > 1.0) {
            let is_outside = |value: &[f32; N]| value.iter().any(|v| !(0.0..=1.0).contains(v));
            let outside = values.iter().enumerate().filter(|(_, value)| is_outside(value));
            self.clamped += outside.map(|(i, _)| points(i)).sum::<usize>();
        }
        for i in 0..LANES {
            self.error[i] = self.error[i].max(here.error[i]);
            self.most[i] = self.most[i].max(here.most[i]);
        }
    }

    #[inline]
    fn look(&mut self, values: &[f32; LANES]) {
        for (i, &value) in values.iter().enumerate() {
            self.least[i] = if value < self.least[i] { value } else { self.least[i] };
            self.most[i] = if value > self.most[i] { value } else { self.most[i] };
            let exact = value.clamp(0.0, 1.0) * 255.0;
            let error = (exact - ((exact + INTEGERS) - INTEGERS)).abs();
            self.error[i] = if error > self.error[i] { error } else { self.error[i] };
        }
    }

    fn largest(&self) -> f32 {
        self.most.into_iter().fold(f32::NEG_INFINITY, f32::max)
    }
}

/// From here to twice of it, floats are integers: added to it, a small number is rounded to the nearest and is
/// the lowest bits of the sum.
const INTEGERS: f32 = (1_u32 << 23) as f32;

/// A number from 0 to 1 as glTF normalises it, rounded to the nearest; what lies outside is clamped.
#[inline]
fn in_8_bits(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0 + INTEGERS).to_bits() as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn eight_bits_are_the_nearest() {
        for i in 0..=255 {
            assert_eq!(in_8_bits(i as f32 / 255.0), i as u8);
            assert_eq!(in_8_bits((i as f32 + 0.49) / 255.0), i as u8);
            assert_eq!(in_8_bits((i as f32 - 0.49) / 255.0), i as u8);
        }
        assert_eq!((in_8_bits(-3.0), in_8_bits(7.0)), (0, 255));
    }
}
