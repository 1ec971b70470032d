//! The mesh of each frame.

use std::path::{Path, PathBuf};

use glam::{Affine3A, Mat3, Vec3};
use hair_render::MeshObject;
use moving_mesh::{RestPose, TriangleMesh};
use moving_scene::{Exposure, FilmedMesh, MeshAsked, animation_named, by_base_color, is_stage};

use super::hair::is_z;
use crate::TurntableError;
use crate::schema::{Axis, MeshSource, Pipeline, Rest};

/// A mesh, frame by frame.
pub(super) enum Body {
    /// The same in every frame.
    Still(Vec<MeshObject>),
    /// Posed at each.
    Filmed(Box<Filmed>),
}

pub(super) struct Filmed {
    pub mesh: FilmedMesh,
    pub path: PathBuf,
    albedo: Vec3,
    base_colors: bool,
}

/// When a mesh is wanted.
pub(super) struct When {
    /// Whether frames of an animation are shown.
    pub moves: bool,
    /// The first and last of them, where that is known before the mesh is.
    pub frames: Option<(f64, f64)>,
    pub keys: usize,
    pub groom_rate: Option<f64>,
}

/// The mesh of a frame.
pub(super) struct Posed {
    pub objects: Vec<MeshObject>,
    pub words: Vec<String>,
}

impl Body {
    /// The mesh of a pipeline, if it names one.
    pub fn open(
        pipeline: &Pipeline,
        base: &Path,
        when: &When,
        exposure: &Exposure,
    ) -> Result<Option<Body>, TurntableError> {
        let Some(source) = &pipeline.mesh else { return Ok(None) };
        let path = base.join(&source.file);
        let plain = !when.moves && pipeline.bind.is_none() && !source.base_colors && !is_stage(&path);
        if plain {
            return Ok(Some(Body::Still(vec![still(source, &path)?])));
        }
        let asked = MeshAsked {
            animation: animation_named(source.animation.as_deref()),
            rest: RestPose::Nodes,
            moves: when.moves,
            frames: when.frames,
            keys: when.keys,
            groom_rate: when.groom_rate,
            z_up: source.up.map(is_z),
            meters_per_unit: source.meters_per_unit,
        };
        let rest = match pipeline.bind.as_ref().map(|bind| bind.rest) {
            None | Some(Rest::Nodes) => RestPose::Nodes,
            Some(Rest::Bind) => RestPose::Bind,
            Some(Rest::Frame(frame)) => {
                // Only the mesh may know when that frame is.
                let mesh = FilmedMesh::open(&path, &asked, exposure)?;
                RestPose::Time(mesh.seconds(frame, exposure.rate(when.groom_rate, None)))
            }
        };
        let mesh = FilmedMesh::open(&path, &MeshAsked { rest, ..asked }, exposure)?;
        let (albedo, base_colors) = (Vec3::from_array(source.albedo), source.base_colors);
        Ok(Some(Body::Filmed(Box::new(Filmed { mesh, path, albedo, base_colors }))))
    }

    /// The mesh that strands can be bound to.
    pub fn filmed(&self) -> Option<&Filmed> {
        match self {
            Body::Still(_) => None,
            Body::Filmed(filmed) => Some(filmed),
        }
    }

    /// Whether it stands otherwise in other frames.
    pub fn moves(&self) -> bool {
        self.filmed().is_some_and(|filmed| filmed.mesh.mesh().moves())
    }

    /// The mesh of a frame; `still` where nothing of it is to be blurred.
    pub fn posed(
        &self,
        frame: Option<f64>,
        rate: f64,
        exposure: &Exposure,
        still: bool,
    ) -> Result<Posed, TurntableError> {
        let filmed = match self {
            Body::Still(objects) => return Ok(Posed { objects: objects.clone(), words: Vec::new() }),
            Body::Filmed(filmed) => filmed,
        };
        let Filmed { mesh, path, albedo, base_colors } = &**filmed;
        let object = match frame.filter(|_| still) {
            Some(frame) => mesh.still(frame, rate, *albedo)?,
            None => mesh.object(frame, exposure, rate, *albedo)?,
        };
        let mut words: Vec<String> = frame.and_then(|frame| mesh.outside(frame, rate)).into_iter().collect();
        if !base_colors {
            return Ok(Posed { objects: vec![object], words });
        }
        let (objects, more) = by_base_color(object, mesh.mesh().parts())?;
        words.extend(more.into_iter().map(|word| format!("{}: {word}", path.display())));
        Ok(Posed { objects, words })
    }
}

/// A mesh that stands as its file does.
fn still(source: &MeshSource, path: &Path) -> Result<MeshObject, TurntableError> {
    let mut mesh = TriangleMesh::open(path)?;
    let turn = match source.up {
        Some(Axis::Z) => Mat3::from_rotation_x(-std::f32::consts::FRAC_PI_2),
        Some(Axis::Y) | None => Mat3::IDENTITY,
    };
    let unit = source.meters_per_unit.unwrap_or(1.0) as f32;
    if turn != Mat3::IDENTITY || unit != 1.0 {
        mesh.transform(&Affine3A::from_mat3(turn * unit));
    }
    Ok(MeshObject::still(mesh, Vec3::from_array(source.albedo)))
}
