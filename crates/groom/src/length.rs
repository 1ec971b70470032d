//! Lengths along a strand.

use glam::Vec3;

/// Fills `along` with the length of the strand up to each point and gives the whole length.
pub(crate) fn arc_lengths(strand: &[Vec3], along: &mut Vec<f64>) -> f64 {
    let mut length = 0.0;
    along.clear();
    along.push(0.0);
    for pair in strand.windows(2) {
        length += (pair[1].as_dvec3() - pair[0].as_dvec3()).length();
        along.push(length);
    }
    length
}

/// The length of a strand.
pub(crate) fn length(strand: &[Vec3]) -> f64 {
    strand.windows(2).map(|pair| (pair[1].as_dvec3() - pair[0].as_dvec3()).length()).sum()
}
