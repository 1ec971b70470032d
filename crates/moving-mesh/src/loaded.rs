//! What a reader of a format hands over.

use crate::error::Fault;
use crate::gltf_file::Rig;
use crate::obj_file::Sequence;
use crate::shape::Shape;
use crate::usd_file::Film;
use crate::{Animation, Pose, RestPose};

/// A mesh file, read.
#[derive(Debug)]
pub(crate) struct Loaded {
    pub(crate) shape: Shape,
    pub(crate) motion: Motion,
    pub(crate) source: Source,
}

/// What a file says of its times and its space.
#[derive(Clone, Debug)]
pub(crate) struct Motion {
    pub(crate) animations: Vec<Animation>,
    /// Of the animation that moves the mesh.
    pub(crate) time_range: Option<(f64, f64)>,
    pub(crate) frame_rate: Option<f64>,
    pub(crate) is_z_up: bool,
    pub(crate) meters_per_unit: f64,
}

impl Default for Motion {
    fn default() -> Self {
        Motion {
            animations: Vec::new(),
            time_range: None,
            frame_rate: None,
            is_z_up: false,
            meters_per_unit: 1.0,
        }
    }
}

/// What gives a mesh its poses.
#[derive(Debug)]
pub(crate) enum Source {
    Still(Pose),
    Gltf(Box<Rig>),
    Usd(Box<Film>),
    Sequence(Box<Sequence>),
}

impl Source {
    pub(crate) fn pose_into(&self, at: RestPose, pose: &mut Pose) -> Result<(), Fault> {
        match self {
            Source::Still(still) => pose.clone_from(still),
            Source::Gltf(rig) => rig.pose_into(at, pose),
            Source::Usd(film) => film.pose_into(at.time(), pose)?,
            Source::Sequence(sequence) => sequence.pose_into(at.time(), pose)?,
        }
        Ok(())
    }
}
