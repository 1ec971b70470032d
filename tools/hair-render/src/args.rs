//! What can be said on the command line.

use std::path::PathBuf;
use std::str::FromStr;

use clap::builder::PossibleValuesParser;
use clap::{Parser, ValueEnum};
use fibre_material::Material;
use glam::{DVec3, Vec3};
use hair_render::{Aov, AovSet};

use crate::farm_args::FarmArgs;
use crate::motion_args::MotionArgs;

/// Path-traces a groom to a multi-layer EXR: beauty, alpha and a pass for every lobe.
///
/// Prints the estimated relative error and the seconds on stderr. World space is Y up, in metres;
/// angles are in degrees. Asked to end (Ctrl-C, SIGTERM), it keeps the samples so far in .NAME.part.exr, and the
/// same command goes on from there: the picture has the bits of one that was never stopped. Exit codes: 0 done,
/// 2 could not, 75 stopped, try again, 130 ended at once by a second Ctrl-C.
#[derive(Debug, Parser)]
#[command(
    version,
    override_usage = "hair-render [OPTIONS] --output <FILE> <GROOM>\n       hair-render --write-studio <FILE>\n       hair-render --list-presets"
)]
pub struct Args {
    /// The groom: .hair, .txt, .usda, .usdc, .usdz, .abc, .gltf, .glb, .ply and others; .usd* and .abc may move
    #[arg(required_unless_present_any = ["write_studio", "list_presets"])]
    pub groom: Option<PathBuf>,

    /// The picture to write (.exr)
    #[arg(short, long, value_name = "FILE", required_unless_present_any = ["write_studio", "list_presets"])]
    pub output: Option<PathBuf>,

    /// Also write a tone-mapped preview (.png)
    #[arg(long, value_name = "FILE")]
    pub png: Option<PathBuf>,

    /// Exposure of the preview, in stops
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub exposure: f32,

    /// Print a report of the frame as JSON on stdout
    #[arg(long)]
    pub json: bool,

    /// Print what was left out and why, on stderr
    #[arg(long)]
    pub explain: bool,

    #[command(flatten)]
    pub quality: Quality,
    #[command(flatten)]
    pub light: Light,
    #[command(flatten)]
    pub view: View,
    #[command(flatten)]
    pub fibre: Fibre,
    #[command(flatten)]
    pub input: Input,
    #[command(flatten)]
    pub motion: MotionArgs,
    #[command(flatten)]
    pub farm: FarmArgs,

    /// Write the built-in studio environment (.exr) and do nothing else
    #[arg(long, value_name = "FILE", conflicts_with_all = ["groom", "output"])]
    pub write_studio: Option<PathBuf>,

    /// Print the presets, what they say and where their figures are from, and do nothing else
    #[arg(long, conflicts_with_all = ["groom", "output", "write_studio"])]
    pub list_presets: bool,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Quality")]
pub struct Quality {
    /// Samples a pixel
    #[arg(long, default_value_t = 64)]
    pub spp: u32,
    /// Seed of everything random
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// Threads (the picture does not depend on it) [default: one a core]
    #[arg(long)]
    pub threads: Option<usize>,
    /// Scatterings after the first; light hair needs 64 and more
    #[arg(long, default_value_t = 256)]
    pub max_bounces: u32,
    /// Russian roulette may end paths from this scattering on
    #[arg(long, default_value_t = 16)]
    pub roulette_start: u32,
    /// Passes, by name and comma: R, TT, TRT, residual, scattered, surface, background; or `all`, `none`
    /// [default: R, TT, TRT, residual, surface, and scattered where there is fur]
    #[arg(long, value_parser = parse_aovs)]
    pub aovs: Option<AovSet>,
    /// Store 16-bit floats instead of 32
    #[arg(long)]
    pub half: bool,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Light")]
pub struct Light {
    /// Environment picture, latitude and longitude (.hdr, .exr) [default: the built-in studio]
    #[arg(long, value_name = "FILE")]
    pub env: Option<PathBuf>,
    /// A constant environment instead: one number or r,g,b
    #[arg(long, value_name = "RGB", conflicts_with = "env", value_parser = parse_rgb)]
    pub env_color: Option<Vec3>,
    /// Turn the environment about the up axis, in degrees, anticlockwise seen from above
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub env_rotate: f32,
    /// Factor on the environment's radiance
    #[arg(long, default_value_t = 1.0)]
    pub env_intensity: f32,
    /// A square light: x,y,z,side,radiance, facing the middle of the scene; may be repeated
    #[arg(long, value_name = "X,Y,Z,SIDE,RADIANCE", allow_hyphen_values = true)]
    pub area_light: Vec<Numbers<5>>,
    /// Show the area lights to the camera; they light the hair either way
    #[arg(long)]
    pub visible_lights: bool,
    /// Show the environment behind the hair instead of a transparent background
    #[arg(long)]
    pub background: bool,
}

#[derive(Clone, Copy, Debug, clap::Args)]
#[command(next_help_heading = "View")]
pub struct View {
    /// Pixels across
    #[arg(long, default_value_t = 512)]
    pub width: u32,
    /// Pixels down
    #[arg(long, default_value_t = 512)]
    pub height: u32,
    /// Only this part of the picture, as shares of its width and height from the upper left corner
    #[arg(long, value_name = "X0,X1,Y0,Y1")]
    pub crop: Option<Numbers<4>>,
    /// Degrees about the up axis: 0 stands on the +Z side, 90 on the +X side
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub azimuth: f64,
    /// Degrees above the horizon
    #[arg(long, default_value_t = 0.0, allow_hyphen_values = true)]
    pub elevation: f64,
    /// Metres from the target [default: so that the scene fits]
    #[arg(long)]
    pub distance: Option<f64>,
    /// Vertical field of view in degrees
    #[arg(long, default_value_t = 30.0)]
    pub fov: f64,
    /// What the camera looks at [default: the middle of the scene]
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub look_at: Option<Numbers<3>>,
    /// Where the camera stands, instead of azimuth, elevation and distance
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true, conflicts_with_all = ["distance"])]
    pub from: Option<Numbers<3>>,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Hair")]
pub struct Fibre {
    /// A material file (.yaml): colour, roughness, medulla, how strands differ; see samples/materials
    #[arg(long, value_name = "FILE", conflicts_with_all = ["preset", "color", "melanin", "absorption",
        "beta_m", "beta_n", "alpha", "eta"])]
    pub material: Option<PathBuf>,
    /// A material that comes with the program, by name: see --list-presets
    #[arg(long, value_name = "NAME", hide_possible_values = true,
        value_parser = PossibleValuesParser::new(Material::preset_names()),
        conflicts_with_all = ["color", "melanin", "absorption", "beta_m", "beta_n", "alpha", "eta"])]
    pub preset: Option<String>,
    /// Colour r,g,b instead of the groom's own, linear Rec. 709
    #[arg(long, value_name = "RGB", value_parser = parse_rgb)]
    pub color: Option<Vec3>,
    /// Change the absorption until this groom, lit evenly, has the one colour it was given (`--color`, or
    /// `color` in the material) as its mean: takes some small renders first, and tells how far off Chiang's
    /// fit was
    #[arg(long)]
    pub match_color: bool,
    /// Melanin concentration and redness, 0..1 each
    #[arg(long, value_name = "C,R", conflicts_with = "color")]
    pub melanin: Option<Numbers<2>>,
    /// Absorption r,g,b per fibre radius
    #[arg(long, value_name = "RGB", value_parser = parse_rgb, conflicts_with_all = ["color", "melanin"])]
    pub absorption: Option<Vec3>,
    /// Roughness along the fibre, above 0, at most 1
    #[arg(long, default_value_t = 0.3)]
    pub beta_m: f32,
    /// Roughness around the fibre, above 0, at most 1
    #[arg(long, default_value_t = 0.3)]
    pub beta_n: f32,
    /// Tilt of the cuticle's scales in degrees
    #[arg(long, default_value_t = 2.0, allow_hyphen_values = true)]
    pub alpha: f32,
    /// Index of refraction
    #[arg(long, default_value_t = 1.55)]
    pub eta: f32,
    /// Let rays pass fibres as the groom's transparency says (ignored otherwise: the fibres already
    /// transmit light by refraction)
    #[arg(long)]
    pub use_transparency: bool,
    /// For looking into the model: one offset across the fibre for all hits, -1..1, instead of where each
    /// ray meets it (the "shift" of older shaders)
    #[arg(long, value_name = "H", allow_hyphen_values = true)]
    pub fixed_offset: Option<f32>,
}

#[derive(Debug, clap::Args)]
#[command(next_help_heading = "Input")]
pub struct Input {
    /// A matte mesh beside the hair (.obj, .gltf, .glb, .usd*; name.####.obj for a sequence), Y up and in metres
    /// where it does not say; may be repeated
    #[arg(long, value_name = "FILE")]
    pub mesh: Vec<PathBuf>,
    /// What the meshes reflect: one number or r,g,b
    #[arg(long, value_name = "RGB", default_value = "0.5,0.36,0.28", value_parser = parse_rgb)]
    pub mesh_albedo: Vec3,
    /// Which way is up in the groom [default: what its format has as custom]
    #[arg(long, value_enum)]
    pub input_up: Option<Up>,
    /// Metres in one unit of the groom [default: 1]
    #[arg(long)]
    pub meters_per_unit: Option<f64>,
    /// Mend what is odd in the groom
    #[arg(long)]
    pub repair: bool,
}

/// An up axis by name.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub enum Up {
    /// Y points up
    Y,
    /// Z points up
    Z,
}

/// `N` finite numbers, separated by commas.
#[derive(Clone, Copy, Debug)]
pub struct Numbers<const N: usize>(pub [f64; N]);

impl<const N: usize> FromStr for Numbers<N> {
    type Err = String;

    fn from_str(words: &str) -> Result<Self, String> {
        let numbers = words.split(',').map(|word| word.trim().parse::<f64>());
        let numbers: Vec<f64> = numbers.collect::<Result<_, _>>().map_err(|fault| fault.to_string())?;
        if let Some(odd) = numbers.iter().find(|v| !v.is_finite()) {
            return Err(format!("{odd} is not finite"));
        }
        let found = numbers.len();
        numbers.try_into().map(Numbers).map_err(|_| format!("expected {N} numbers, found {found}"))
    }
}

impl Numbers<3> {
    pub fn vector(self) -> DVec3 {
        DVec3::from_array(self.0)
    }
}

fn parse_rgb(words: &str) -> Result<Vec3, String> {
    if let Ok(Numbers([grey])) = words.parse() {
        return Ok(Vec3::splat(grey as f32));
    }
    words.parse::<Numbers<3>>().map(|rgb| rgb.vector().as_vec3())
}

fn parse_aovs(words: &str) -> Result<AovSet, String> {
    match words {
        "all" => Ok(AovSet::all()),
        "none" => Ok(AovSet::none()),
        _ => words
            .split(',')
            .map(|name| {
                let known = || {
                    let names: Vec<&str> = Aov::ALL.into_iter().map(Aov::name).collect();
                    format!("unknown pass `{name}`: expected {}", names.join(", "))
                };
                Aov::from_name(name.trim()).ok_or_else(known)
            })
            .collect(),
    }
}

#[cfg(test)]
mod tests {
    use clap::CommandFactory;

    use super::*;

    #[test]
    fn the_definition_is_sound() {
        Args::command().debug_assert();
    }

    #[test]
    fn values_are_read_or_refused() {
        assert_eq!(parse_rgb("0.5").unwrap(), Vec3::splat(0.5));
        assert_eq!(parse_rgb("1, 2,3").unwrap(), Vec3::new(1.0, 2.0, 3.0));
        assert!(parse_rgb("1,2").is_err() && parse_rgb("nan").is_err() && parse_rgb("").is_err());
        assert_eq!(parse_aovs("tt,R").unwrap().iter().count(), 2);
        assert!(parse_aovs("glint").unwrap_err().contains("glint"));
        assert!(parse_aovs("scattered").unwrap().contains(Aov::Scattered));
    }
}
