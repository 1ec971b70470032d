//! Characters far from the origin.

use anyhow::Result;
use glam::DVec3;

use crate::character::Character;
use crate::target::Target;

/// A character farther off than so many of its sizes has an origin of its own: one step of a 32-bit number there is
/// a part of its size that shows.
const FAR: f64 = 16.0;

/// Where the strands' points are measured from: 0 unless the character is far away at its first frame.
pub(crate) fn origin(character: &Character) -> Result<DVec3> {
    let first = character.timeline.frames().next().unwrap_or(0.0);
    let pose = character.mesh.pose(character.timeline.seconds(first))?;
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = pose.positions.iter().fold(empty, |(low, high), p| (low.min(*p), high.max(*p)));
    let middle = 0.5 * (low + high);
    // Whole numbers are exact in every format.
    let is_far = middle.length() > FAR * low.distance(high);
    Ok(if is_far && middle.is_finite() { middle.round() } else { DVec3::ZERO })
}

/// What is lost where a format has no place for an origin.
pub(crate) fn warning(target: &Target, origin: DVec3) -> Option<String> {
    let holds_transform = matches!(target, Target::Animated(..) | Target::Skinned(..));
    let step = origin.abs().max_element() * f64::from(f32::EPSILON);
    (origin != DVec3::ZERO && !holds_transform).then(|| {
        format!(
            "{} has no place for a transform: points {:.0} from the origin are rounded by up to {step:.1e}",
            target.display(),
            origin.length()
        )
    })
}
