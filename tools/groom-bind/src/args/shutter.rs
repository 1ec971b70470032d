//! What is written for motion blur.

use clap::{Args, value_parser};

use super::values::shutter;

/// What is written for motion blur.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Motion blur")]
pub(crate) struct ShutterArgs {
    /// Write velocities, in the mesh's units a second (.usd*, .abc); this is the default
    #[arg(long, overrides_with = "no_velocity")]
    velocity: bool,

    /// Write no velocities
    #[arg(long)]
    no_velocity: bool,

    /// Write accelerations too, in units a second squared (.usd*)
    #[arg(long, conflicts_with = "no_velocity")]
    pub(crate) accelerations: bool,

    /// When the shutter opens and closes, in frames from the frame itself (1 long at most); velocities are
    /// differences over as long a time about the frame
    #[arg(long, value_name = "OPEN:CLOSE", value_parser = shutter, default_value = "-0.25:0.25",
        allow_hyphen_values = true)]
    pub(crate) shutter: [f64; 2],

    /// Write the points this often from shutter open to close instead of once at the frame (2 to 64)
    #[arg(long, value_name = "N", value_parser = value_parser!(u32).range(2..=64))]
    pub(crate) shutter_samples: Option<u32>,
}

impl ShutterArgs {
    pub(crate) fn velocities(&self) -> bool {
        !self.no_velocity || self.velocity
    }

    /// Whether velocities were asked for by name.
    pub(crate) fn velocities_asked(&self) -> bool {
        self.velocity
    }

    /// When the points of a frame are written, in frames from it.
    pub(crate) fn offsets(&self) -> Vec<f64> {
        let [open, close] = self.shutter;
        match self.shutter_samples {
            None => vec![0.0],
            Some(count) => {
                let last = f64::from(count.max(2) - 1);
                (0..count).map(|i| open + (close - open) * (f64::from(i) / last)).collect()
            }
        }
    }

    /// How far before and after it the poses lie of which velocities are taken, in frames.
    pub(crate) fn reach(&self) -> f64 {
        0.5 * (self.shutter[1] - self.shutter[0])
    }
}
