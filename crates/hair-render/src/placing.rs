//! Everything of a scene in one world, about one centre, ready for the tracer.

use glam::{DVec3, Vec3};
use groom::{FloatView, Groom, UpAxis};
use strand_tracing::{BuildOptions, Radii, Strands, Tracer, Triangles};

use crate::{Bounds, HairObject, MeshObject, RenderError};

impl HairObject {
    /// Whether it can be placed.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        let unit = self.groom.meters_per_unit;
        if !(unit > 0.0 && unit.is_finite()) {
            return Err(RenderError::argument("metres per unit", unit, "above 0"));
        }
        check_origin(self.origin)?;
        self.motion.check("motion of hair", self.groom.point_count())
    }

    /// Turns the groom's numbers into world metres, Y up.
    fn to_world(&self, point: Vec3) -> DVec3 {
        (self.groom.up_axis.rotate(point, UpAxis::Y).as_dvec3() + self.turned_origin())
            * self.groom.meters_per_unit
    }

    fn turned_origin(&self) -> DVec3 {
        let DVec3 { x, y, z } = self.origin;
        match self.groom.up_axis {
            UpAxis::Y => self.origin,
            UpAxis::Z => DVec3::new(x, z, -y),
        }
    }
}

impl MeshObject {
    /// Whether it can be placed.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        check_origin(self.origin)?;
        self.motion.check("motion of a mesh", self.mesh.positions.len())
    }

    fn to_world(&self, point: Vec3) -> DVec3 {
        point.as_dvec3() + self.origin
    }
}

fn check_origin(origin: DVec3) -> Result<(), RenderError> {
    if origin.is_finite() {
        return Ok(());
    }
    Err(RenderError::argument("origin", origin, "finite numbers"))
}

/// Where the points of an object are at each of its keys; one key for what stands still.
fn keys<'a>(moving: &'a [Vec<Vec3>], still: &'a [Vec3]) -> impl Iterator<Item = &'a [Vec3]> {
    let still = moving.is_empty().then_some(still);
    moving.iter().map(Vec::as_slice).chain(still)
}

/// The box about all hair and meshes at all keys, in world metres; `None` when there is nothing.
pub(crate) fn bounds_of(hair: &[HairObject], meshes: &[MeshObject]) -> Option<Bounds> {
    let of_hair = hair.iter().filter_map(|object| {
        let keys = keys(object.motion.distinct(), object.groom.positions());
        Bounds::of_points(keys.flatten().map(|&p| object.to_world(p)))
    });
    let of_meshes = meshes.iter().filter_map(|object| {
        let keys = keys(object.motion.distinct(), &object.mesh.positions);
        Bounds::of_points(keys.flatten().map(|&p| object.to_world(p)))
    });
    of_hair.chain(of_meshes).reduce(Bounds::union)
}

enum OwnRadii {
    Constant(f32),
    PerVertex(Vec<f32>),
}

fn radii_of(groom: &Groom) -> OwnRadii {
    let scale = |radius: f32| (f64::from(radius) * groom.meters_per_unit) as f32;
    match groom.radii() {
        FloatView::Constant(radius) => OwnRadii::Constant(scale(radius)),
        FloatView::Vertex(radii) => OwnRadii::PerVertex(radii.iter().copied().map(scale).collect()),
        FloatView::Strand(radii) => OwnRadii::PerVertex(
            (0..groom.strand_count())
                .flat_map(|i| std::iter::repeat_n(scale(radii[i]), groom.strand_range(i).len()))
                .collect(),
        ),
    }
}

/// Positions of every key about the centre, in metres; the subtraction is done where it loses nothing.
type Placed = Vec<Vec<Vec3>>;

fn placed<'a>(
    keys: impl Iterator<Item = &'a [Vec3]>,
    to_world: impl Fn(Vec3) -> DVec3,
    center: DVec3,
) -> Placed {
    keys.map(|key| key.iter().map(|&p| (to_world(p) - center).as_vec3()).collect()).collect()
}

/// The positions at opening, and those at further keys.
fn split(placed: &Placed) -> (&[Vec3], Vec<&[Vec3]>) {
    let first = placed.first().map(Vec::as_slice).unwrap_or_default();
    (first, placed.iter().skip(1).map(Vec::as_slice).collect())
}

pub(crate) fn build_tracer(
    hair: &[HairObject],
    meshes: &[MeshObject],
    center: DVec3,
) -> Result<Tracer, RenderError> {
    let points = |object: &HairObject| {
        let keys = keys(object.motion.distinct(), object.groom.positions());
        placed(keys, |p| object.to_world(p), center)
    };
    let points: Vec<Placed> = hair.iter().map(points).collect();
    let points: Vec<_> = points.iter().map(split).collect();
    let radii: Vec<OwnRadii> = hair.iter().map(|object| radii_of(&object.groom)).collect();
    let strands: Vec<Strands> = hair
        .iter()
        .zip(points.iter().zip(&radii))
        .map(|(object, ((positions, moved), radii))| Strands {
            offsets: object.groom.offsets(),
            positions,
            moved,
            radii: match radii {
                OwnRadii::Constant(radius) => Radii::Constant(*radius),
                OwnRadii::PerVertex(radii) => Radii::PerVertex(radii),
            },
        })
        .collect();
    let vertices = |object: &MeshObject| {
        let keys = keys(object.motion.distinct(), &object.mesh.positions);
        placed(keys, |p| object.to_world(p), center)
    };
    let vertices: Vec<Placed> = meshes.iter().map(vertices).collect();
    let vertices: Vec<_> = vertices.iter().map(split).collect();
    let triangles: Vec<Triangles> = meshes
        .iter()
        .zip(&vertices)
        .map(|(object, (positions, moved))| Triangles { positions, moved, indices: &object.mesh.triangles })
        .collect();
    Ok(Tracer::build(&strands, &triangles, &BuildOptions::default())?)
}
