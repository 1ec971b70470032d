//! How strands are carried.

use glam::DVec3;

use crate::BindingError;

/// How a strand goes with the mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum CarryMode {
    /// As a rigid body, by the frame of its root: every length and angle in it is kept.
    #[default]
    Rigid,
    /// Rigid at its root and more and more, towards its tip, as the mesh deforms the space around it.
    Blended(Blend),
}

/// How strands follow the deformation of the mesh.
///
/// A point at the part `t` of its strand's length, 0 at the root and 1 at the tip, follows `t` to the power of `power`
/// of what the deformation differs by from the rigid motion, as seen from the root. The root stays where it is bound and
/// keeps its direction whatever the power.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Blend {
    /// At most how many places of the mesh the deformation goes through, 4 to 2000. More follow the mesh more
    /// closely and cost more, in proportion.
    pub anchors: usize,
    /// 1 follows evenly from root to tip, more is stiffer at the root; 0.1 to 10.
    pub power: f32,
    /// Whether segments get the lengths they have at rest back, from root to tip. Without it strands stretch with
    /// the space around them.
    pub restore_lengths: bool,
}

impl Default for Blend {
    fn default() -> Self {
        Blend { anchors: 96, power: 1.0, restore_lengths: false }
    }
}

/// How strands are carried: as rigid bodies, through whatever is in their way, unless one says otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CarryOptions {
    /// How a strand goes with the mesh.
    pub mode: CarryMode,
    /// How far points stay over the posed mesh, in its units, 0 or more: those that are nearer, or inside, are
    /// pushed out. `None`: strands pass through.
    pub keep_out: Option<f64>,
    /// What positions are told relative to, in the mesh's units: a place near a character that is far from the
    /// origin, whose strands would lose their shape in single precision.
    pub origin: DVec3,
    /// Roots faster than this, in the mesh's units per second, have not moved but jumped: that counts for no
    /// velocity. A jump of so many units a frame is that times the frame rate. `None`: any motion counts.
    pub teleport: Option<f64>,
}

impl CarryOptions {
    pub(crate) fn check(&self) -> Result<(), BindingError> {
        let refuse = |name, found: String, expected| Err(BindingError::OutOfRange { name, found, expected });
        if let CarryMode::Blended(blend) = &self.mode {
            if !(4..=2000).contains(&blend.anchors) {
                return refuse("anchors", blend.anchors.to_string(), "4 to 2000");
            }
            if !(0.1..=10.0).contains(&blend.power) {
                return refuse("blend power", blend.power.to_string(), "0.1 to 10");
            }
        }
        match self.keep_out {
            Some(distance) if !(distance.is_finite() && distance >= 0.0) => {
                return refuse("keep out", distance.to_string(), "a finite distance, 0 or more");
            }
            _ => {}
        }
        if !self.origin.is_finite() {
            return refuse("origin", self.origin.to_string(), "finite numbers");
        }
        match self.teleport {
            Some(speed) if speed.is_nan() || speed <= 0.0 => {
                refuse("teleport", speed.to_string(), "a speed over 0")
            }
            _ => Ok(()),
        }
    }
}
