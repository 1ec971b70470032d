//! A scene ready to be traced: one world, one unit, one centre.

use glam::{DVec3, Vec3};
use groom::{FloatView, Groom, UpAxis};
use strand_tracing::{BuildOptions, Radii, Strands, Tracer, Triangles};

use crate::fibres::Fibres;
use crate::lights::Lights;
use crate::surface::Surface;
use crate::{Bounds, HairMaterial, HairObject, MeshObject, RenderError, SceneDescription, TableUse};

/// A scene ready to be rendered, any number of times and from any number of threads.
#[derive(Debug)]
pub struct Scene {
    pub(crate) tracer: Tracer,
    pub(crate) fibres: Vec<Fibres>,
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) lights: Lights,
    bounds: Option<Bounds>,
    center: DVec3,
}

impl Scene {
    /// Turns everything to Y up and metres, moves the scene's centre to the origin, works out
    /// absorptions and builds the tree and the light tables that this scene needs.
    ///
    /// # Errors
    /// [`RenderError::Argument`], [`RenderError::Scattering`] or [`RenderError::Tracing`].
    pub fn build(description: SceneDescription) -> Result<Self, RenderError> {
        let SceneDescription { hair, meshes, environment, lights } = description;
        lights.iter().try_for_each(|light| light.check())?;
        for object in &hair {
            let unit = object.groom.meters_per_unit;
            if !(unit > 0.0 && unit.is_finite()) {
                return Err(RenderError::argument("metres per unit", unit, "above 0"));
            }
        }
        let bounds = bounds_of(&hair, &meshes);
        let center = bounds.map_or(DVec3::ZERO, |b| b.center());
        let fibres: Result<Vec<_>, _> = hair
            .iter()
            .enumerate()
            .map(|(index, object)| Fibres::new(index, &object.groom, &object.material))
            .collect();
        let surfaces = meshes.iter().map(Surface::new).collect::<Result<_, _>>()?;
        let tracer = build_tracer(&hair, &meshes, center)?;
        let lights = Lights::new(environment, &lights, center);
        Ok(Scene { tracer, fibres: fibres?, surfaces, lights, bounds, center })
    }

    /// The box about all hair and meshes in world metres; `None` when there is nothing.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds> {
        self.bounds
    }

    /// Where the origin of the traced geometry lies in the world.
    #[must_use]
    pub fn center(&self) -> DVec3 {
        self.center
    }

    /// Counts, bytes and seconds of the tree over strands and triangles.
    #[must_use]
    pub fn tracing_statistics(&self) -> &strand_tracing::Statistics {
        self.tracer.statistics()
    }

    /// Gives a groom of the scene another material, and keeps the tree: for looking at many. `groom` is the
    /// one that object `object` was built from.
    ///
    /// # Errors
    /// [`RenderError::Argument`] for an object that is not there or a groom of other counts; what is wrong with
    /// the material as [`Scene::build`]. The scene is then as it was.
    pub fn set_material(
        &mut self,
        object: usize,
        groom: &Groom,
        material: &HairMaterial,
    ) -> Result<(), RenderError> {
        let count = self.fibres.len();
        let Some(place) = self.fibres.get_mut(object) else {
            return Err(RenderError::argument(
                "hair object",
                format!("{object} of {count}"),
                "one of the scene's",
            ));
        };
        if place.counts() != (groom.strand_count(), groom.point_count()) {
            let found = format!("{} strands, {} points", groom.strand_count(), groom.point_count());
            return Err(RenderError::argument(
                "groom to dress",
                found,
                "as many as the scene was built with",
            ));
        }
        *place = Fibres::new(object, groom, material)?;
        Ok(())
    }

    /// The medulla tables of the scene's fur; none for hair.
    pub fn medulla_tables(&self) -> impl Iterator<Item = &TableUse> {
        self.fibres.iter().filter_map(Fibres::table)
    }

    /// Turns the environment to stand at `angle` radians (see [`crate::Environment::rotated`]) without
    /// building anything again, as a turntable of light wants it.
    pub fn turn_environment(&mut self, angle: f32) {
        self.lights.turn_environment(angle);
    }
}

impl SceneDescription {
    /// The box about all hair and meshes in world metres, Y up; `None` when there is nothing.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds> {
        bounds_of(&self.hair, &self.meshes)
    }
}

/// Turns a groom's numbers into world metres, Y up.
fn to_world(groom: &Groom, point: Vec3) -> DVec3 {
    groom.up_axis.rotate(point, UpAxis::Y).as_dvec3() * groom.meters_per_unit
}

fn bounds_of(hair: &[HairObject], meshes: &[MeshObject]) -> Option<Bounds> {
    let of_hair = hair.iter().filter_map(|object| {
        Bounds::of_points(object.groom.positions().iter().map(|&p| to_world(&object.groom, p)))
    });
    let of_meshes =
        meshes.iter().filter_map(|m| Bounds::of_points(m.mesh.positions.iter().map(|p| p.as_dvec3())));
    of_hair.chain(of_meshes).reduce(Bounds::union)
}

/// Positions about the centre, in metres; the subtraction is done where it loses nothing.
fn recentred(groom: &Groom, center: DVec3) -> Vec<Vec3> {
    groom.positions().iter().map(|&p| (to_world(groom, p) - center).as_vec3()).collect()
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

fn build_tracer(hair: &[HairObject], meshes: &[MeshObject], center: DVec3) -> Result<Tracer, RenderError> {
    let points: Vec<Vec<Vec3>> = hair.iter().map(|object| recentred(&object.groom, center)).collect();
    let radii: Vec<OwnRadii> = hair.iter().map(|object| radii_of(&object.groom)).collect();
    let strands: Vec<Strands> = hair
        .iter()
        .zip(points.iter().zip(&radii))
        .map(|(object, (positions, radii))| Strands {
            offsets: object.groom.offsets(),
            positions,
            moved: &[],
            radii: match radii {
                OwnRadii::Constant(radius) => Radii::Constant(*radius),
                OwnRadii::PerVertex(radii) => Radii::PerVertex(radii),
            },
        })
        .collect();
    let vertices: Vec<Vec<Vec3>> = meshes
        .iter()
        .map(|m| m.mesh.positions.iter().map(|p| (p.as_dvec3() - center).as_vec3()).collect())
        .collect();
    let triangles: Vec<Triangles> = meshes
        .iter()
        .zip(&vertices)
        .map(|(m, positions)| Triangles { positions, indices: &m.mesh.triangles, moved: &[] })
        .collect();
    Ok(Tracer::build(&strands, &triangles, &BuildOptions::default())?)
}
