//! What a scene is made of, before anything is built from it.

use fibre_material::Material;
use glam::{DVec3, Vec3};
use groom::Groom;
use moving_mesh::TriangleMesh;

use crate::{AreaLight, Environment, Motion, Shutter};

/// What the groom's `transparency` attribute does to light.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Transparency {
    /// Nothing. Chiang's fibre already lets light through by refraction, and the HAIR files in
    /// circulation carry values meant for opaque line drawing; obeying them would count it twice.
    #[default]
    Ignored,
    /// A ray passes a fibre untouched with this probability, decided anew for each fibre it meets.
    Stochastic,
}

/// How the strands of a groom scatter light.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HairMaterial {
    /// Colour, roughness, medulla, variation.
    pub fibre: Material,
    /// What the groom's transparency does.
    pub transparency: Transparency,
    /// For looking into a material, not for pictures: one offset across the fibre, in -1..1, in place of
    /// the one each ray has. Where a fibre is met is geometry; fixing it takes the variation across the
    /// fibre away (the "shift" of some older shaders, where -1 and 1 are all mirror).
    pub fixed_offset: Option<f32>,
}

/// Strands and how they scatter.
#[derive(Clone, Debug, PartialEq)]
pub struct HairObject {
    /// The strands, in the groom's own unit and axes.
    pub groom: Groom,
    /// How they scatter.
    pub material: HairMaterial,
    /// What the groom's positions are relative to, in its unit and axes: 0, or the place of a character so far
    /// away that single precision would lose its shape.
    pub origin: DVec3,
    /// Where the strands go while the shutter is open, in the groom's unit and axes, relative to `origin`. Their
    /// radii, and all else about them, are the groom's throughout.
    pub motion: Motion,
}

impl HairObject {
    /// Strands that stand still, in their own coordinates.
    #[must_use]
    pub fn still(groom: Groom, material: HairMaterial) -> Self {
        HairObject { groom, material, origin: DVec3::ZERO, motion: Motion::STILL }
    }
}

/// A matte mesh: both sides reflect by Lambert's law, smoothly where the mesh has normals, as flat
/// triangles where it has none.
#[derive(Clone, Debug)]
pub struct MeshObject {
    /// The triangles, in world metres, Y up.
    pub mesh: TriangleMesh,
    /// Reflected share of the light, linear Rec. 709, 0..1.
    pub albedo: Vec3,
    /// What the mesh's positions are relative to, in world metres.
    pub origin: DVec3,
    /// Where the vertices go while the shutter is open, in world metres relative to `origin`.
    pub motion: Motion,
    /// How the vertices' normals turn meanwhile, where the mesh has any; they stay as they are when nothing is
    /// said.
    pub turning: Motion,
}

impl MeshObject {
    /// A mesh that stands still, in world coordinates.
    #[must_use]
    pub fn still(mesh: TriangleMesh, albedo: Vec3) -> Self {
        MeshObject { mesh, albedo, origin: DVec3::ZERO, motion: Motion::STILL, turning: Motion::STILL }
    }
}

/// A scene as its parts; see [`crate::Scene::build`].
#[derive(Clone, Debug, Default)]
pub struct SceneDescription {
    /// Grooms with their materials.
    pub hair: Vec<HairObject>,
    /// Meshes: heads, floors.
    pub meshes: Vec<MeshObject>,
    /// Light from all around, if any.
    pub environment: Option<Environment>,
    /// Shining rectangles, in world metres, Y up.
    pub lights: Vec<AreaLight>,
    /// When light is let in: what the keys of all motion are spread over. Nothing comes of it where nothing
    /// moves.
    pub shutter: Shutter,
}
