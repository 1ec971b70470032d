//! Pieces of a mesh that have a material in common.

use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;

use crate::texture::TextureSource;
use crate::{MeshError, TextureImage};

/// Triangles in a row that come from one place of the file and have one material.
#[derive(Clone, Debug)]
pub struct Part {
    /// What the file calls it; empty when it does not.
    pub name: String,
    /// The name of its material. A material without one is `None`, like no material.
    pub material: Option<String>,
    /// Which of the mesh's triangles.
    pub triangles: Range<usize>,
    /// Linear Rec. 709, what the texture is multiplied by; white when the file says nothing.
    pub base_color: Vec3,
    /// Whether the file has texture coordinates here; where not, they are 0.
    pub has_uvs: bool,
    pub(crate) texture: Option<Arc<TextureSource>>,
}

impl Part {
    /// Whether there is a picture of its base colour, which may still turn out to be unreadable.
    #[must_use]
    pub fn has_texture(&self) -> bool {
        self.texture.is_some()
    }

    /// The picture of its base colour, loaded and decoded now.
    ///
    /// # Errors
    /// [`MeshError`] when the picture is missing, reached by an address that is not allowed, or no PNG or JPEG.
    pub fn texture(&self) -> Result<Option<TextureImage>, MeshError> {
        self.texture.as_ref().map(|source| source.decode()).transpose()
    }
}
