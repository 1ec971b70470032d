//! From linear radiance to eight bits: previews and contact sheets.

use std::io::{BufWriter, Write};
use std::path::Path;

use glam::Vec3;
use image::ImageEncoder;
use whole_file::WholeFile;

use crate::{Frame, RenderError};

/// How bright values are brought into 0..1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Curve {
    /// Khronos PBR Neutral: true to the colour below 0.8, highlights compressed and paled above.
    #[default]
    Neutral,
    /// Cut off at 1.
    Clip,
}

/// What is put behind the transparent part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Backdrop {
    /// The picture keeps its alpha (not premultiplied, as PNG wants it).
    #[default]
    Transparent,
    /// One linear Rec. 709 colour, which exposure and curve leave alone.
    Solid(Vec3),
}

/// How linear radiance becomes display values.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ToneMapping {
    /// In stops: radiance is multiplied by 2 to this power.
    pub exposure: f32,
    /// How bright values are brought into 0..1.
    pub curve: Curve,
    /// What is put behind the transparent part.
    pub backdrop: Backdrop,
}

/// A picture to look at: eight bits a channel, sRGB.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Preview {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Red, green, blue, alpha; row by row from the upper left.
    pub rgba: Vec<u8>,
}

/// The beauty of `frame` as it would be shown.
#[must_use]
pub fn tone_map(frame: &Frame, mapping: &ToneMapping) -> Preview {
    let rgba = shown(frame, mapping, &[]).flat_map(|pixel| pixel.map(unit_byte)).collect();
    Preview { width: frame.width, height: frame.height, rgba }
}

/// As [`tone_map`], over a picture of the frame's size in linear Rec. 709, which exposure and curve leave alone
/// as they do [`Backdrop::Solid`]. Pixels that `behind` does not have are black.
#[must_use]
pub fn tone_map_over(frame: &Frame, mapping: &ToneMapping, behind: &[Vec3]) -> Preview {
    let mapping = ToneMapping { backdrop: Backdrop::Solid(Vec3::ZERO), ..*mapping };
    let rgba = shown(frame, &mapping, behind).flat_map(|pixel| pixel.map(unit_byte)).collect();
    Preview { width: frame.width, height: frame.height, rgba }
}

/// As [`tone_map`], with sixteen bits a channel: red, green, blue, alpha, row by row from the upper left.
#[must_use]
pub fn tone_map_deep(frame: &Frame, mapping: &ToneMapping) -> Vec<u16> {
    shown(frame, mapping, &[]).flat_map(|pixel| pixel.map(unit_word)).collect()
}

/// As [`tone_map_over`], with sixteen bits a channel.
#[must_use]
pub fn tone_map_over_deep(frame: &Frame, mapping: &ToneMapping, behind: &[Vec3]) -> Vec<u16> {
    let mapping = ToneMapping { backdrop: Backdrop::Solid(Vec3::ZERO), ..*mapping };
    shown(frame, &mapping, behind).flat_map(|pixel| pixel.map(unit_word)).collect()
}

/// Every pixel in sRGB with straight alpha, 0..1; `behind` stands in for a backdrop of one colour.
fn shown<'a>(
    frame: &'a Frame,
    mapping: &'a ToneMapping,
    behind: &'a [Vec3],
) -> impl Iterator<Item = [f32; 4]> + 'a {
    let gain = mapping.exposure.exp2();
    let pixels = frame.beauty.iter().zip(&frame.alpha).enumerate();
    pixels.map(move |(index, (&beauty, &alpha))| {
        // The curve is for what a surface looks like, so coverage is taken out first and put back after.
        let straight = if alpha > 0.0 { beauty / alpha } else { Vec3::ZERO };
        let mapped = mapping.curve.apply(straight * gain);
        let (color, alpha) = match mapping.backdrop {
            Backdrop::Transparent => (mapped, alpha),
            Backdrop::Solid(solid) => {
                let backdrop = behind.get(index).copied().unwrap_or(solid);
                (mapped * alpha + backdrop * (1.0 - alpha), 1.0)
            }
        };
        let [red, green, blue] = color.to_array().map(srgb);
        [red, green, blue, alpha.clamp(0.0, 1.0)]
    })
}

impl Preview {
    /// Writes a PNG, whole or not at all.
    ///
    /// # Errors
    /// [`RenderError::Io`] or [`RenderError::Encode`].
    pub fn write_png(&self, path: &Path) -> Result<(), RenderError> {
        let io = |source| RenderError::Io { path: path.to_owned(), source };
        let mut file = BufWriter::new(WholeFile::create(path)?);
        image::codecs::png::PngEncoder::new(&mut file)
            .write_image(&self.rgba, self.width, self.height, image::ExtendedColorType::Rgba8)
            .map_err(|fault| RenderError::Encode { path: path.to_owned(), reason: fault.to_string() })?;
        file.flush().map_err(io)?;
        let file = file.into_inner().map_err(|e| io(e.into_error()))?;
        Ok(file.commit()?)
    }
}

impl Curve {
    fn apply(self, color: Vec3) -> Vec3 {
        let color = if color.is_finite() { color.max(Vec3::ZERO) } else { Vec3::ZERO };
        match self {
            Curve::Clip => color.min(Vec3::ONE),
            Curve::Neutral => neutral(color),
        }
    }
}

/// Khronos PBR Neutral tone mapper, from its published specification.
fn neutral(mut color: Vec3) -> Vec3 {
    const START: f32 = 0.8 - 0.04;
    const DESATURATION: f32 = 0.15;
    let least = color.min_element();
    color -= if least < 0.08 { least - 6.25 * least * least } else { 0.04 };
    let peak = color.max_element();
    if peak < START {
        return color;
    }
    let room = 1.0 - START;
    let new_peak = 1.0 - room * room / (peak + room - START);
    color *= new_peak / peak;
    let pale = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    color.lerp(Vec3::splat(new_peak), pale)
}

/// IEC 61966-2-1, brought into 0..1.
fn srgb(linear: f32) -> f32 {
    let v = linear.clamp(0.0, 1.0);
    if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.powf(1.0 / 2.4) - 0.055 }
}

fn unit_word(v: f32) -> u16 {
    (v.clamp(0.0, 1.0) * 65535.0 + 0.5) as u16
}

fn unit_byte(v: f32) -> u8 {
    (v.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FrameReport;

    fn frame(beauty: Vec3, alpha: f32) -> Frame {
        let report = FrameReport::default();
        Frame {
            width: 1,
            height: 1,
            cutout: None,
            beauty: vec![beauty],
            alpha: vec![alpha],
            passes: vec![],
            report,
        }
    }

    fn shown(beauty: Vec3, alpha: f32, mapping: ToneMapping) -> [u8; 4] {
        tone_map(&frame(beauty, alpha), &mapping).rgba.try_into().unwrap()
    }

    #[test]
    fn clip_is_plain_srgb() {
        let clip = ToneMapping { curve: Curve::Clip, ..Default::default() };
        assert_eq!(shown(Vec3::new(0.0, 0.215_861, 7.0), 1.0, clip), [0, 128, 255, 255]);
        assert_eq!(shown(Vec3::splat(0.5), 1.0, ToneMapping { exposure: 1.0, ..clip }), [255; 4]);
    }

    #[test]
    fn half_covered_pixels_mix_with_the_backdrop() {
        let solid =
            ToneMapping { curve: Curve::Clip, backdrop: Backdrop::Solid(Vec3::ONE), ..Default::default() };
        assert_eq!(shown(Vec3::ZERO, 0.0, solid), [255; 4]);
        assert_eq!(shown(Vec3::ZERO, 0.785_958, solid), [128, 128, 128, 255]);
        let kept = ToneMapping { curve: Curve::Clip, ..Default::default() };
        assert_eq!(shown(Vec3::splat(0.25), 0.25, kept), [255, 255, 255, 64]);
    }

    #[test]
    fn a_picture_behind_is_left_alone_and_sixteen_bits_agree_with_eight() {
        let mapping = ToneMapping { exposure: 3.0, ..Default::default() };
        let empty = frame(Vec3::ZERO, 0.0);
        assert_eq!(tone_map_over(&empty, &mapping, &[Vec3::splat(0.215_861)]).rgba, [128, 128, 128, 255]);
        assert_eq!(tone_map_over(&empty, &mapping, &[]).rgba, [0, 0, 0, 255]);
        let solid = ToneMapping { backdrop: Backdrop::Solid(Vec3::new(0.1, 0.2, 0.3)), ..mapping };
        for step in 0..100 {
            let some = frame(Vec3::new(0.01, 0.02, 0.03) * step as f32, 0.01 * step as f32);
            assert_eq!(tone_map(&some, &solid), tone_map_over(&some, &mapping, &[Vec3::new(0.1, 0.2, 0.3)]));
            let deep = tone_map_deep(&some, &mapping);
            for (deep, byte) in deep.iter().zip(tone_map(&some, &mapping).rgba) {
                assert!((f64::from(*deep) / 257.0 - f64::from(byte)).abs() <= 0.51, "{deep} {byte}");
            }
        }
    }

    #[test]
    fn neutral_rises_and_stays_in_range() {
        let mut last = -1.0;
        for step in 0..2000 {
            let v = neutral(Vec3::splat(step as f32 * 0.01)).x;
            assert!(v > last && v < 1.0);
            last = v;
        }
        assert!((neutral(Vec3::splat(0.5)).x - 0.46).abs() < 1e-6);
    }
}
