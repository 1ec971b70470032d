//! Makes straight, wavy and curly heads of hair, and fur on any mesh.

mod arrays;
mod fur;
mod hair_file;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use anyhow::Context;
use clap::{Args, Parser, Subcommand};
use command_line::Outcome;
use cyhair::HairFile;
use groom_samples::{Options, Style};
use whole_file::WholeFile;

use crate::arrays::Arrays;

/// Makes straight, wavy and curly heads of hair, the head they grow on, and fur on any mesh.
///
/// Hair is written as a HAIR (cyHair) file: metres, y up, face towards +z. The same options give the
/// same bytes on every machine. Exit codes: 0 made, 2 could not.
#[derive(Parser)]
#[command(name = "groom-samples", version, args_conflicts_with_subcommands = true)]
struct Cli {
    #[command(subcommand)]
    command: Option<Command>,
    #[command(flatten)]
    hair: Option<HairArgs>,
}

#[derive(Subcommand)]
enum Command {
    /// Writes the head as a Wavefront OBJ mesh
    Head {
        /// The file to write
        #[arg(short, long, value_name = "FILE.obj")]
        output: PathBuf,
    },
    /// Writes the head as a character that nods, as binary glTF: two joints, a morph target, two animations
    NoddingHead {
        /// The file to write
        #[arg(short, long, value_name = "FILE.glb")]
        output: PathBuf,
    },
    /// Grows fur on a mesh, in its rest pose
    Fur(fur::FurArgs),
}

#[derive(Args)]
struct HairArgs {
    /// straight, wavy or curly
    #[arg(long, default_value = "straight")]
    style: Style,
    /// How many strands (1 to 16777216)
    #[arg(long, value_name = "N", default_value_t = 10_000)]
    strands: u32,
    /// How many points a strand (3 to 1000); with a segments array shorter strands get fewer
    #[arg(long, value_name = "N", default_value_t = 16)]
    points: u32,
    /// Another seed makes other hair of the same kind
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Arrays to write, out of segments,points,thickness,transparency,colors; or none, or all
    #[arg(long, value_name = "LIST", default_value = "points,thickness")]
    arrays: Arrays,
    /// The file to write
    #[arg(short, long, value_name = "FILE.hair")]
    output: PathBuf,
}

fn main() -> ExitCode {
    let cli = Cli::parse();
    command_line::run(|| {
        match (cli.command, cli.hair) {
            (Some(Command::Head { output }), _) => {
                whole_file::write_whole(output, groom_samples::head_obj().as_bytes())?;
            }
            (Some(Command::NoddingHead { output }), _) => {
                whole_file::write_whole(output, &groom_samples::nodding_head_glb())?;
            }
            (Some(Command::Fur(args)), _) => fur::make(&args)?,
            (None, Some(args)) => make_hair(&args)?,
            (None, None) => anyhow::bail!("nothing to make; see --help"),
        }
        Ok(Outcome::Good)
    })
}

fn make_hair(args: &HairArgs) -> anyhow::Result<()> {
    let options = Options {
        style: args.style,
        strands: args.strands,
        points: args.points,
        vary_points: args.arrays.segments,
        seed: args.seed,
        color: args.arrays.colors,
        transparency: args.arrays.transparency,
    };
    let groom = groom_samples::hair(&options)?;
    let info = format!("groomkit {} sample, seed {}; metres, y up", args.style, args.seed);
    let file = hair_file::from_groom(&groom, args.arrays, &info);
    write_hair(&file, &args.output)
}

fn write_hair(file: &HairFile, path: &Path) -> anyhow::Result<()> {
    let mut output = WholeFile::create(path)?;
    file.write(&mut output).with_context(|| format!("cannot write {}", path.display()))?;
    Ok(output.commit()?)
}
