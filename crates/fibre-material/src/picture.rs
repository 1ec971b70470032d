//! Pictures that strands take their colours from.

use std::path::Path;
use std::sync::Arc;

use glam::Vec3;
use groom::{Texture, VAxis};
use image::{DynamicImage, ImageFormat, ImageReader};

use crate::MaterialError;

/// A picture in linear Rec. 709, every channel in 0..1.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    width: usize,
    pixels: Vec<Vec3>,
}

impl Picture {
    /// A picture of `width` columns, row after row from the top.
    ///
    /// # Errors
    /// [`MaterialError::Value`] for a channel outside 0..1, [`MaterialError::Groom`] unless the pixels fill at
    /// least one row and the last one whole.
    pub fn new(width: usize, pixels: Vec<Vec3>) -> Result<Picture, MaterialError> {
        Texture::new(width, &pixels, VAxis::Up)?;
        let odd = |pixel: &Vec3| !pixel.to_array().iter().all(|v| (0.0..=1.0).contains(v));
        if let Some(index) = pixels.iter().position(odd) {
            let what = format!("pixel {}, {}", index % width, index / width);
            return Err(MaterialError::value(what, pixels[index], "a colour of channels in 0..1"));
        }
        Ok(Picture { width, pixels })
    }

    /// Reads a .png, which is taken for sRGB, or a .hdr, which is linear; transparency is ignored.
    ///
    /// # Errors
    /// [`MaterialError::Io`], or [`MaterialError::Picture`] for what is no such picture or no colours.
    pub fn open(path: &Path) -> Result<Picture, MaterialError> {
        let (width, pixels) = linear_pixels(path)?;
        Picture::new(width, pixels).map_err(|error| MaterialError::picture(path, error))
    }

    /// Stands for the picture in a file that is there and need not be read: its colours matter to no check.
    ///
    /// # Errors
    /// [`MaterialError::Io`] or [`MaterialError::Picture`] for what is no file.
    pub fn unread(path: &Path) -> Result<Arc<Picture>, MaterialError> {
        match std::fs::metadata(path) {
            Ok(data) if data.is_file() => Ok(Arc::new(Picture { width: 1, pixels: vec![Vec3::ONE] })),
            Ok(_) => Err(MaterialError::picture(path, "it is no file")),
            Err(source) => Err(MaterialError::Io { path: path.to_owned(), source }),
        }
    }

    /// The picture, to be looked up.
    ///
    /// # Errors
    /// None that a picture can cause: its pixels fill their rows.
    pub fn texture(&self, v_axis: VAxis) -> Result<Texture<'_>, MaterialError> {
        Ok(Texture::new(self.width, &self.pixels, v_axis)?)
    }

    /// The mean colour.
    #[must_use]
    pub fn mean(&self) -> Vec3 {
        let sum: glam::DVec3 = self.pixels.iter().map(|pixel| pixel.as_dvec3()).sum();
        (sum / self.pixels.len().max(1) as f64).as_vec3()
    }
}

/// The columns and pixels of a .png, which is taken for sRGB, or a .hdr, which is linear, row after row from the
/// top, in linear Rec. 709; transparency is ignored. A .hdr's may be brighter than 1, which is no colour of hair.
///
/// # Errors
/// [`MaterialError::Io`], or [`MaterialError::Picture`] for what is no such picture.
pub fn linear_pixels(path: &Path) -> Result<(usize, Vec<Vec3>), MaterialError> {
    let io = |source| MaterialError::Io { path: path.to_owned(), source };
    let reader = ImageReader::open(path).map_err(io)?.with_guessed_format().map_err(io)?;
    let Some(ImageFormat::Png | ImageFormat::Hdr) = reader.format() else {
        return Err(MaterialError::picture(path, "expected a .png or .hdr picture"));
    };
    let picture = reader.decode().map_err(|error| MaterialError::picture(path, error))?;
    let width = picture.width() as usize;
    let pixels = match picture {
        DynamicImage::ImageRgb32F(linear) => linear.pixels().map(|p| Vec3::from(p.0)).collect(),
        coded => {
            let linear: Vec<f32> = (0..=u16::MAX).map(|v| linear(f32::from(v) / 65535.0)).collect();
            let coded = coded.into_rgb16();
            coded.pixels().map(|p| Vec3::from(p.0.map(|v| linear[usize::from(v)]))).collect()
        }
    };
    Ok((width, pixels))
}

/// IEC 61966-2-1.
fn linear(coded: f32) -> f32 {
    if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_colours_in_whole_rows() {
        let picture = Picture::new(2, vec![Vec3::ZERO, Vec3::ONE]).unwrap();
        assert_eq!(picture.mean(), Vec3::splat(0.5));
        assert!(Picture::new(2, vec![Vec3::ZERO; 3]).is_err());
        for odd in [Vec3::splat(1.5), Vec3::new(0.0, f32::NAN, 0.0), Vec3::NEG_X] {
            let told = Picture::new(1, vec![Vec3::ZERO, odd]).unwrap_err().to_string();
            assert!(told.starts_with("pixel 0, 1 is ["), "{told}");
        }
    }

    #[test]
    fn srgb_is_made_linear() {
        assert_eq!((linear(0.0), linear(1.0)), (0.0, 1.0));
        assert!((linear(0.5) - 0.214_041).abs() < 1e-6);
    }
}
