//! Pictures that strands take their colours from.

use std::path::Path;

use anyhow::{Context, Result};
use glam::Vec3;
use groom::{GroomError, Texture, VAxis};

/// A picture in linear Rec. 709.
pub(crate) struct Picture {
    width: usize,
    pixels: Vec<Vec3>,
}

impl Picture {
    /// Reads a .png, which is taken for sRGB, or a .hdr, which is linear; transparency is ignored.
    pub(crate) fn load(path: &Path) -> Result<Picture> {
        let (width, pixels) = fibre_material::linear_pixels(path).context("--color-from-texture")?;
        Ok(Picture { width, pixels })
    }

    /// The picture, to be looked up.
    pub(crate) fn texture(&self, v_axis: VAxis) -> Result<Texture<'_>, GroomError> {
        Texture::new(self.width, &self.pixels, v_axis)
    }
}
