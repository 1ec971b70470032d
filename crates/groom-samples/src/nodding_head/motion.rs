//! How the head moves: a key a frame.

use std::f64::consts::TAU;

use glam::{Quat, Vec3};

use crate::trigonometry::{cos, sin};

/// Frames a second, and of each clip.
const FRAMES: u32 = 24;

/// How far each joint turns, in radians.
const NOD: [f64; 2] = [0.16, 0.30];
const SHAKE: [f64; 2] = [0.12, 0.45];

/// An animation: the same keys for all it moves.
pub(super) struct Clip {
    pub(super) name: &'static str,
    /// Times of the keys in seconds.
    pub(super) times: Vec<f32>,
    /// Turns of the neck and of the head.
    pub(super) turns: [Vec<Quat>; 2],
    /// Weights of the morph target; none for a clip that does not move it.
    pub(super) surprise: Option<Vec<f32>>,
}

impl Clip {
    /// Down and up again, the scalp pulled back half-way.
    pub(super) fn nod() -> Clip {
        let surprise = |part: f64| 0.5 - 0.5 * cos(TAU * part);
        let surprise = Some(parts().map(surprise).collect());
        Clip { name: "Nod", times: times(), turns: NOD.map(|reach| turns(Vec3::X, reach)), surprise }
    }

    /// To one side and the other.
    pub(super) fn shake() -> Clip {
        Clip {
            name: "Shake",
            times: times(),
            turns: SHAKE.map(|reach| turns(Vec3::Y, reach)),
            surprise: None,
        }
    }
}

fn parts() -> impl Iterator<Item = f64> {
    (0..=FRAMES).map(|frame| f64::from(frame) / f64::from(FRAMES))
}

fn times() -> Vec<f32> {
    parts().map(|part| part as f32).collect()
}

fn turns(axis: Vec3, reach: f64) -> Vec<Quat> {
    let turn = |part: f64| {
        let half = 0.5 * reach * f64::from(sin(TAU * part));
        let along = axis * sin(half);
        Quat::from_xyzw(along.x, along.y, along.z, cos(half))
    };
    parts().map(turn).collect()
}
