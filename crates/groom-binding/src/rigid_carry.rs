//! Strands moved as rigid bodies, each by its root.

use glam::{DVec3, Vec3};
use groom::Groom;
use rayon::prelude::*;

use crate::{BindingError, RootFrames};

/// Points that one piece of work moves, about.
const BLOCK: usize = 16_384;

/// Moves every strand of `groom` from rest to the pose that `frames` are at, and writes the points minus `origin`
/// to `out`, as many as the groom has.
///
/// What is kept exactly but for rounding in f64: every length and angle in a strand; its root's distance from its
/// place on the surface, and the root's offset from there as seen in the frame; and the shape of the whole groom
/// where the mesh moves as a rigid body. The answer is rounded to f32 once, at the end, so `origin` should be
/// near: a step of f32 is 6e-8 of the distance from it.
///
/// # Errors
/// [`BindingError::Invalid`] when the groom has another number of strands than are bound.
pub fn carry_rigid(
    groom: &Groom,
    frames: &RootFrames<'_>,
    origin: DVec3,
    out: &mut Vec<Vec3>,
) -> Result<(), BindingError> {
    frames.binding().check_groom(groom)?;
    out.resize(groom.point_count(), Vec3::ZERO);
    let blocks = blocks(groom, out);
    blocks.into_par_iter().for_each(|(strands, mut out)| {
        for strand in strands {
            let mut motion = frames.motion(strand);
            motion.to -= origin;
            let points = groom.strand(strand);
            let (own, rest) = out.split_at_mut(points.len());
            for (moved, point) in own.iter_mut().zip(points) {
                *moved = motion.apply(point.as_dvec3()).as_vec3();
            }
            out = rest;
        }
    });
    Ok(())
}

/// Runs of strands with the part of `out` that is theirs, which must be as long as the groom has points.
pub(crate) fn blocks<'o, T>(
    groom: &Groom,
    mut out: &'o mut [T],
) -> Vec<(std::ops::Range<usize>, &'o mut [T])> {
    let offsets = groom.offsets();
    let mut blocks = Vec::with_capacity(groom.point_count() / BLOCK + 1);
    let mut first = 0;
    while first < groom.strand_count() {
        let start = offsets[first] as usize;
        let full = offsets[first..].partition_point(|&offset| (offset as usize) < start + BLOCK);
        let last = (first + full.max(1)).min(groom.strand_count());
        let (own, rest) = out.split_at_mut(offsets[last] as usize - start);
        blocks.push((first..last, own));
        (first, out) = (last, rest);
    }
    blocks
}
