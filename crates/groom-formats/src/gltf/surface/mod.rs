//! Strands as triangles.
//!
//! A tube has a ring of `sides` vertices around every point, perpendicular to the strand there and `radius` away
//! from the point, and a flat cap at each end that shares the ring: the surface is closed, and its normals
//! are those of the sides. A ribbon has two vertices a point, `radius` to either side of it, and a double-sided
//! material. Both are carried along the strand by a frame that turns no more than the strand does.
//!
//! TEXCOORD_0 is the root UV with v turned down, as glTF has it, where the groom has one; else across (0 to 1 for a
//! ribbon, 0 to 1 and back around a tube) and along (0 at the root, 1 at the tip, by length).

mod frames;
mod triangles;
mod vertices;

use groom::{Attribute, Domain, Groom, Values, names};

use glam::Vec2;

use crate::drawable::Drawable;
use crate::{Mesh, WriteOptions};

pub(super) use triangles::write as write_triangles;
pub(super) use vertices::{bounds, write as write_vertices};

/// Sides a tube can have.
const SIDES: std::ops::RangeInclusive<u32> = 3..=32;

/// What strands become.
#[derive(Clone)]
pub(super) struct Surface<'a> {
    /// Cosine and sine around the strand, and how far across the texture; two entries for a ribbon.
    around: Vec<([f32; 2], f32)>,
    is_tube: bool,
    root_uv: Option<&'a Attribute>,
}

impl<'a> Surface<'a> {
    pub(super) fn of(groom: &'a Groom, options: &WriteOptions) -> Option<Self> {
        let root_uv = groom.attribute(names::ROOT_UV);
        let (around, is_tube) = match options.mesh? {
            Mesh::Ribbons => (vec![([-1.0, 0.0], 0.0), ([1.0, 0.0], 1.0)], false),
            Mesh::Tubes { sides } => {
                let sides = sides.clamp(*SIDES.start(), *SIDES.end());
                let side = |i: u32| {
                    let turn = f64::from(i) / f64::from(sides);
                    let (sin, cos) = (turn * std::f64::consts::TAU).sin_cos();
                    ([cos as f32, sin as f32], (1.0 - (2.0 * turn - 1.0).abs()) as f32)
                };
                ((0..sides).map(side).collect(), true)
            }
        };
        Some(Surface { around, is_tube, root_uv })
    }

    pub(super) fn is_ribbon(&self) -> bool {
        !self.is_tube
    }

    /// Vertices a point.
    pub(super) fn per_point(&self) -> usize {
        self.around.len()
    }

    /// Indices of all triangles.
    pub(super) fn index_count(&self, drawable: Drawable<'_>) -> usize {
        let segments = drawable.points - drawable.strands;
        let sides = self.around.len();
        match self.is_tube {
            true => 6 * (sides * segments + (sides - 2) * drawable.strands),
            false => 6 * segments,
        }
    }

    /// Where the strand's root is on its mesh, v down; `None` if the groom does not say.
    fn root_uv(&self, strand: usize, vertex: usize) -> Option<Vec2> {
        let attribute = self.root_uv?;
        let Values::Vec2(values) = &attribute.values else { return None };
        let place = match attribute.domain {
            Domain::Groom => 0,
            Domain::Strand => strand,
            Domain::Vertex => vertex,
        };
        let uv = values.get(place).filter(|uv| uv.is_finite())?;
        Some(Vec2::new(uv.x, 1.0 - uv.y))
    }
}
