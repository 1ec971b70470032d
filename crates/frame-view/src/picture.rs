//! A picture to be shown.

use crate::ViewError;

/// sRGB in eight bits, row by row from the upper left.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Picture {
    width: u32,
    height: u32,
    rgb: Vec<[u8; 3]>,
}

impl Picture {
    /// A picture from red, green, blue and straight alpha; what is transparent shows black.
    ///
    /// # Errors
    /// [`ViewError::Size`] when there are not 4 x `width` x `height` values, or none.
    pub fn from_rgba(width: u32, height: u32, rgba: &[u8]) -> Result<Picture, ViewError> {
        let expected = u64::from(width) * u64::from(height) * 4;
        if expected == 0 || rgba.len() as u64 != expected {
            return Err(ViewError::Size { found: rgba.len(), width, height, expected });
        }
        let over_black = |pixel: &[u8; 4]| {
            let [red, green, blue, alpha] = *pixel;
            [red, green, blue].map(|value| srgb(light(value) * f32::from(alpha) / 255.0))
        };
        Ok(Picture { width, height, rgb: rgba.as_chunks::<4>().0.iter().map(over_black).collect() })
    }

    /// Pixels across and down.
    #[must_use]
    pub fn size(&self) -> (u32, u32) {
        (self.width, self.height)
    }

    pub(crate) fn pixels(&self) -> &[[u8; 3]] {
        &self.rgb
    }

    /// The size of the picture in a box, its shape kept; never larger than it is where `grow` is off.
    pub(crate) fn size_in(&self, (across, down): (u32, u32), grow: bool) -> (u32, u32) {
        let scale = (f64::from(across) / f64::from(self.width)).min(f64::from(down) / f64::from(self.height));
        let scale = if grow { scale } else { scale.min(1.0) };
        let edge = |edge: u32, most: u32| ((f64::from(edge) * scale).round() as u32).clamp(1, most.max(1));
        (edge(self.width, across), edge(self.height, down))
    }

    /// The picture in another size, every pixel the mean light of the area it covers.
    pub(crate) fn scaled(&self, width: u32, height: u32) -> Picture {
        if (width, height) == (self.width, self.height) {
            return self.clone();
        }
        let span = |index: u32, from: u32, to: u32| {
            let low = (u64::from(index) * u64::from(from) / u64::from(to)) as u32;
            let high = ((u64::from(index) + 1) * u64::from(from)).div_ceil(u64::from(to)) as u32;
            low..high.clamp(low + 1, from)
        };
        let mut rgb = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            for x in 0..width {
                let mut sum = [0.0f32; 3];
                let mut count = 0.0f32;
                for row in span(y, self.height, height) {
                    for column in span(x, self.width, width) {
                        let at = row as usize * self.width as usize + column as usize;
                        let Some(pixel) = self.rgb.get(at) else { continue };
                        for (sum, &value) in sum.iter_mut().zip(pixel) {
                            *sum += light(value);
                        }
                        count += 1.0;
                    }
                }
                rgb.push(sum.map(|sum| srgb(sum / count.max(1.0))));
            }
        }
        Picture { width, height, rgb }
    }
}

/// IEC 61966-2-1.
fn light(value: u8) -> f32 {
    let v = f32::from(value) / 255.0;
    if v <= 0.040_45 { v / 12.92 } else { ((v + 0.055) / 1.055).powf(2.4) }
}

fn srgb(light: f32) -> u8 {
    let v = if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 };
    (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_value_survives_light_and_back() {
        let all: Vec<u8> = (0..=255).flat_map(|v| [v, v, v, 255]).collect();
        let picture = Picture::from_rgba(256, 1, &all).unwrap();
        assert!(picture.pixels().iter().zip(0..=255).all(|(pixel, v)| *pixel == [v; 3]));
        assert_eq!(picture.scaled(256, 1), picture);
        // Means are of light, not of its code.
        let half = Picture::from_rgba(2, 1, &[0, 0, 0, 255, 255, 255, 255, 255]).unwrap().scaled(1, 1);
        assert_eq!(half.pixels(), [[188; 3]]);
    }

    #[test]
    fn shapes_are_kept() {
        let wide = Picture::from_rgba(40, 10, &[9; 1600]).unwrap();
        assert_eq!(wide.size_in((20, 20), true), (20, 5));
        assert_eq!(wide.size_in((400, 400), false), (40, 10));
        assert_eq!(wide.size_in((80, 400), true), (80, 20));
        assert_eq!(wide.size_in((1, 1), true), (1, 1));
        assert!(Picture::from_rgba(2, 2, &[0; 15]).is_err() && Picture::from_rgba(0, 0, &[]).is_err());
    }
}
