//! Which mesh, and what of its motion.

use std::path::PathBuf;

use clap::Args;

use super::values::{FrameRange, frames, over_zero};

/// The mesh and its motion.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Mesh")]
pub(crate) struct MeshArgs {
    /// Mesh to bind to: .gltf, .glb, .obj, .usda, .usdc, .usdz, or a sequence `head.####.obj`
    #[arg(long, value_name = "FILE", required_unless_present = "stability")]
    pub(crate) mesh: Option<PathBuf>,

    /// Which animation of a glTF mesh, by name or by number from 0 [default: the first]
    #[arg(long, value_name = "NAME|NUMBER", value_parser = which)]
    pub(crate) animation: Option<Which>,

    /// List the mesh's animations with their times, and do nothing else
    #[arg(long)]
    pub(crate) list_animations: bool,

    /// Frames to carry, first-last or first-last:step, as 1-48, -10-20:2 or 5 [default: all of the animation]
    #[arg(long, value_name = "A-B[:STEP]", value_parser = frames, allow_hyphen_values = true)]
    pub(crate) frames: Option<FrameRange>,

    /// Frames a second (over 0) [default: the mesh's own, or 24]
    #[arg(long, value_name = "RATE", value_parser = over_zero)]
    pub(crate) fps: Option<f64>,

    /// The pose the strands were made for: `bind` (a skin as it was modelled), `nodes` (as the file stands), or
    /// the number of a frame
    #[arg(long, value_name = "POSE", value_parser = rest, default_value = "bind", allow_hyphen_values = true)]
    pub(crate) rest: Rest,
}

/// An animation as it was asked for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Which {
    Name(String),
    Index(usize),
}

/// A rest pose as it was asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Rest {
    Bind,
    Nodes,
    Frame(f64),
}

fn which(text: &str) -> Result<Which, String> {
    Ok(text.parse().map_or_else(|_| Which::Name(text.to_owned()), Which::Index))
}

fn rest(text: &str) -> Result<Rest, String> {
    match text {
        "bind" => Ok(Rest::Bind),
        "nodes" => Ok(Rest::Nodes),
        frame => frame
            .parse()
            .ok()
            .filter(|frame: &f64| frame.is_finite())
            .map(Rest::Frame)
            .ok_or_else(|| "expected bind, nodes or the number of a frame".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn animations_and_rest_poses() {
        assert_eq!(which("2"), Ok(Which::Index(2)));
        assert_eq!(which("Run 2"), Ok(Which::Name("Run 2".into())));
        assert_eq!(rest("-1.5"), Ok(Rest::Frame(-1.5)));
        assert!(rest("nan").is_err() && rest("tpose").is_err());
    }
}
