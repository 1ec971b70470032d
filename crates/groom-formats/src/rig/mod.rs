//! Grooms that follow joints: linear blend skinning, every strand as a whole.

mod check;
mod decompose;
mod tracks;

use std::io::BufWriter;
use std::path::Path;

use glam::DMat4;
use groom::Groom;

pub(crate) use check::RigCheck;
pub(crate) use tracks::{Space, Track, Tracks};

use crate::read::endings;
use crate::{
    Format, FormatError, MotionOptions, Output, Warning, WriteOptions, check as groom_check, frame_check,
};

/// Bytes gathered before the system is asked to write them.
const BUFFER: usize = 1 << 20;

/// Joints, and how much of each every strand follows.
///
/// A point `p` of the groom goes to the sum of `weight * joint * inverse_bind * p` over the joints of its strand.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Rig {
    /// Parents stand before their children.
    pub joints: Vec<RigJoint>,
    /// One a strand of the groom.
    pub influences: Vec<Influences>,
}

/// A joint.
#[derive(Clone, Debug, PartialEq)]
pub struct RigJoint {
    /// What it is called; formats make it fit and unlike the others.
    pub name: String,
    /// Its place among the joints; `None` for one that hangs nowhere.
    pub parent: Option<usize>,
    /// From the space of the groom's points, as they are in the groom, to the joint's.
    pub inverse_bind: DMat4,
}

/// Up to four joints and their weights, which are 0 or more and sum to 1; a joint of weight 0 is not followed.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Influences {
    /// Places in [`Rig::joints`].
    pub joints: [u32; 4],
    /// How much of each.
    pub weights: [f32; 4],
}

impl Influences {
    /// The four strongest of any number of joints, those named twice taken together, and their weights brought to a
    /// sum of 1. Weights that are not over 0 count for nothing; `None` if none is.
    #[must_use]
    pub fn strongest(all: &[(u32, f64)]) -> Option<Self> {
        let mut sums: Vec<(u32, f64)> = Vec::new();
        for &(joint, weight) in all.iter().filter(|(_, weight)| *weight > 0.0 && weight.is_finite()) {
            match sums.iter_mut().find(|(known, _)| *known == joint) {
                Some((_, sum)) => *sum += weight,
                None => sums.push((joint, weight)),
            }
        }
        sums.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        sums.truncate(4);
        let sum: f64 = sums.iter().map(|(_, weight)| weight).sum();
        let mut found = Influences::default();
        for (place, (joint, weight)) in sums.iter().enumerate() {
            found.joints[place] = *joint;
            found.weights[place] = (weight / sum) as f32;
        }
        (sum > 0.0 && sum.is_finite()).then(|| found.normalized())
    }

    /// Joint and weight of what is followed.
    pub fn iter(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
        let pairs = self.joints.iter().zip(&self.weights);
        pairs.filter(|(_, weight)| **weight > 0.0).map(|(&joint, &weight)| (joint as usize, weight))
    }

    /// Strongest first, the sum of the weights as near to 1 as floats come, joints of weight 0 called 0.
    pub(crate) fn normalized(self) -> Self {
        let mut pairs: Vec<(usize, f32)> = self.iter().collect();
        pairs.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let sum: f64 = pairs.iter().map(|(_, weight)| f64::from(*weight)).sum();
        let mut found = Influences::default();
        for (place, (joint, weight)) in pairs.iter().enumerate() {
            found.joints[place] = *joint as u32;
            found.weights[place] = (f64::from(*weight) / sum) as f32;
        }
        // What rounding took goes to the strongest.
        let rest: f32 = found.weights[1..].iter().sum();
        found.weights[0] = 1.0 - rest;
        found
    }
}

/// Where the joints are at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RigFrame {
    /// The time, in frames; need not be whole.
    pub time: f64,
    /// One a joint: from its space to the world, in the groom's axes and units.
    pub joints: Vec<DMat4>,
}

/// Writes a groom with the joints that move it to `path`: everything is `groom`'s, `frames` come in the order of
/// their times. With [`MotionOptions::origin`], the groom's points are measured from there, and joints are not.
///
/// `.usda`, `.usdc` and `.usdz` hold a UsdSkel skeleton, `.glb` and `.gltf` a skin. Both keep a joint as translation,
/// rotation and scale (USD's scale in 16 bits): what that cannot hold, a shear, is told as
/// [`Warning::JointsApproximated`]. Only the joints of all frames are in memory, 40 bytes each and, while USD is written, up to 16 more.
///
/// # Errors
/// [`FormatError`], an error that `frames` brings included; the old file at `path`, if any, is then untouched.
#[allow(unused_variables, unused_mut, unreachable_code)] // with features off
pub fn write_rigged(
    groom: &Groom,
    rig: &Rig,
    frames: &mut dyn Iterator<Item = Result<RigFrame, FormatError>>,
    motion: &MotionOptions,
    path: &Path,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let name = path.display().to_string();
    let format = Format::from_path(path).filter(|&format| holds_joints(format) && format.can_write());
    let format = format
        .ok_or_else(|| FormatError::UnknownFormat { file: name.clone(), expected: endings(holds_joints) })?;
    groom_check::values(groom, &name)?;
    frame_check::options(motion, &name)?;
    check::rig(rig, groom, &name)?;
    let motion = RigMotion { groom, rig, frames, options: motion };
    match format {
        #[cfg(feature = "gltf")]
        Format::Gltf | Format::Glb => crate::gltf::write_rigged(motion, format, path, &name, options),
        #[cfg(any(feature = "usda", feature = "usdc", feature = "usdz"))]
        _ => {
            let mut stream = BufWriter::with_capacity(BUFFER, Output::create(path)?);
            let warnings = crate::usd::write::write_rigged(motion, format, &mut stream, &name, options)?;
            stream.into_inner().map_err(|e| FormatError::io(&name, e.into_error()))?.commit()?;
            Ok(warnings)
        }
        #[cfg(not(any(feature = "usda", feature = "usdc", feature = "usdz")))]
        _ => Err(FormatError::UnknownFormat { file: name, expected: endings(holds_joints) }),
    }
}

/// What a writer of joints is given, checked.
pub(crate) struct RigMotion<'a> {
    pub(crate) groom: &'a Groom,
    pub(crate) rig: &'a Rig,
    pub(crate) frames: &'a mut dyn Iterator<Item = Result<RigFrame, FormatError>>,
    pub(crate) options: &'a MotionOptions,
}

fn holds_joints(format: Format) -> bool {
    matches!(format, Format::Usda | Format::Usdc | Format::Usdz | Format::Gltf | Format::Glb)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_strongest_four_are_kept_and_sum_to_one() {
        let all = [(7, 0.1), (3, 0.2), (9, f64::NAN), (7, 0.3), (1, 0.05), (2, 0.0), (4, 0.1), (5, 0.25)];
        let found = Influences::strongest(&all).unwrap();
        assert_eq!(found.joints, [7, 5, 3, 4]);
        assert_eq!(found.weights.iter().sum::<f32>(), 1.0);
        assert!((found.weights[1] - 0.25 / 0.95).abs() < 1e-6);
        assert_eq!(Influences::strongest(&[(0, 0.0), (1, -1.0)]), None);
        let one = Influences::strongest(&[(6, 1e-9)]).unwrap();
        assert_eq!((one.joints, one.weights), ([6, 0, 0, 0], [1.0, 0.0, 0.0, 0.0]));
    }
}
