//! Light in PNGs, finely enough to be added up and exposed.
//!
//! A pixel of a layer is three bytes m and one scale s, a power of two not below its largest channel; a channel is
//! s (m / 255)^2. The largest channel is then exact to 0.6 %, a third of a step in eight bits of sRGB, and small ones beside it
//! to about as many steps. The scales' exponents follow below the picture, three to a pixel: what browsers
//! read back from an alpha channel is not exact.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use image::codecs::jpeg::JpegEncoder;
use image::codecs::png::{CompressionType, FilterType, PngEncoder};
use image::{ExtendedColorType, ImageEncoder as _, ImageError};

/// How good the ready-made pictures look, 1..=100.
const JPEG_QUALITY: u8 = 90;

/// The exponent that stands for a scale of 1; 0 stands for black.
const BIAS: i32 = 128;

/// A layer as a PNG in base64; `None` when it is black. What is negative or not finite is black.
pub(crate) fn layer(width: u32, pixels: &[[f32; 3]]) -> Result<Option<String>, ImageError> {
    let clean = |v: f32| if v.is_finite() { v.max(0.0) } else { 0.0 };
    let pixels = pixels.iter().map(|pixel| pixel.map(clean));
    let mut bytes = Vec::new();
    let mut exponents = Vec::new();
    for pixel in pixels {
        let peak = pixel.into_iter().fold(0.0f32, f32::max);
        let exponent = if peak > 0.0 { (peak.log2().ceil() as i32).clamp(1 - BIAS, 127) } else { -BIAS };
        // A power of two may round to the next below.
        let scale = f64::from(exponent).exp2();
        let byte = |v: f32| (255.0 * (f64::from(v) / scale).sqrt() + 0.5) as u8;
        bytes.extend(if peak > 0.0 { pixel.map(byte) } else { [0; 3] });
        exponents.push((exponent + BIAS) as u8);
    }
    if exponents.iter().all(|&exponent| exponent == 0) {
        return Ok(None);
    }
    bytes.extend(&exponents);
    // Whole rows.
    bytes.resize(bytes.len().next_multiple_of(3 * width.max(1) as usize), 0);
    png(width, &bytes).map(Some)
}

/// Coverage in sixteen bits as a PNG in base64: the high byte red, the low one green; `None` when all is covered.
pub(crate) fn alpha(width: u32, alpha: &[f32]) -> Result<Option<String>, ImageError> {
    if alpha.iter().all(|&a| a >= 1.0) {
        return Ok(None);
    }
    let bytes = |&a: &f32| {
        let [high, low] = ((a.clamp(0.0, 1.0) * 65535.0 + 0.5) as u16).to_be_bytes();
        [high, low, 0]
    };
    png(width, &alpha.iter().flat_map(bytes).collect::<Vec<u8>>()).map(Some)
}

/// RGB as a PNG in base64.
pub(crate) fn png(width: u32, rgb: &[u8]) -> Result<String, ImageError> {
    let mut out = Vec::new();
    let height = rgb.len() / (3 * width.max(1) as usize);
    PngEncoder::new_with_quality(&mut out, CompressionType::Default, FilterType::Adaptive).write_image(
        rgb,
        width,
        height as u32,
        ExtendedColorType::Rgb8,
    )?;
    Ok(STANDARD.encode(out))
}

/// RGB as a JPEG in base64.
pub(crate) fn jpeg(width: u32, height: u32, rgb: &[u8]) -> Result<String, ImageError> {
    let mut out = Vec::new();
    JpegEncoder::new_with_quality(&mut out, JPEG_QUALITY).write_image(
        rgb,
        width,
        height,
        ExtendedColorType::Rgb8,
    )?;
    Ok(STANDARD.encode(out))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// The layer as the page's script reads it.
    fn unpacked(png: &str, count: usize) -> Vec<[f64; 3]> {
        let bytes = STANDARD.decode(png).unwrap();
        let bytes = image::load_from_memory(&bytes).unwrap().into_rgb8().into_raw();
        let scale = |i: usize| f64::from(i32::from(bytes[3 * count + i]) - BIAS).exp2();
        let value = |i: usize, c: usize| scale(i) * (f64::from(bytes[3 * i + c]) / 255.0).powi(2);
        (0..count).map(|i| [0, 1, 2].map(|c| value(i, c))).collect()
    }

    fn srgb(v: f64) -> f64 {
        255.0 * if v <= 0.003_130_8 { 12.92 * v } else { 1.055 * v.min(1.0).powf(1.0 / 2.4) - 0.055 }
    }

    proptest! {
        #[test]
        fn layers_keep_light_within_a_step_of_srgb(
            width in 1u32..6,
            pixels in prop::collection::vec(prop::array::uniform3(prop_oneof![0.0f32..1.0, 0.0f32..1e-3, Just(0.0)]), 1..40),
        ) {
            let pixels = &pixels[..pixels.len() / width as usize * width as usize];
            let Some(png) = layer(width, pixels).unwrap() else {
                prop_assert!(pixels.iter().flatten().all(|v| *v == 0.0));
                return Ok(());
            };
            for (found, pixel) in unpacked(&png, pixels.len()).iter().zip(pixels) {
                for (found, v) in found.iter().zip(pixel) {
                    let off = (srgb(*found) - srgb(f64::from(*v))).abs();
                    prop_assert!(off < 0.75, "{} for {}: {} steps", found, v, off);
                }
            }
        }

        #[test]
        fn bright_and_dark_layers_are_as_exact(v in 1e-30f32..1e30) {
            let png = layer(1, &[[v, v / 2.0, 0.0]]).unwrap().unwrap();
            let found = unpacked(&png, 1)[0];
            prop_assert!((found[0] / f64::from(v) - 1.0).abs() < 6e-3, "{:?} for {}", found, v);
            prop_assert!((found[1] / f64::from(v) - 0.5).abs() < 5e-3 && found[2] == 0.0);
        }
    }

    #[test]
    fn what_is_no_light_is_black() {
        assert_eq!(layer(1, &[[f32::NAN, -1.0, f32::NEG_INFINITY]]).unwrap(), None);
        assert_eq!(layer(1, &[[0.0; 3]]).unwrap(), None);
        assert_eq!(alpha(1, &[1.0, 1.5]).unwrap(), None);
        assert!(alpha(1, &[f32::NAN]).unwrap().is_some());
        let powers: Vec<[f32; 3]> = (-100..100).map(|e| [(e as f32).exp2(); 3]).collect();
        let png = layer(1, &powers).unwrap().unwrap();
        for (found, power) in unpacked(&png, powers.len()).iter().zip(&powers) {
            assert!((found[0] / f64::from(power[0]) - 1.0).abs() < 6e-3);
        }
    }
}
