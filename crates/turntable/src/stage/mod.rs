//! What stands before the camera, for every frame of a variant.
//!
//! | what | from | module |
//! |---|---|---|
//! | strands | a file or sample, still, animated or bound to the mesh | `hair`, `prepare` |
//! | a mesh | a file, still or animated | `meshes` |
//! | light | environment, rectangles, a Cornell box | `lights`, `cornell` |
//! | the camera | its circle, a place, a scene file | `cameras`, `views`, `framing` |
//!
//! What is the same in all frames is loaded and built once, and kept for the next variant that wants it (`store`).

mod cameras;
mod cornell;
mod framing;
mod fur;
mod hair;
pub(crate) mod ingredients;
mod lights;
pub(crate) mod material;
mod meshes;
mod prepare;
mod settings;
mod sources;
mod store;
#[cfg(test)]
mod tests;
pub(crate) mod views;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use groom::Groom;
use hair_render::{Blur, Bounds, HairMaterial, MovingCamera, Scene, SceneDescription};
use moving_scene::{Exposure, GroomAt};

pub(crate) use settings::{render_settings, tone_mapping};
pub(crate) use store::Store;

use crate::schema::{Pipeline, Turning};
use crate::{Event, Reporter, TurntableError};
use cameras::{Filming, Taken};
use framing::{Framing, Moving};
use hair::{Hair, Opening};
use lights::Shining;
use meshes::{Body, When};

/// A time that misses a frame by this part of one is at it.
const ROUNDING: f64 = 1e-4;

/// The groom of a variant: read or made up, then changed as the pipeline says.
pub(crate) fn groom(
    pipeline: &Pipeline,
    base: &Path,
    reporter: &dyn Reporter,
    store: &mut Store,
) -> Result<Arc<Groom>, TurntableError> {
    store.groom(ingredients::groom(pipeline, base)?, || {
        reporter.event(&Event::Stage("preparing the groom"));
        prepare::groom(pipeline, base, reporter)
    })
}

/// Everything that the frames of a variant have in common, loaded once.
pub(crate) struct Stage<'a> {
    pipeline: Pipeline,
    base: PathBuf,
    reporter: &'a dyn Reporter,
    exposure: Exposure,
    hair: Hair,
    body: Option<Body>,
    material: HairMaterial,
    lights: Shining,
    filming: Filming,
    /// The frame of the animation that the first picture shows; none where nothing is animated.
    first: Option<f64>,
    rate: f64,
    framing: Option<Framing>,
    built: Option<Arc<Scene>>,
    told: BTreeSet<String>,
}

/// One frame, ready to be rendered.
pub(crate) struct View<'a> {
    pub scene: &'a Scene,
    pub camera: MovingCamera,
    /// Frames a second, where something moves.
    pub frame_rate: Option<f64>,
    /// How long the shutter is open, where something moves meanwhile.
    pub exposure_seconds: Option<f64>,
}

impl<'a> Stage<'a> {
    /// Loads what the frames of a variant need.
    pub fn set(
        pipeline: &Pipeline,
        base: &Path,
        reporter: &'a dyn Reporter,
        store: &mut Store,
    ) -> Result<Stage<'a>, TurntableError> {
        let exposure = settings::exposure(pipeline.motion.as_ref())?;
        let filming = Filming::set(pipeline, base)?;
        let (mut hair, opening) = strands(pipeline, base, &exposure, reporter, store)?;
        reporter.event(&Event::Stage("building the scene"));
        let known = pipeline.motion.as_ref().and_then(|motion| motion.first.or(opening.frame));
        let when = When {
            moves: pipeline.motion.is_some(),
            frames: known.map(|first| framing::shown(pipeline, first)),
            keys: opening.keys.unwrap_or_else(|| exposure.keys(exposure.blur.unwrap_or(Blur::Positions))),
            groom_rate: opening.frame_rate,
        };
        let body = Body::open(pipeline, base, &when, &exposure)?;
        let filmed = body.as_ref().and_then(Body::filmed);
        let mesh_rate = filmed.and_then(|filmed| filmed.mesh.mesh().frame_rate());
        let rate = exposure.rate(opening.frame_rate, mesh_rate.or(filming.frame_rate()));
        let first = pipeline.motion.as_ref().map(|_| {
            let of_mesh = filmed.and_then(|filmed| filmed.mesh.frames(rate)).map(|(first, _)| first);
            let begins = of_mesh.or(filming.first_frame()).unwrap_or_default();
            known.unwrap_or((begins - ROUNDING).ceil())
        });
        if let Some(bind) = &pipeline.bind {
            let (Some(filmed), Hair::Still(groom)) = (filmed, &hair) else {
                return Err(TurntableError::Stage("bind: there is no `mesh` to bind to".to_owned()));
            };
            let groom = Arc::clone(groom);
            hair = Hair::bound(&groom, pipeline, bind, (&filmed.mesh, &filmed.path), reporter)?;
        }
        let fibre = pipeline.material.clone().open_all(base)?;
        let mut stage = Stage {
            pipeline: pipeline.clone(),
            base: base.to_owned(),
            reporter,
            exposure,
            hair,
            body,
            material: HairMaterial { fibre, ..HairMaterial::default() },
            lights: Shining::load(&pipeline.lights, base)?,
            filming,
            first,
            rate,
            framing: None,
            built: None,
            told: BTreeSet::new(),
        };
        if !stage.moves() && pipeline.turntable.turn == Turning::Camera {
            stage.build_once(store)?;
        }
        Ok(stage)
    }

    /// The one scene of all frames.
    fn build_once(&mut self, store: &mut Store) -> Result<(), TurntableError> {
        let description = self.describe(1)?;
        let framing = Framing::of(&self.pipeline, description.bounds());
        self.framing = Some(framing);
        let groom = ingredients::groom(&self.pipeline, &self.base)?;
        let digest = ingredients::scene(&self.pipeline, &groom, &self.base)?;
        let description = self.lights.on(description, framing.room, 0.0);
        self.built = Some(store.scene(digest, || Scene::build(description))?);
        Ok(())
    }

    /// Frame `number`, from 1.
    pub fn view(&mut self, number: u32) -> Result<View<'_>, TurntableError> {
        let Framing { bounds, room } = self.framing()?;
        let turn = &self.pipeline.turntable;
        let azimuth = match turn.turn {
            Turning::Camera => 0.0,
            Turning::Groom => views::azimuth(turn, number).to_radians(),
        };
        let turns = turn.turn == Turning::Groom;
        let stays = !self.moves() && (!turns || self.lights.is_sky_alone());
        let mut built = self.built.take().filter(|_| stays);
        if let (true, Some(scene)) = (turns, &mut built) {
            let base = self.lights.sky_rotation();
            match Arc::get_mut(scene) {
                Some(scene) => scene.turn_environment(base + azimuth as f32),
                None => built = None,
            }
        }
        let scene = match built {
            Some(scene) => scene,
            None => {
                let description = self.describe(number)?;
                Arc::new(Scene::build(self.lights.on(description, room, azimuth))?)
            }
        };
        let taken = Taken { number, frame: self.frame(number), rate: self.rate, bounds, room };
        let camera = self.filming.camera(&taken, &self.exposure)?;
        self.filming.words(&taken).into_iter().for_each(|word| self.tell(&word));
        let scene: &Scene = self.built.insert(scene);
        let blurred = scene.motion_keys().is_some() || camera.moves();
        let [open, close] = self.exposure.shutter.seconds(self.rate)?;
        Ok(View {
            scene,
            camera,
            frame_rate: (blurred || self.first.is_some()).then_some(self.rate),
            exposure_seconds: blurred.then_some(close - open),
        })
    }

    /// Whether the scene is another one in other frames.
    fn moves(&self) -> bool {
        let filmed = matches!(self.hair, Hair::Filmed { .. });
        self.first.is_some() && (filmed || self.body.as_ref().is_some_and(Body::moves))
    }

    /// The frame of the animation that a picture shows.
    fn frame(&self, number: u32) -> Option<f64> {
        let step = self.pipeline.motion.as_ref()?.step;
        Some(self.first? + step * f64::from(number - 1))
    }

    /// Hair and mesh of a frame.
    fn describe(&mut self, number: u32) -> Result<SceneDescription, TurntableError> {
        let frame = self.frame(number);
        let mesh = self.body.as_ref().and_then(Body::filmed).map(|filmed| &filmed.mesh);
        let strands = self.hair.strands(frame, self.rate, mesh, &self.exposure, &self.material)?;
        let mut words = strands.words;
        let posed =
            self.body.as_ref().map(|body| body.posed(frame, self.rate, &self.exposure, strands.jumped));
        let mut meshes = Vec::new();
        if let Some(posed) = posed.transpose()? {
            meshes = posed.objects;
            words.extend(posed.words);
        }
        words.iter().for_each(|word| self.tell(word));
        let shutter = self.exposure.shutter.clone();
        Ok(SceneDescription { hair: vec![strands.object], meshes, shutter, ..SceneDescription::default() })
    }

    /// What all pictures frame; worked out for the first of them that is wanted.
    fn framing(&mut self) -> Result<Framing, TurntableError> {
        if let Some(framing) = self.framing {
            return Ok(framing);
        }
        let mut bounds = None;
        if framing::is_by_contents(&self.pipeline) {
            bounds = self.describe(1)?.bounds();
            if let Some(first) = self.first.filter(|_| self.moves()) {
                let (hair, body, exposure) = (&self.hair, self.body.as_ref(), &self.exposure);
                let moving = Moving { hair, body, exposure, rate: self.rate };
                let others = moving.bounds(framing::shown(&self.pipeline, first))?;
                bounds = [bounds, others].into_iter().flatten().reduce(Bounds::union);
            }
        }
        Ok(*self.framing.insert(Framing::of(&self.pipeline, bounds)))
    }

    /// Says something, once of all frames it holds for.
    fn tell(&mut self, word: &str) {
        let about = word.split(": frame ").next().unwrap_or(word);
        if self.told.insert(about.to_owned()) {
            self.reporter.event(&Event::Warning(word));
        }
    }
}

/// The strands of a pipeline, before they are bound to anything.
fn strands(
    pipeline: &Pipeline,
    base: &Path,
    exposure: &Exposure,
    reporter: &dyn Reporter,
    store: &mut Store,
) -> Result<(Hair, Opening), TurntableError> {
    let animated = pipeline.motion.is_some() && pipeline.bind.is_none();
    let may_move = |file: &PathBuf| GroomAt::may_move(file);
    if animated && pipeline.groom.file.as_ref().is_some_and(may_move) {
        let (hair, opening) = Hair::filmed(pipeline, base, exposure, reporter)?;
        if opening.moves {
            return Ok((hair, opening));
        }
    }
    let groom = groom(pipeline, base, reporter, store)?;
    Ok((Hair::Still(groom), Opening::default()))
}
