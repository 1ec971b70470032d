//! What carrying gives.

use glam::Vec3;

use crate::keep_out::Pushed;

/// The points of a groom at one time and how they move, in the order of the groom.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Moved {
    /// Positions relative to [`CarryOptions::origin`](crate::CarryOptions::origin), in the mesh's units.
    pub positions: Vec<Vec3>,
    /// Velocities, in units per second.
    pub velocities: Vec<Vec3>,
    /// Accelerations, in units per second squared, if they were asked for.
    pub accelerations: Option<Vec<Vec3>>,
}

impl Moved {
    /// Makes room for so many points.
    pub(crate) fn prepare(&mut self, points: usize, accelerations: bool) {
        self.positions.resize(points, Vec3::ZERO);
        self.velocities.resize(points, Vec3::ZERO);
        self.accelerations = accelerations.then(|| self.accelerations.take().unwrap_or_default());
        if let Some(accelerations) = &mut self.accelerations {
            accelerations.resize(points, Vec3::ZERO);
        }
    }
}

/// What happened while strands were carried to a pose.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CarryReport {
    /// Strands whose triangle told no frame, and that kept an earlier one.
    pub held: usize,
    /// Whether the pose is the mirror image of the rest pose.
    pub mirrored: bool,
    /// How many places of the mesh the deformation goes through; 0 when strands are carried rigidly, because that was
    /// asked for or because the mesh is too thin to deform the space around it.
    pub anchors: usize,
    /// Points that were nearer to the mesh than they may be, and were moved.
    pub pushed: usize,
    /// Points that are inside the mesh still, not counting roots.
    pub inside: usize,
    /// How deep the deepest of them is, in the mesh's units.
    pub deepest: f64,
    /// Strands whose root jumped, and whose velocity counts one side of the jump or nothing.
    pub teleported: usize,
}

impl CarryReport {
    pub(crate) fn count(&mut self, pushed: Pushed) {
        (self.pushed, self.inside, self.deepest) = (pushed.pushed, pushed.inside, pushed.deepest);
    }
}
