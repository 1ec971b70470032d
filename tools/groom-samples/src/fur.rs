//! `groom-samples fur`: a coat on somebody's mesh.

use std::path::PathBuf;

use anyhow::Context;
use clap::Args;
use glam::Vec3;
use groom_samples::{FurOptions, FurSurface, fur_on};
use moving_mesh::{MeshOptions, MovingMesh};

use crate::arrays::Arrays;
use crate::hair_file;

/// Fur in the mesh's own unit and with its axes: bind and render it with that mesh as it is.
#[derive(Args)]
pub struct FurArgs {
    /// The mesh to grow on, in its rest pose: .obj, .gltf, .glb or USD
    #[arg(long, value_name = "FILE")]
    mesh: PathBuf,
    /// How many strands (1 to 16777216)
    #[arg(long, value_name = "N", default_value_t = FurOptions::default().strands)]
    strands: u32,
    /// How many points a strand (2 to 1000)
    #[arg(long, value_name = "N", default_value_t = FurOptions::default().points)]
    points: u32,
    /// Length of the longest strand, as a part of the mesh's diagonal (over 0, up to 1)
    #[arg(long, value_name = "PART", default_value_t = FurOptions::default().length)]
    length: f32,
    /// How much shorter the shortest may be (0 to 1)
    #[arg(long, value_name = "PART", default_value_t = FurOptions::default().variation)]
    variation: f32,
    /// How much shorter fur is where the body is thin (0 to 1)
    #[arg(long, value_name = "PART", default_value_t = FurOptions::default().thin)]
    thin: f32,
    /// How far the fur leans: 0 stands up, 1 lies on the skin
    #[arg(long, value_name = "PART", default_value_t = FurOptions::default().lean)]
    lean: f32,
    /// Where the fur lies to; the default is back and down for an animal that looks along +z
    #[arg(long, value_name = "X,Y,Z", value_parser = direction, allow_hyphen_values = true, default_value = "0,-0.5,-1")]
    towards: Vec3,
    /// How far strands wind round their course, as a part of their length (0 to 1)
    #[arg(long, value_name = "PART", default_value_t = FurOptions::default().curl)]
    curl: f32,
    /// How much tips gather in tufts (0 to 1)
    #[arg(long, value_name = "PART", default_value_t = FurOptions::default().clump)]
    clump: f32,
    /// Another seed makes another coat of the same kind
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Arrays to write, out of segments,points,thickness,colors; or none
    #[arg(long, value_name = "LIST", default_value = "points,thickness")]
    arrays: Arrays,
    /// The file to write
    #[arg(short, long, value_name = "FILE.hair")]
    output: PathBuf,
}

/// Grows the fur and writes it.
pub fn make(args: &FurArgs) -> anyhow::Result<()> {
    let mesh = MovingMesh::open(&args.mesh, &MeshOptions::default())?;
    let rest = mesh.rest();
    let surface = FurSurface {
        positions: &rest.positions,
        triangles: mesh.triangles(),
        normals: rest.normals.as_deref(),
    };
    let options = FurOptions {
        strands: args.strands,
        points: args.points,
        seed: args.seed,
        length: args.length,
        variation: args.variation,
        thin: args.thin,
        lean: args.lean,
        towards: args.towards,
        curl: args.curl,
        clump: args.clump,
        color: args.arrays.colors,
    };
    let groom = fur_on(&surface, &options).with_context(|| format!("no fur on {}", args.mesh.display()))?;
    let info = format!("groomkit fur, seed {}; unit and axes of its mesh", args.seed);
    crate::write_hair(&hair_file::from_groom(&groom, args.arrays, &info), &args.output)
}

/// Three numbers with commas between.
fn direction(text: &str) -> Result<Vec3, String> {
    let numbers: Vec<f32> = text.split(',').map_while(|word| word.trim().parse().ok()).collect();
    match numbers[..] {
        [x, y, z] if text.split(',').count() == 3 => Ok(Vec3::new(x, y, z)),
        _ => Err(format!("`{text}` is no direction; expected three numbers, as 0,-0.5,-1")),
    }
}
