//! The command line.

mod aligning;
mod attributes;
mod binding;
mod carrying;
mod mesh;
mod shutter;
mod values;
mod writing;

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use clap::{ArgGroup, Parser};

pub(crate) use aligning::Aligning;
pub(crate) use attributes::Attributes;
pub(crate) use binding::{BindingOptions, Far, Place};
pub(crate) use carrying::{Carrying, Mode};
pub(crate) use mesh::{MeshArgs, Rest, Which};
pub(crate) use shutter::ShutterArgs;
pub(crate) use values::FrameRange;
pub(crate) use writing::Writing;

const EXIT_AND_EXAMPLES: &str = "\
Distances and speeds are in the mesh's numbers. A frame F is the time F / rate: a USD time code, the number of an OBJ \
file, seconds times --fps of a glTF animation.

Exit status: 0 done, 1 --check found errors, 2 could not (bad input or usage), 130 stopped by Ctrl-C.

Examples:
  groom-bind hair.hair --mesh head.glb --animation Walk --frames 1-48 -o walk.usdc
  groom-bind hair.hair --mesh head.glb --up y --scale 0.01 --report - > distances.json
  groom-bind hair.hair --mesh head.####.obj --fps 25 -o out.####.hair
  groom-bind fur.abc --mesh bear.usdc --mode blended --avoid-penetration -o bear-fur.abc
  groom-bind hair.hair --mesh head.glb --as-skinned -o hair.glb
  groom-bind --mesh head.glb --list-animations";

/// Binds the strands of a groom to a mesh that moves, and writes them moving with it.
///
/// Each strand is bound by its root to the nearest place of the mesh's rest pose, at its height over it, and goes
/// where that place goes. The mesh is glTF, USD, OBJ or a sequence `head.####.obj`; the output's ending says the
/// format: .usda, .usdc, .usdz and .abc hold every frame with velocities, .gltf and .glb morph targets,
/// `out.####.hair` (or any still format) is a file a frame. Files are written whole or not at all.
#[derive(Debug, Parser)]
#[command(
    name = "groom-bind",
    version,
    after_help = EXIT_AND_EXAMPLES,
    override_usage = "groom-bind [OPTIONS] <GROOM> --mesh <FILE> --output <FILE>\n       \
        groom-bind [OPTIONS] <GROOM> --mesh <FILE> --report <FILE>\n       \
        groom-bind --mesh <FILE> --list-animations\n       \
        groom-bind --stability"
)]
#[command(group = ArgGroup::new("alone").args(["list_animations", "stability"]))]
#[command(group = ArgGroup::new("result").args(["output", "report", "list_animations", "stability", "accuracy"])
    .multiple(true).required(true))]
pub(crate) struct Args {
    /// Groom to bind, in any format that `cyhair-convert --formats` reads
    #[arg(required_unless_present = "alone", conflicts_with = "alone")]
    groom: Option<PathBuf>,

    /// File to write; `out.####.hair` is a file a frame
    #[arg(short, long, value_name = "FILE", conflicts_with = "alone")]
    pub(crate) output: Option<PathBuf>,

    /// Write how far the roots are from the mesh, strand by strand, and what happened in each frame: .json, .csv
    /// (strands only), or `-` for JSON on standard output
    #[arg(long, value_name = "FILE", conflicts_with = "alone")]
    pub(crate) report: Option<PathBuf>,

    /// Say what was done as JSON on standard output
    #[arg(long)]
    pub(crate) json: bool,

    /// Print how binding and carrying stand extreme cases, and do nothing else; exit 1 if one is not stood
    #[arg(long)]
    pub(crate) stability: bool,

    /// Write error against time on this groom and mesh: of velocities by how far apart the poses are they are taken
    /// from, of --mode blended by the places of the mesh it goes through: .json, .csv, .html, or `-` for JSON
    #[arg(long, value_name = "FILE", conflicts_with = "alone")]
    pub(crate) accuracy: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) mesh: MeshArgs,

    #[command(flatten)]
    pub(crate) aligning: Aligning,

    #[command(flatten)]
    pub(crate) binding: BindingOptions,

    #[command(flatten)]
    pub(crate) carrying: Carrying,

    #[command(flatten)]
    pub(crate) shutter: ShutterArgs,

    #[command(flatten)]
    pub(crate) attributes: Attributes,

    #[command(flatten)]
    pub(crate) writing: Writing,
}

impl Args {
    /// The groom to bind; only what runs alone goes without.
    pub(crate) fn groom(&self) -> &Path {
        self.groom.as_deref().unwrap_or(Path::new(""))
    }

    /// The mesh to bind to.
    pub(crate) fn mesh(&self) -> Result<&Path> {
        let Some(mesh) = self.mesh.mesh.as_deref() else { bail!("no mesh was given: --mesh FILE") };
        Ok(mesh)
    }

    /// How many answers want standard output.
    pub(crate) fn answers_on_stdout(&self) -> usize {
        let files = [&self.report, &self.accuracy];
        files.into_iter().flatten().filter(|path| is_stream(path)).count() + usize::from(self.json)
    }
}

/// Whether a path is the `-` that stands for a standard stream.
pub(crate) fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_command_line_is_sound() {
        Args::command().debug_assert();
    }

    #[test]
    fn something_must_be_wanted() {
        let parse = |line: &str| Args::try_parse_from(line.split(' '));
        for line in [
            "groom-bind a.hair --mesh b.glb -o c.usdc",
            "groom-bind a.hair --mesh b.glb --report -",
            "groom-bind --mesh b.glb --list-animations",
            "groom-bind --stability",
            "groom-bind a.hair --mesh b.glb -o c.usdc --frames -3-5:0.5 --avoid-penetration --teleport 2",
            "groom-bind a.hair --mesh b.glb -o c.usdc --avoid-penetration=0.1 --translate -1,0,2 --shutter -0.5:0",
        ] {
            assert!(parse(line).is_ok(), "{line}: {}", parse(line).unwrap_err());
        }
        for line in [
            "groom-bind a.hair --mesh b.glb",
            "groom-bind --mesh b.glb -o c.usdc",
            "groom-bind a.hair -o c.usdc",
            "groom-bind a.hair --mesh b.glb -o c.usdc --stability",
            "groom-bind --stability --list-animations --mesh b.glb",
            "groom-bind --stability --accuracy -",
            "groom-bind a.hair --mesh b.glb -o c.usdc --matrix 1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1 --scale 2",
            "groom-bind a.hair --mesh b.glb -o c.usdc --beyond drop",
        ] {
            assert!(parse(line).is_err(), "{line}");
        }
    }
}
