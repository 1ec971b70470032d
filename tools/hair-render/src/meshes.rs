//! Meshes at one frame, and how they move while the shutter is open.

use std::path::Path;

use anyhow::Result;
use hair_render::{MeshObject, MeshTimes, Shutter};
use moving_mesh::{AnimationChoice, MeshOptions, MovingMesh, RestPose};

use crate::args::Args;
use crate::moving_groom;

/// When the meshes of a picture are looked at.
pub struct When<'a> {
    /// The frame; none where meshes stay as their file stands.
    pub frame: Option<f64>,
    pub shutter: &'a Shutter,
    /// How many times through the shutter.
    pub keys: usize,
}

/// Opens a mesh; `groom_rate` are the groom's frames a second.
pub fn open(path: &Path, args: &Args, when: &When, groom_rate: Option<f64>) -> Result<MovingMesh> {
    let When { shutter, keys, .. } = *when;
    let Some(frame) = when.frame else {
        let options =
            MeshOptions { animation: AnimationChoice::None, rest: RestPose::Nodes, ..MeshOptions::default() };
        return Ok(MovingMesh::open(path, &options)?);
    };
    let motion = &args.motion;
    let animation = match &motion.mesh_animation {
        None => AnimationChoice::First,
        Some(name) => {
            name.parse().map_or_else(|_| AnimationChoice::Name(name.clone()), AnimationChoice::Index)
        }
    };
    // A frame of a stage is one of its time codes, whatever the picture's rate.
    let frame_rate = motion.fps.or(groom_rate).filter(|_| !is_stage(path));
    let blurred = motion.blurs() && !shutter.is_instant();
    let frames = if blurred { (frame + shutter.open(), frame + shutter.close()) } else { (frame, frame) };
    let step = blurred.then(|| (shutter.close() - shutter.open()) / (keys - 1) as f64);
    let rest = RestPose::Nodes;
    Ok(MovingMesh::open(path, &MeshOptions { animation, rest, frame_rate, frames: Some(frames), step })?)
}

/// Poses a mesh for its picture, at `rate` frames a second where it knows no better.
pub fn pose(mesh: &MovingMesh, args: &Args, when: &When, rate: f64) -> Result<MeshObject> {
    let rate = mesh.frame_rate().unwrap_or(rate);
    let times = match when.frame {
        None => MeshTimes::Rest,
        Some(frame) if !args.motion.blurs() => MeshTimes::At(frame / rate),
        Some(frame) => {
            let times = when.shutter.key_times(frame, when.keys)?;
            MeshTimes::Through(times.into_iter().map(|time| time / rate).collect())
        }
    };
    Ok(MeshObject::posed(mesh, &times, args.input.mesh_albedo)?)
}

/// What there is to say where the picture is of a frame that a mesh does not have.
pub fn outside(mesh: &MovingMesh, path: &Path, when: &When, rate: f64) -> Option<String> {
    let rate = mesh.frame_rate().unwrap_or(rate);
    let (start, end) = mesh.time_range()?;
    moving_groom::outside(path, when.frame?, (start * rate, end * rate))
}

fn is_stage(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    ending.is_some_and(|ending| ending.starts_with("usd"))
}
