//! The frames of all roots at a pose.

use glam::DVec3;
use moving_mesh::Pose;
use rayon::prelude::*;

use crate::handedness::Handedness;
use crate::root::place;
use crate::root_frame::pose_turn;
use crate::vertex_normals::{PoseNormals, VertexNormals};
use crate::{Binding, BindingError, RigidMotion, Root, RootFrame, Surface};

/// The frames of all roots, taken along a sequence of poses.
///
/// A frame's origin is the root's place at the pose. Its normal is that of the surface there, the vertices'
/// normals weighted; its tangent at rest is the first edge of the triangle, and turns with the triangle as a whole.
/// Where a triangle tells no frame the strand keeps the rotation of the last pose that did, the rest pose's before
/// there was any, and only moves with its place:
///
/// - the triangle has collapsed: it has no area;
/// - it is turned over: it faces against its vertices' normals, which its neighbours make as well, and did not so at
///   rest (or the other way round). Where a whole neighbourhood turns, its normals turn with it, and that is a motion
///   like another.
///
/// So the answer depends on the poses before: take them in order, and start anew with [`RootFrames::reset`].
/// A clone keeps its own past, for sub-frames.
#[derive(Clone, Debug)]
pub struct RootFrames<'a> {
    binding: &'a Binding,
    surface: Surface<'a>,
    vertex_normals: VertexNormals,
    handedness: Handedness,
    frames: Vec<RootFrame>,
    mirrored: bool,
    held: usize,
}

impl<'a> RootFrames<'a> {
    /// The frames at rest.
    ///
    /// # Errors
    /// [`BindingError::Invalid`] when `surface` is not the mesh that was bound to.
    pub fn new(binding: &'a Binding, surface: Surface<'a>) -> Result<Self, BindingError> {
        binding.check_surface(&surface)?;
        let vertex_normals = VertexNormals::of(&surface);
        let positions = &surface.rest.positions;
        let normals = vertex_normals.at_pose(surface.triangles, positions);
        let handedness = Handedness::of_rest(surface.triangles, positions, &normals);
        let frames = at_rest(binding, &surface);
        Ok(RootFrames { binding, surface, vertex_normals, handedness, frames, mirrored: false, held: 0 })
    }

    /// Goes on to `pose`.
    ///
    /// # Errors
    /// [`BindingError::Invalid`] when it has another number of vertices, or one that is not finite; the frames are
    /// then as they were.
    pub fn follow(&mut self, pose: &Pose) -> Result<(), BindingError> {
        self.surface.check_pose(pose)?;
        let (triangles, positions) = (self.surface.triangles, &pose.positions);
        let normals = self.vertex_normals.at_pose(triangles, positions);
        self.mirrored = self.handedness.mirrored(triangles, positions, &normals).unwrap_or(self.mirrored);
        let (surface, mirrored) = (&self.surface, self.mirrored);
        self.held = self
            .frames
            .par_iter_mut()
            .zip(self.binding.roots())
            .with_min_len(1024)
            .map(|(frame, root)| usize::from(!renew(frame, root, surface, positions, &normals, mirrored)))
            .sum();
        Ok(())
    }

    /// Back to the rest pose, as if nothing had been.
    pub fn reset(&mut self) {
        self.frames = at_rest(self.binding, &self.surface);
        (self.mirrored, self.held) = (false, 0);
    }

    /// Back to an earlier pose, at which these were [`RootFrames::frames`], [`RootFrames::mirrored`] and
    /// [`RootFrames::held`].
    pub(crate) fn go_back(&mut self, frames: &[RootFrame], mirrored: bool, held: usize) {
        self.frames.clear();
        self.frames.extend_from_slice(frames);
        (self.mirrored, self.held) = (mirrored, held);
    }

    /// The frames, one a strand.
    #[must_use]
    pub fn frames(&self) -> &[RootFrame] {
        &self.frames
    }

    /// Whether the pose is the mirror image of the rest pose: motions are then rotations after a mirror. Told by the
    /// curvature of the whole mesh; never for flat or nearly flat ones, where it cannot be told from a turn.
    #[must_use]
    pub fn mirrored(&self) -> bool {
        self.mirrored
    }

    /// How many strands kept the rotation of an earlier pose at the last one.
    #[must_use]
    pub fn held(&self) -> usize {
        self.held
    }

    /// The motion of every strand from rest to the pose.
    pub fn motions(&self) -> impl ExactSizeIterator<Item = RigidMotion> + '_ {
        (0..self.frames.len()).map(|strand| self.motion(strand))
    }

    /// The motion of one strand from rest to the pose.
    ///
    /// # Panics
    /// When there is no such strand.
    #[inline]
    #[must_use]
    pub fn motion(&self, strand: usize) -> RigidMotion {
        self.binding.roots()[strand].rest.motion_to(&self.frames[strand], self.mirrored)
    }

    /// The binding whose frames these are.
    #[must_use]
    pub fn binding(&self) -> &'a Binding {
        self.binding
    }
}

/// Not simply the roots' rest frames: those of snapped strands lie off the surface.
fn at_rest(binding: &Binding, surface: &Surface<'_>) -> Vec<RootFrame> {
    let at_rest = |root: &Root| {
        let corners = surface.corners(&surface.rest.positions, root.triangle);
        RootFrame { origin: place(corners, root.barycentrics), rotation: root.rest.rotation }
    };
    binding.roots().iter().map(at_rest).collect()
}

/// Takes a frame to a pose; whether the pose had a rotation for it.
#[inline]
fn renew(
    frame: &mut RootFrame,
    root: &Root,
    surface: &Surface<'_>,
    positions: &[DVec3],
    normals: &PoseNormals<'_>,
    mirrored: bool,
) -> bool {
    let corners = surface.corners(positions, root.triangle);
    frame.origin = place(corners, root.barycentrics);
    let at_corners = normals.at_corners(surface.triangles[root.triangle as usize]);
    let turn =
        root.facing.and_then(|facing| pose_turn(corners, at_corners, root.barycentrics, &facing, mirrored));
    if let Some(rotation) = turn {
        frame.rotation = rotation;
    }
    turn.is_some()
}
