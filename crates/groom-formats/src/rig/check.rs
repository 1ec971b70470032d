//! Refuses rigs and frames that make no motion.

use glam::{DMat4, DVec4};
use groom::Groom;

use super::{Rig, RigFrame};
use crate::FormatError;

/// What inverting a matrix may leave in its last row.
const ROUNDING: f64 = 1e-9;
/// How far weights may be from a sum of 1.
const SUM: f64 = 1e-3;

/// Refuses joints that do not hang together, and influences that do not fit joints and strands.
pub(super) fn rig(rig: &Rig, groom: &Groom, file: &str) -> Result<(), FormatError> {
    let fault = |place: String, found: String, expected: String| {
        Err(FormatError::invalid(file, place, found, expected))
    };
    if rig.joints.is_empty() {
        return fault("joints".into(), "none".into(), "at least one".into());
    }
    for (index, joint) in rig.joints.iter().enumerate() {
        let place = |what| format!("{what} of joint {index} (`{}`)", joint.name);
        if let Some(parent) = joint.parent.filter(|&parent| parent >= index) {
            let expected = "a joint that stands before it".into();
            return fault(place("parent"), format!("joint {parent}"), expected);
        }
        if let Err((found, expected)) = affine(&joint.inverse_bind) {
            return fault(place("inverse bind matrix"), found, expected.into());
        }
        let volume = joint.inverse_bind.determinant();
        if volume == 0.0 || !volume.recip().is_finite() {
            let expected = "a matrix that has an inverse".into();
            return fault(place("inverse bind matrix"), format!("a determinant of {volume}"), expected);
        }
    }
    let (found, strands) = (rig.influences.len(), groom.strand_count());
    if found != strands {
        return fault("influences".into(), found.to_string(), format!("{strands}, one a strand"));
    }
    for (strand, influences) in rig.influences.iter().enumerate() {
        let place = || format!("influences of strand {strand}");
        let bad = influences.weights.iter().find(|weight| !(**weight >= 0.0 && weight.is_finite()));
        if let Some(weight) = bad {
            return fault(place(), format!("a weight of {weight}"), "finite weights, 0 or more".into());
        }
        let sum: f64 = influences.weights.iter().map(|weight| f64::from(*weight)).sum();
        if (sum - 1.0).abs() > SUM {
            return fault(place(), format!("weights that sum to {sum}"), "a sum of 1".into());
        }
        for (place_of, (joint, _)) in influences.iter().enumerate() {
            if joint >= rig.joints.len() {
                return fault(place(), format!("joint {joint}"), format!("0 to {}", rig.joints.len() - 1));
            }
            if influences.iter().take(place_of).any(|(other, _)| other == joint) {
                return fault(place(), format!("joint {joint} twice"), "every joint once".into());
            }
        }
    }
    Ok(())
}

/// What the frames so far were like.
pub(crate) struct RigCheck<'a> {
    file: &'a str,
    joints: usize,
    frames: usize,
    last: f64,
}

impl<'a> RigCheck<'a> {
    pub(crate) fn new(rig: &Rig, file: &'a str) -> Self {
        RigCheck { file, joints: rig.joints.len(), frames: 0, last: 0.0 }
    }

    /// Takes the next frame.
    pub(crate) fn take(&mut self, frame: &RigFrame) -> Result<(), FormatError> {
        let fault = |what: &str, found: String, expected: String| {
            Err(FormatError::invalid(self.file, format!("{what} of frame {}", self.frames), found, expected))
        };
        if !frame.time.is_finite() {
            return fault("time", frame.time.to_string(), "a finite number".into());
        }
        if self.frames > 0 && frame.time <= self.last {
            let expected = format!("more than {}, that of the frame before", self.last);
            return fault("time", frame.time.to_string(), expected);
        }
        if frame.joints.len() != self.joints {
            return fault(
                "joints",
                frame.joints.len().to_string(),
                format!("{}, as in the rig", self.joints),
            );
        }
        for (joint, matrix) in frame.joints.iter().enumerate() {
            if let Err((found, expected)) = affine(matrix) {
                return fault(&format!("joint {joint}"), found, expected.into());
            }
        }
        (self.frames, self.last) = (self.frames + 1, frame.time);
        Ok(())
    }

    /// After the last frame.
    pub(crate) fn finish(&self) -> Result<(), FormatError> {
        match self.frames {
            0 => Err(FormatError::invalid(self.file, "frames", "none", "at least one")),
            _ => Ok(()),
        }
    }
}

fn affine(matrix: &DMat4) -> Result<(), (String, &'static str)> {
    if !matrix.is_finite() {
        return Err(("a number that is not finite".into(), "finite numbers"));
    }
    let last = matrix.row(3);
    if !last.abs_diff_eq(DVec4::W, ROUNDING) {
        return Err((format!("a last row of {last}"), "0 0 0 1: a matrix that keeps parallels"));
    }
    Ok(())
}
