//! What stays as it is while a mesh moves.

use std::ops::Range;
use std::sync::Arc;

use glam::{Vec2, Vec3};

use crate::Part;
use crate::error::Fault;
use crate::texture::TextureSource;

/// Triangles, texture coordinates and materials.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shape {
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) vertex_count: usize,
    /// One a vertex, 0 where a part has none.
    pub(crate) uvs: Vec<Vec2>,
    pub(crate) parts: Vec<Part>,
}

/// How a part looks.
#[derive(Clone, Debug)]
pub(crate) struct Look {
    pub(crate) material: Option<String>,
    pub(crate) base_color: Vec3,
    pub(crate) texture: Option<Arc<TextureSource>>,
}

impl Default for Look {
    fn default() -> Self {
        Look { material: None, base_color: Vec3::ONE, texture: None }
    }
}

impl Shape {
    /// Adds a part of `vertices` vertices; `triangles` count its own from 0.
    pub(crate) fn append(
        &mut self,
        name: String,
        vertices: usize,
        triangles: &[[u32; 3]],
        uvs: Option<&[Vec2]>,
        look: Look,
    ) -> Result<(), Fault> {
        self.append_parts(vertices, triangles, uvs, vec![(name, 0..triangles.len(), look)])
    }

    /// As [`Shape::append`], for several parts that have vertices in common.
    pub(crate) fn append_parts(
        &mut self,
        vertices: usize,
        triangles: &[[u32; 3]],
        uvs: Option<&[Vec2]>,
        parts: Vec<(String, Range<usize>, Look)>,
    ) -> Result<(), Fault> {
        let outside = triangles.iter().position(|t| t.iter().any(|&v| v as usize >= vertices));
        if let Some(i) = outside {
            let fault =
                format!("vertex indices {:?}, expected below the vertex count {vertices}", triangles[i]);
            let name = parts.first().map_or("", |(name, ..)| name);
            return Err(Fault::invalid(format!("{name} triangle {i}"), fault));
        }
        let total = self.vertex_count.saturating_add(vertices);
        u32::try_from(total).map_err(|_| Fault::Unsupported {
            what: "a mesh of more than 4,294,967,295 vertices".into(),
            remedy: "split it",
        })?;
        let (base, first) = (self.vertex_count as u32, self.triangles.len());
        self.triangles.extend(triangles.iter().map(|t| t.map(|i| i + base)));
        self.vertex_count = total;
        self.uvs.extend(uvs.unwrap_or_default());
        self.uvs.resize(total, Vec2::ZERO);
        self.parts.extend(parts.into_iter().map(|(name, range, look)| Part {
            name,
            material: look.material,
            triangles: first + range.start..first + range.end,
            base_color: look.base_color,
            has_uvs: uvs.is_some(),
            texture: look.texture,
        }));
        Ok(())
    }

    pub(crate) fn checked(self) -> Result<Self, Fault> {
        if self.triangles.is_empty() {
            return Err(Fault::invalid("mesh", "no triangles, expected at least one"));
        }
        Ok(self)
    }
}
