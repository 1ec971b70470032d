//! Pictures on a mesh.

use std::fs::File;
use std::io::{BufRead, BufReader, Cursor, Seek};
use std::path::PathBuf;

use glam::{Vec2, Vec3};
use image::{DynamicImage, ImageError, ImageReader, Limits};

use crate::MeshError;

/// Pixels along a side: a picture of one colour takes little of a file and 12 bytes a pixel here.
const LONGEST_SIDE: u32 = 1 << 14;

/// A picture, decoded.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureImage {
    /// Pixels a row.
    pub width: u32,
    /// Rows.
    pub height: u32,
    /// Linear Rec. 709 colours, 0 to 1, row by row from the top.
    pub pixels: Vec<Vec3>,
}

/// Where a picture is to be had; told apart when it is asked for.
#[derive(Clone, Debug)]
pub(crate) enum TextureSource {
    /// Encoded bytes; the words say where in which file.
    Held {
        bytes: Vec<u8>,
        path: PathBuf,
        place: String,
    },
    File(PathBuf),
    /// Not to be had; the words say why.
    Lost {
        path: PathBuf,
        place: String,
        fault: String,
    },
}

impl TextureSource {
    pub(crate) fn decode(&self) -> Result<TextureImage, MeshError> {
        let (image, path, place) = match self {
            TextureSource::Held { bytes, path, place } => {
                (decoded(Cursor::new(bytes.as_slice())), path, place.as_str())
            }
            TextureSource::File(path) => {
                let file = File::open(path).map_err(|source| MeshError::Io { path: path.clone(), source })?;
                (decoded(BufReader::new(file)), path, "texture")
            }
            TextureSource::Lost { path, place, fault } => {
                let (path, place, fault) = (path.clone(), place.clone(), fault.clone());
                return Err(MeshError::Invalid { path, place, fault });
            }
        };
        image.map(TextureImage::linear).map_err(|e| MeshError::Invalid {
            path: path.clone(),
            place: place.to_owned(),
            fault: match e {
                ImageError::Limits(_) => {
                    format!("{e}, expected a picture of at most {LONGEST_SIDE} x {LONGEST_SIDE} pixels")
                }
                _ => format!("{e}, expected a PNG or JPEG picture"),
            },
        })
    }
}

fn decoded(bytes: impl BufRead + Seek) -> Result<DynamicImage, ImageError> {
    let mut reader = ImageReader::new(bytes).with_guessed_format()?;
    let mut limits = Limits::default();
    (limits.max_image_width, limits.max_image_height) = (Some(LONGEST_SIDE), Some(LONGEST_SIDE));
    reader.limits(limits);
    reader.decode()
}

impl TextureImage {
    /// Pictures on meshes are sRGB (glTF 2.0, section 3.9.2; USD's `auto` for 8 bits); alpha is left out.
    fn linear(image: DynamicImage) -> Self {
        // 16 bits hold both depths exactly.
        let table: Vec<f32> = (0..=u16::MAX).map(|v| linear(f32::from(v) / f32::from(u16::MAX))).collect();
        let image = image.into_rgb16();
        let pixel = |p: &image::Rgb<u16>| Vec3::from_array(p.0.map(|v| table[usize::from(v)]));
        TextureImage {
            width: image.width(),
            height: image.height(),
            pixels: image.pixels().map(pixel).collect(),
        }
    }

    /// The colour at `uv` (V upwards), bilinear between the centres of pixels, repeating outside 0 to 1. White
    /// for a picture without pixels or a place that is no number.
    #[must_use]
    pub fn sample(&self, uv: Vec2) -> Vec3 {
        if self.pixels.len() != self.width as usize * self.height as usize || self.pixels.is_empty() {
            return Vec3::ONE;
        }
        let (width, height) = (self.width as i64, self.height as i64);
        let x = f64::from(uv.x) * width as f64 - 0.5;
        let y = (1.0 - f64::from(uv.y)) * height as f64 - 0.5;
        if !x.is_finite() || !y.is_finite() {
            return Vec3::ONE;
        }
        let pixel = |column: i64, row: i64| {
            let (column, row) = (column.rem_euclid(width), row.rem_euclid(height));
            self.pixels[(row * width + column) as usize]
        };
        let (left, top) = (x.floor(), y.floor());
        let (right, down) = ((x - left) as f32, (y - top) as f32);
        // Far outside, a column is lost to rounding, not to overflow.
        let (column, row) = (left.rem_euclid(width as f64) as i64, top.rem_euclid(height as f64) as i64);
        let upper = pixel(column, row).lerp(pixel(column + 1, row), right);
        let lower = pixel(column, row + 1).lerp(pixel(column + 1, row + 1), right);
        upper.lerp(lower, down)
    }
}

/// IEC 61966-2-1.
fn linear(encoded: f32) -> f32 {
    if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn v_goes_up_and_places_outside_repeat() {
        // White above black, two columns.
        let pixels = vec![Vec3::ONE, Vec3::X, Vec3::ZERO, Vec3::Y];
        let image = TextureImage { width: 2, height: 2, pixels };
        assert_eq!(image.sample(Vec2::new(0.25, 0.75)), Vec3::ONE);
        assert_eq!(image.sample(Vec2::new(0.25, 0.25)), Vec3::ZERO);
        assert_eq!(image.sample(Vec2::new(-1.75, 3.75)), Vec3::ONE);
        assert_eq!(image.sample(Vec2::new(0.75, 0.5)), Vec3::new(0.5, 0.5, 0.0));
        assert_eq!(image.sample(Vec2::splat(f32::INFINITY)), Vec3::ONE);
        assert!(image.sample(Vec2::splat(f32::MAX)).is_finite());
    }

    #[test]
    fn pictures_become_linear() {
        let encoded = [0u8, 127, 255].map(|v| image::Rgb([v; 3]));
        let image = image::RgbImage::from_fn(3, 1, |x, _| encoded[x as usize]);
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
        let held = |bytes| TextureSource::Held { bytes, path: "a.glb".into(), place: "images[0]".into() };
        let decoded = held(bytes.clone().into_inner()).decode().unwrap();
        assert_eq!((decoded.width, decoded.height), (3, 1));
        assert_eq!((decoded.pixels[0], decoded.pixels[2]), (Vec3::ZERO, Vec3::ONE));
        assert!((decoded.pixels[1].x - 0.212_23).abs() < 1e-5, "{}", decoded.pixels[1]);
        let cut = bytes.get_ref()[..40].to_vec();
        assert!(held(cut).decode().unwrap_err().to_string().starts_with("a.glb: images[0]: "));
        for (width, height) in [(LONGEST_SIDE + 1, 1), (1, LONGEST_SIDE + 1)] {
            let mut bytes = Cursor::new(Vec::new());
            let image = image::GrayImage::new(width, height);
            image.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
            let told = held(bytes.into_inner()).decode().unwrap_err().to_string();
            assert!(told.contains("expected a picture of at most 16384 x 16384 pixels"), "{told}");
        }
    }
}
