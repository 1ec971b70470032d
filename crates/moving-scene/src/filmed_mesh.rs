//! A mesh of a file, frame by frame, and how it moves while the shutter is open.

use std::path::{Path, PathBuf};

use glam::Vec3;
use hair_render::{MeshObject, MeshTimes};
use moving_mesh::{AnimationChoice, MeshOptions, MovingMesh, RestPose};

use crate::{Exposure, MovingSceneError, outside};

/// What is asked of a mesh.
#[derive(Clone, Debug, Default)]
pub struct MeshAsked {
    /// Which animation moves it.
    pub animation: AnimationChoice,
    /// The pose that strands were made for.
    pub rest: RestPose,
    /// Whether frames of an animation are shown; the mesh stays as its file stands otherwise.
    pub moves: bool,
    /// First and last frame that is shown; all of the file's when nobody says.
    pub frames: Option<(f64, f64)>,
    /// At how many times through the shutter it is looked at.
    pub keys: usize,
    /// Frames a second of the groom beside it.
    pub groom_rate: Option<f64>,
    /// Whether Z is up, whatever the file says.
    pub z_up: Option<bool>,
    /// Metres in a unit, whatever the file says.
    pub meters_per_unit: Option<f64>,
}

/// A mesh and the times it is shown at.
#[derive(Debug)]
pub struct FilmedMesh {
    mesh: MovingMesh,
    path: PathBuf,
    keys: usize,
    stands: bool,
}

/// The animation that is meant by a name, or by a number from 0; the first where nobody says.
#[must_use]
pub fn animation_named(name: Option<&str>) -> AnimationChoice {
    name.map_or(AnimationChoice::First, |name| {
        name.parse().map_or_else(|_| AnimationChoice::Name(name.to_owned()), AnimationChoice::Index)
    })
}

impl FilmedMesh {
    /// Opens a mesh for the frames that are asked for.
    ///
    /// # Errors
    /// [`MovingSceneError::Mesh`].
    pub fn open(path: &Path, asked: &MeshAsked, exposure: &Exposure) -> Result<Self, MovingSceneError> {
        let keys = asked.keys.max(2);
        let options = MeshOptions {
            rest: asked.rest,
            z_up: asked.z_up,
            meters_per_unit: asked.meters_per_unit,
            ..MeshOptions::default()
        };
        let options = if asked.moves {
            let shutter = &exposure.shutter;
            let blurred = exposure.blurs() && !shutter.is_instant();
            let length = if blurred { shutter.close() - shutter.open() } else { 0.0 };
            // Velocities are differences over as long a time about the frame.
            let before = if blurred { shutter.open().min(-0.5 * length) } else { 0.0 };
            let after = if blurred { shutter.close().max(0.5 * length) } else { 0.0 };
            MeshOptions {
                animation: asked.animation.clone(),
                // A frame of a stage is one of its time codes, whatever the picture's rate.
                frame_rate: exposure.frame_rate.or(asked.groom_rate).filter(|_| !is_stage(path)),
                frames: asked.frames.map(|(first, last)| (first + before, last + after)),
                step: blurred.then_some(length / (keys - 1) as f64),
                ..options
            }
        } else {
            MeshOptions { animation: AnimationChoice::None, ..options }
        };
        let mesh = MovingMesh::open(path, &options)?;
        Ok(FilmedMesh { mesh, path: path.to_owned(), keys, stands: !asked.moves })
    }

    /// The mesh itself.
    #[must_use]
    pub fn mesh(&self) -> &MovingMesh {
        &self.mesh
    }

    /// Seconds of a time in frames, at `rate` frames a second where the mesh knows no better.
    #[must_use]
    pub fn seconds(&self, time: f64, rate: f64) -> f64 {
        time / self.mesh.frame_rate().unwrap_or(rate)
    }

    /// First and last frame of its animation, if it has one.
    #[must_use]
    pub fn frames(&self, rate: f64) -> Option<(f64, f64)> {
        let rate = self.mesh.frame_rate().unwrap_or(rate);
        self.mesh.time_range().map(|(start, end)| (start * rate, end * rate))
    }

    /// The times, in frames, at which it is looked at for a picture of `frame`: one where nothing is blurred.
    ///
    /// # Errors
    /// [`MovingSceneError::Render`] for a frame that is no number or too many keys.
    pub fn key_times(&self, frame: f64, exposure: &Exposure) -> Result<Vec<f64>, MovingSceneError> {
        if !exposure.blurs() {
            return Ok(vec![frame]);
        }
        Ok(exposure.shutter.key_times(frame, self.keys)?)
    }

    /// The mesh of a picture of `frame`, at `rate` frames a second where it knows no better; as its file stands where it
    /// was opened for no frames.
    ///
    /// # Errors
    /// [`MovingSceneError::Render`].
    pub fn object(
        &self,
        frame: Option<f64>,
        exposure: &Exposure,
        rate: f64,
        albedo: Vec3,
    ) -> Result<MeshObject, MovingSceneError> {
        let times = match frame.filter(|_| !self.stands) {
            // Without an animation every time is as the file stands.
            None => MeshTimes::At(0.0),
            Some(frame) if !exposure.blurs() => MeshTimes::At(self.seconds(frame, rate)),
            Some(frame) => {
                let times = self.key_times(frame, exposure)?;
                MeshTimes::Through(times.into_iter().map(|time| self.seconds(time, rate)).collect())
            }
        };
        Ok(MeshObject::posed(&self.mesh, &times, albedo)?)
    }

    /// The mesh as it stands at `frame`, with nothing of it blurred.
    ///
    /// # Errors
    /// As [`FilmedMesh::object`].
    pub fn still(&self, frame: f64, rate: f64, albedo: Vec3) -> Result<MeshObject, MovingSceneError> {
        Ok(MeshObject::posed(&self.mesh, &MeshTimes::At(self.seconds(frame, rate)), albedo)?)
    }

    /// What there is to say where the picture is of a frame that it does not have.
    #[must_use]
    pub fn outside(&self, frame: f64, rate: f64) -> Option<String> {
        outside(&self.path, frame, self.frames(rate)?)
    }
}

/// Whether a name is that of a USD stage: its frames are time codes of its own, and it says its unit and its up axis.
#[must_use]
pub fn is_stage(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    ending.is_some_and(|ending| ending.starts_with("usd"))
}
