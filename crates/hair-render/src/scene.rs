//! A scene ready to be traced: one world, one unit, one centre.

use glam::DVec3;
use groom::Groom;
use strand_tracing::Tracer;

use crate::fibres::Fibres;
use crate::lights::Lights;
use crate::placing::{bounds_of, build_tracer};
use crate::surface::Surface;
use crate::{
    Bounds, HairMaterial, HairObject, MeshObject, Motion, RenderError, SceneDescription, Shutter, TableUse,
};

/// A scene ready to be rendered, any number of times and from any number of threads.
#[derive(Debug)]
pub struct Scene {
    pub(crate) tracer: Tracer,
    pub(crate) fibres: Vec<Fibres>,
    pub(crate) surfaces: Vec<Surface>,
    pub(crate) lights: Lights,
    bounds: Option<Bounds>,
    center: DVec3,
    shutter: Shutter,
    motion_keys: Option<usize>,
}

impl Scene {
    /// Turns everything to Y up and metres, moves the scene's centre to the origin, works out
    /// absorptions and builds the tree and the light tables that this scene needs.
    ///
    /// # Errors
    /// [`RenderError::Argument`], also for motion under a shutter that sees but an instant;
    /// [`RenderError::Scattering`] or [`RenderError::Tracing`].
    pub fn build(description: SceneDescription) -> Result<Self, RenderError> {
        let SceneDescription { hair, meshes, environment, lights, shutter } = description;
        let motion_keys = motions(&hair, &meshes).map(Motion::key_count).max();
        shutter.check_lasts(motion_keys.is_some())?;
        lights.iter().try_for_each(|light| light.check())?;
        hair.iter().try_for_each(HairObject::check)?;
        meshes.iter().try_for_each(MeshObject::check)?;
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
        Ok(Scene { tracer, fibres: fibres?, surfaces, lights, bounds, center, shutter, motion_keys })
    }

    /// When light is let in.
    #[must_use]
    pub fn shutter(&self) -> &Shutter {
        &self.shutter
    }

    /// The most keys of anything that moves while the shutter is open; `None` where nothing does.
    #[must_use]
    pub fn motion_keys(&self) -> Option<usize> {
        self.motion_keys
    }

    /// The box about all hair and meshes, wherever they go while the shutter is open, in world metres; `None`
    /// when there is nothing.
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

/// All motion that moves anything.
fn motions<'a>(hair: &'a [HairObject], meshes: &'a [MeshObject]) -> impl Iterator<Item = &'a Motion> {
    let of_meshes = meshes.iter().flat_map(|mesh| [&mesh.motion, &mesh.turning]);
    hair.iter().map(|hair| &hair.motion).chain(of_meshes).filter(|motion| motion.moves())
}

impl SceneDescription {
    /// Whether anything of it moves while the shutter is open.
    #[must_use]
    pub fn moves(&self) -> bool {
        motions(&self.hair, &self.meshes).next().is_some()
    }

    /// The box about all hair and meshes, wherever they go while the shutter is open, in world metres, Y up;
    /// `None` when there is nothing.
    #[must_use]
    pub fn bounds(&self) -> Option<Bounds> {
        bounds_of(&self.hair, &self.meshes)
    }
}
