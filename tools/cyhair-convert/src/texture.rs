//! Pictures that strands take their colours from.

use std::path::Path;

use anyhow::{Context, Result, bail};
use glam::Vec3;
use groom::{GroomError, Texture, VAxis};
use image::{DynamicImage, ImageFormat, ImageReader};

/// A picture in linear Rec. 709.
pub(crate) struct Picture {
    width: usize,
    pixels: Vec<Vec3>,
}

impl Picture {
    /// Reads a .png, which is taken for sRGB, or a .hdr, which is linear; transparency is ignored.
    pub(crate) fn load(path: &Path) -> Result<Picture> {
        let name = || format!("--color-from-texture {}", path.display());
        let reader = ImageReader::open(path).with_context(name)?.with_guessed_format().with_context(name)?;
        let Some(ImageFormat::Png | ImageFormat::Hdr) = reader.format() else {
            bail!("{}: expected a .png or .hdr picture", name());
        };
        let picture = reader.decode().with_context(name)?;
        let width = picture.width() as usize;
        let pixels = match picture {
            DynamicImage::ImageRgb32F(linear) => linear.pixels().map(|p| Vec3::from(p.0)).collect(),
            coded => {
                let linear: Vec<f32> = (0..=u16::MAX).map(|v| linear(f32::from(v) / 65535.0)).collect();
                let coded = coded.into_rgb16();
                coded.pixels().map(|p| Vec3::from(p.0.map(|v| linear[usize::from(v)]))).collect()
            }
        };
        Ok(Picture { width, pixels })
    }

    /// The picture, to be looked up.
    pub(crate) fn texture(&self, v_axis: VAxis) -> Result<Texture<'_>, GroomError> {
        Texture::new(self.width, &self.pixels, v_axis)
    }
}

/// IEC 61966-2-1.
fn linear(coded: f32) -> f32 {
    if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) }
}
