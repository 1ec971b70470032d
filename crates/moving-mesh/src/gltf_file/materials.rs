//! How a primitive looks.

use std::path::Path;
use std::sync::Arc;

use glam::Vec3;
use gltf::{Image, Primitive};
use gltf_bytes::{Asset, ImageBytes};

use crate::shape::Look;
use crate::texture::TextureSource;

/// The pictures of a document, each taken from it once.
pub(super) struct Materials<'a> {
    asset: &'a Asset<'a>,
    path: &'a Path,
    images: Vec<Option<Arc<TextureSource>>>,
}

impl<'a> Materials<'a> {
    pub(super) fn new(asset: &'a Asset<'a>, path: &'a Path) -> Self {
        Materials { asset, path, images: vec![None; asset.document.images().len()] }
    }

    /// The look of a primitive, and the set of texture coordinates that goes with it.
    pub(super) fn look(&mut self, primitive: &Primitive<'_>) -> (Look, u32) {
        let material = primitive.material();
        let surface = material.pbr_metallic_roughness();
        let [r, g, b, _] = surface.base_color_factor();
        let texture = surface.base_color_texture();
        let look = Look {
            material: material.name().map(str::to_owned),
            base_color: Vec3::new(r, g, b),
            texture: texture.as_ref().map(|texture| self.image(&texture.texture().source())),
        };
        (look, texture.map_or(0, |texture| texture.tex_coord()))
    }

    fn image(&mut self, image: &Image<'_>) -> Arc<TextureSource> {
        if let Some(Some(known)) = self.images.get(image.index()) {
            return Arc::clone(known);
        }
        let (path, place) = (self.path.to_owned(), format!("images[{}]", image.index()));
        let source = match ImageBytes::of(image, &self.asset.buffers, self.path.parent()) {
            Ok(ImageBytes::Held(bytes)) => TextureSource::Held { bytes, path, place },
            Ok(ImageBytes::File(file)) => TextureSource::File(file),
            Err(error) => TextureSource::Lost { path, place, fault: error.to_string() },
        };
        let source = Arc::new(source);
        if let Some(place) = self.images.get_mut(image.index()) {
            *place = Some(Arc::clone(&source));
        }
        source
    }
}
