//! Strands moved as rigid bodies, each by its root.

use glam::{DVec3, Vec3};
use groom::Groom;

use crate::strand_blocks::each_strand;
use crate::{BindingError, RootFrames};

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
    each_strand(groom, [out], |strand, [own]| {
        let mut motion = frames.motion(strand);
        motion.to -= origin;
        for (moved, point) in own.iter_mut().zip(groom.strand(strand)) {
            *moved = motion.apply(point.as_dvec3()).as_vec3();
        }
    });
    Ok(())
}
