//! The strands of each frame: still, read from an animated file, or carried by a mesh.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::{DMat4, DVec3};
use groom::Groom;
use groom_binding::{Alignment, Beyond, BindBy, BindingError, Blend, CarryMode, Space};
use groom_formats::ReadOptions;
use hair_render::{Blur, HairMaterial, HairObject};
use moving_scene::{Bindings, BoundGroom, Exposure, FilmedMesh, GroomAt, MovingSceneError};

use super::prepare;
use crate::schema::{self, Attributes, Axis, Bind, Pipeline};
use crate::{Event, Reporter, TurntableError};

/// Where strands come from, frame by frame.
pub(super) enum Hair {
    /// The same in every frame.
    Still(Arc<Groom>),
    /// At each frame as its file has it.
    Filmed { path: PathBuf, options: ReadOptions, attributes: Attributes },
    /// Carried by the mesh.
    Bound(Box<BoundGroom>),
}

/// What was there when the first frame was looked at.
#[derive(Default)]
pub(super) struct Opening {
    /// Whether anything moves, be it within a frame.
    pub moves: bool,
    /// The frame of the animation, where the groom has one.
    pub frame: Option<f64>,
    pub frame_rate: Option<f64>,
    /// At how many times through the shutter the strands are looked at, where they know.
    pub keys: Option<usize>,
}

/// Strands of one frame.
pub(super) struct Strands {
    pub object: HairObject,
    /// Whether something jumps: what carries them is not to be blurred.
    pub jumped: bool,
    /// What there is to say.
    pub words: Vec<String>,
}

impl Hair {
    /// Strands of a file that may move, at the frame that the first picture shows.
    pub fn filmed(
        pipeline: &Pipeline,
        base: &Path,
        exposure: &Exposure,
        reporter: &dyn Reporter,
    ) -> Result<(Hair, Opening), TurntableError> {
        let source = &pipeline.groom;
        let path = base.join(source.file.as_deref().unwrap_or(Path::new("")));
        let options = prepare::read_options(source);
        let first = pipeline.motion.as_ref().and_then(|motion| motion.first);
        let groom = GroomAt::read(&path, &options, first)?;
        for warning in &groom.loaded.warnings {
            reporter.event(&Event::Warning(&format!("{}: {warning}", path.display())));
        }
        let opening = Opening {
            moves: groom.loaded.times.len() > 1 || groom.blur(exposure) != Blur::Off,
            frame: groom.frame().filter(|_| groom.loaded.times.len() > 1),
            frame_rate: groom.frame_rate(),
            keys: Some(groom.keys(exposure)),
        };
        let attributes = pipeline.attributes.clone();
        Ok((Hair::Filmed { path, options, attributes }, opening))
    }

    /// Strands bound to `mesh`, which is the one at `path`; `groom` is as it was prepared.
    pub fn bound(
        groom: &Groom,
        pipeline: &Pipeline,
        bind: &Bind,
        (mesh, path): (&FilmedMesh, &Path),
        reporter: &dyn Reporter,
    ) -> Result<Hair, TurntableError> {
        let mut groom = groom.clone();
        let mut space = Space::of(mesh.mesh(), path);
        space.unit_is_said |= pipeline.mesh.as_ref().is_some_and(|mesh| mesh.meters_per_unit.is_some());
        let source = &pipeline.groom;
        let alignment = Alignment {
            up: None,
            unit_is_said: source.meters_per_unit.is_some()
                || source.file.is_none()
                || source
                    .file
                    .as_deref()
                    .and_then(groom_formats::Format::from_path)
                    .is_some_and(|format| format.says_unit(&groom)),
            scale: bind.scale,
            translate: bind.translate.map(DVec3::from_array),
            matrix: bind.matrix.map(|rows| DMat4::from_cols_array_2d(&rows).transpose()),
        };
        let of_bind = |error: BindingError| TurntableError::from(MovingSceneError::from(error));
        alignment.apply(&mut groom, space).map_err(of_bind)?;
        // Strands and mesh stand in one space.
        groom.meters_per_unit = space.meters_per_unit;
        let (bound, words) = BoundGroom::bind(groom, mesh, bindings(bind))?;
        words.iter().for_each(|word| reporter.event(&Event::Warning(&format!("bind: {word}"))));
        Ok(Hair::Bound(Box::new(bound)))
    }

    /// The strands of a frame of the animation.
    pub fn strands(
        &self,
        frame: Option<f64>,
        rate: f64,
        mesh: Option<&FilmedMesh>,
        exposure: &Exposure,
        material: &HairMaterial,
    ) -> Result<Strands, TurntableError> {
        let strands = |object, jumped, words| Strands { object, jumped, words };
        match self {
            Hair::Still(groom) => {
                let object = HairObject::still(Groom::clone(groom), material.clone());
                Ok(strands(object, false, Vec::new()))
            }
            Hair::Filmed { path, options, attributes } => {
                let groom = GroomAt::read(path, options, frame)?;
                let motion = groom.motion(exposure, rate)?;
                let words = groom.outside().into_iter().collect();
                let origin = groom.loaded.origin * f64::from(attributes.scale.unwrap_or(1.0));
                let (groom, motion) = prepare::change_moving(groom.loaded.groom, &motion, attributes)?;
                let still = HairObject::still(groom, material.clone());
                Ok(strands(HairObject { origin, motion, ..still }, false, words))
            }
            Hair::Bound(bound) => {
                let Some(mesh) = mesh else {
                    return Err(TurntableError::Stage("bind: there is no `mesh` to bind to".to_owned()));
                };
                let carried = bound.at(mesh, frame.unwrap_or(0.0), exposure, rate)?;
                let still = HairObject::still(carried.groom, material.clone());
                let object = HairObject { origin: carried.origin, motion: carried.motion, ..still };
                Ok(strands(object, carried.jumped, Vec::new()))
            }
        }
    }
}

fn bindings(bind: &Bind) -> Bindings {
    let by = match bind.by {
        schema::BindBy::Nearest => BindBy::Nearest,
        schema::BindBy::Uv => BindBy::RootUv,
        schema::BindBy::Id => BindBy::RootTriangle,
    };
    let beyond = match bind.beyond {
        schema::Beyond::Keep => Beyond::Keep,
        schema::Beyond::Snap => Beyond::Snap,
        schema::Beyond::Drop => Beyond::Drop,
    };
    let mode = match bind.mode {
        schema::BindMode::Rigid => CarryMode::Rigid,
        schema::BindMode::Blended => {
            CarryMode::Blended(Blend { restore_lengths: bind.keep_length, ..Blend::default() })
        }
    };
    let (limit, keep_out, teleport) = (bind.limit, bind.avoid_penetration, bind.teleport);
    Bindings { by, limit, beyond, mode, keep_out, teleport }
}

/// Whether Z is up, as a key says.
pub(super) fn is_z(axis: Axis) -> bool {
    axis == Axis::Z
}
