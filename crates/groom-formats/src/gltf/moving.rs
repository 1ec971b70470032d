//! What moves the mesh of a plan.

use glam::DVec3;

use super::skin::Skin;
use crate::FormatError;

/// What moves the mesh.
#[derive(Default)]
pub(super) enum Moving<'a> {
    #[default]
    Nothing,
    Skin(Skin<'a>),
    Morphs(Morphs),
}

/// Displacements of the mesh, one for every frame but the first.
pub(super) struct Morphs {
    /// Where the mesh is.
    pub(super) origin: DVec3,
    /// Places among the arrays of the tail.
    pub(super) targets: Vec<usize>,
    /// Times and weights; one frame has none.
    pub(super) keys: Option<(usize, usize)>,
}

/// Frames as seconds in 32 bits, as glTF has its keys: from 0 on, rising.
pub(super) fn seconds(times: &[f64], frame_rate: f64, file: &str) -> Result<Vec<f32>, FormatError> {
    let mut all: Vec<f32> = Vec::with_capacity(times.len());
    for (number, time) in times.iter().enumerate() {
        let place = || format!("time of frame {number}");
        let seconds = (time / frame_rate) as f32;
        if seconds < 0.0 || !seconds.is_finite() {
            let expected = "0 or more: a glTF animation starts at 0";
            return Err(FormatError::invalid(file, place(), format!("{time} ({seconds} s)"), expected));
        }
        if let Some(last) = all.last().filter(|last| seconds <= **last) {
            let expected =
                format!("more than {last} s, that of the frame before, in the 32 bits that glTF has");
            return Err(FormatError::invalid(file, place(), format!("{time} ({seconds} s)"), expected));
        }
        all.push(seconds);
    }
    Ok(all)
}
