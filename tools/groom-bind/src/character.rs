//! The mesh, opened as the options ask.

use anyhow::Result;
use groom_binding::Surface;
use moving_mesh::{AnimationChoice, MeshOptions, MovingMesh, RestPose};

use crate::args::{Args, Rest, Which};
use crate::timeline::{FRAME_RATE, Timeline};

/// Finer than this part of a frame no USD stage is baked.
const FINEST_STEP: f64 = 1.0 / 16.0;

/// A mesh and the frames it is wanted at.
pub(crate) struct Character {
    pub(crate) name: String,
    pub(crate) mesh: MovingMesh,
    pub(crate) timeline: Timeline,
}

impl Character {
    /// What strands are bound to.
    pub(crate) fn surface(&self) -> Surface<'_> {
        let mesh = &self.mesh;
        Surface { triangles: mesh.triangles(), rest: mesh.rest(), uvs: mesh.uvs() }
    }
}

/// Opens the mesh in its rest pose, with the animation that was asked for.
pub(crate) fn open(args: &Args) -> Result<Character> {
    let path = args.mesh()?;
    let options = |rest| options(args, rest);
    let rest = match args.mesh.rest {
        Rest::Bind => RestPose::Bind,
        Rest::Nodes => RestPose::Nodes,
        Rest::Frame(frame) => {
            // Only the mesh may know when that frame is.
            let rate = match args.mesh.fps {
                Some(rate) => rate,
                None => rate_of(&MovingMesh::open(path, &options(RestPose::Bind))?, args),
            };
            RestPose::Time(frame / rate)
        }
    };
    let mesh = MovingMesh::open(path, &options(rest))?;
    let rate = rate_of(&mesh, args);
    let moving = mesh.moves().then(|| mesh.time_range()).flatten();
    let timeline = Timeline::new(args.mesh.frames, moving, rate)?;
    Ok(Character { name: path.display().to_string(), mesh, timeline })
}

fn rate_of(mesh: &MovingMesh, args: &Args) -> f64 {
    args.mesh.fps.or(mesh.frame_rate()).unwrap_or(FRAME_RATE)
}

fn options(args: &Args, rest: RestPose) -> MeshOptions {
    let shutter = &args.shutter;
    let animation = match &args.mesh.animation {
        None => AnimationChoice::First,
        Some(Which::Name(name)) => AnimationChoice::Name(name.clone()),
        Some(Which::Index(index)) => AnimationChoice::Index(*index),
    };
    // What is looked at beside the frames themselves.
    let [open, close] = shutter.shutter;
    let around = shutter.reach().max(open.abs()).max(close.abs()) + shutter.reach();
    let frames = args.mesh.frames.map(|range| (range.first as f64 - around, range.last as f64 + around));
    let between = shutter.offsets().windows(2).map(|pair| pair[1] - pair[0]).fold(shutter.reach(), f64::min);
    let step = args.mesh.frames.map_or(1.0, |range| range.step).min(between).max(FINEST_STEP);
    MeshOptions {
        animation,
        rest,
        frame_rate: args.mesh.fps,
        frames,
        step: Some(step),
        ..MeshOptions::default()
    }
}
