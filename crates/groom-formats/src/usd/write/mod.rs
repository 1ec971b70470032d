//! USD: one BasisCurves prim of linear curves, at `/Groom/Strands`, in text, crates and packages alike.
//!
//! | groom | USD |
//! |---|---|
//! | points | `points`, `curveVertexCounts`, `extent` (points +- half the largest width) |
//! | radius | `widths`: diameters, always per vertex |
//! | color | `primvars:displayColor` (linear) |
//! | transparency | `primvars:displayOpacity` = 1 - transparency |
//! | id, root_uv | `primvars:id`, `primvars:st` |
//! | velocity | `velocities`, per point and second |
//! | any other (group, guide) | `primvars:NAME` |
//! | constant, per strand, per vertex | interpolation `constant`, `uniform`, `vertex` |
//! | unit, up axis | `metersPerUnit`, `upAxis`: nothing is turned or scaled |
//!
//! The curves are polylines, as grooms are, so `type` is `linear`; `basis` and `wrap` then mean nothing
//! but are authored too, because readers differ on the fallbacks.
//!
//! In motion, `points`, `extent`, `velocities` and `accelerations` are sampled at the same times: UsdGeom passes over
//! velocities and accelerations of other times. All else is said once. An origin is the curves' `xformOp:translate`, and
//! points and extent are local to it.
//!
//! Velocities are units per second, whatever `timeCodesPerSecond` is. Blender 5.0 keeps them as they are in the attribute
//! `velocity` of its curves, in the axes of the prim, and Cycles blurs by them over a frame of the scene's rate, so the
//! scene must have the stage's; it takes a time code for a frame.
//!
//! Joints ([`write_rigged`](crate::write_rigged)) are UsdSkel: `/Groom` is a SkelRoot, `/Groom/Skeleton` has a
//! SkelAnimation below it, and the curves have `primvars:skel:jointIndices` and `jointWeights` per vertex, because of
//! values per curve (`uniform`) UsdSkel bakes nothing and does not say so. Its scales have 16 bits.
//!
//! # Dialects
//!
//! What [`Dialect`](crate::Dialect) changes; all of them stay valid USD for everybody else.
//!
//! | for | what changes | why |
//! |---|---|---|
//! | Unreal | `GroomAPI` on `/Groom`; besides the primvars above `groom_id`, `groom_group_id`, `groom_guide` (int), `groom_root_uv` (float2) per strand and `groom_color` (float3) per point; other attributes become `groom_NAME` | Unreal makes a groom of prims with that schema, reads `groom_*` only, drops `color3f` without a word |
//! | Karma | cubic catmullRom curves with a phantom point at both ends, 2 P0 - P1; what belongs to points is repeated there, velocities are extended like points | Karma takes `pinned` for `nonperiodic` and would lose the first and last span |
//! | Houdini | besides the above `primvars:hairid` and `primvars:width` (diameters) | hair nodes look for these; `widths` alone arrives as `pscale` |
//! | Blender | besides the above `primvars:surface_uv_coordinate` from root_uv | the name Blender's hair nodes look for the root by |

mod array;
#[cfg(feature = "usdc")]
mod crate_sink;
mod curves;
mod extent;
mod half;
mod material;
mod motion;
mod primvars;
mod sink;
mod skeleton;
mod stage;
#[cfg(feature = "usda")]
mod text_sink;

use std::io::{Seek, Write};

use glam::DVec3;
use groom::{Groom, names};
use usd_layer::write::{CrateWriter, PackageWriter, WriteError};

use crate::animation::Motion;
use crate::rig::RigMotion;
use crate::usd::write::curves::Curves;
use crate::usd::write::sink::Sink;
use crate::usd::write::stage::Stage;
use crate::{Dialect, Format, FormatError, Warning, WriteOptions};

/// The layer's name in a package.
const IN_PACKAGE: &str = "groom.usdc";

/// Writes a still as text.
#[cfg(feature = "usda")]
pub(crate) fn write_usda(
    groom: &Groom,
    stream: &mut impl Write,
    file: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let mut warnings = Vec::new();
    let job = Job { format: Format::Usda, file, options };
    let curves = job.curves(groom, &mut warnings)?;
    job.fill_text(stream, &curves, Moves::Nothing, &mut warnings)?;
    Ok(warnings)
}

/// Writes a still as a crate or a package.
#[cfg(feature = "usdc")]
pub(crate) fn write_crate(
    groom: &Groom,
    format: Format,
    stream: &mut (impl Write + Seek),
    file: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let job = Job { format, file, options };
    let mut warnings = Vec::new();
    let curves = job.curves(groom, &mut warnings)?;
    job.fill_crate(stream, &curves, Moves::Nothing, &mut warnings)?;
    Ok(warnings)
}

/// Writes a groom that moves.
pub(crate) fn write_animation(
    motion: Motion<'_>,
    format: Format,
    stream: &mut (impl Write + Seek),
    file: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let job = Job { format, file, options };
    let mut warnings = Vec::new();
    let curves = job.curves(motion.groom, &mut warnings)?;
    job.fill_any(stream, &curves, Moves::Points(motion), &mut warnings)?;
    Ok(warnings)
}

/// Writes a groom and the skeleton that moves it.
pub(crate) fn write_rigged(
    motion: RigMotion<'_>,
    format: Format,
    stream: &mut (impl Write + Seek),
    file: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let job = Job { format, file, options };
    let mut warnings = Vec::new();
    let curves = job.curves(motion.groom, &mut warnings)?;
    if motion.groom.attribute(names::VELOCITY).is_some() {
        // Joints move the points, not what stands beside them.
        warnings.push(Warning::AttributeLeftOut { format, name: names::VELOCITY.to_owned() });
    }
    let skeleton = skeleton::Skeleton::of(motion, &curves, format, file, &mut warnings)?;
    job.fill_any(stream, &curves, Moves::Joints(&skeleton), &mut warnings)?;
    Ok(warnings)
}

/// What moves the curves.
enum Moves<'a> {
    Nothing,
    Points(Motion<'a>),
    Joints(&'a skeleton::Skeleton),
}

/// What is to be written, and how.
#[derive(Clone, Copy)]
struct Job<'a> {
    format: Format,
    file: &'a str,
    options: &'a WriteOptions,
}

impl Job<'_> {
    fn curves<'a>(self, groom: &'a Groom, warnings: &mut Vec<Warning>) -> Result<Curves<'a>, FormatError> {
        let phantoms = self.options.dialect == Some(Dialect::Karma);
        let curves = Curves::new(groom, phantoms, self.format, self.file, warnings)?;
        extent::refuse_too_wide(
            &stage::positions(&curves),
            &primvars::widths(&curves),
            self.format,
            self.file,
        )?;
        Ok(curves)
    }

    /// Says the stage to `sink`.
    fn fill<S: Sink>(
        self,
        sink: &mut S,
        curves: &Curves<'_>,
        moves: Moves<'_>,
        warnings: &mut Vec<Warning>,
    ) -> Result<(), FormatError> {
        let Job { format, file, options } = self;
        let (motion, skeleton) = match moves {
            Moves::Nothing => (None, None),
            Moves::Points(motion) => (Some(motion), None),
            Moves::Joints(skeleton) => (None, Some(skeleton)),
        };
        let origin = motion.as_ref().map_or(DVec3::ZERO, |motion| motion.options.origin);
        let samples = motion.map(|motion| motion::store(sink, curves, motion, format, file)).transpose()?;
        let still_velocity = curves.groom.attribute(names::VELOCITY).is_some();
        if still_velocity && samples.as_ref().is_some_and(|samples| samples.velocities.is_empty()) {
            // Velocities count only with a sample wherever the points have one.
            let name = names::VELOCITY.to_owned();
            warnings.push(Warning::AttributeLeftOut { format, name });
        }
        let primvars = primvars::all(curves, options.dialect, format, warnings);
        let look = options.look.as_ref();
        let stage = Stage { curves, primvars: &primvars, dialect: options.dialect, look, origin, skeleton };
        stage.write(sink, samples.as_ref()).map_err(|e| failed(e, format, file))
    }

    /// Writes the stage in whichever form the format has.
    fn fill_any(
        self,
        stream: &mut (impl Write + Seek),
        curves: &Curves<'_>,
        moves: Moves<'_>,
        warnings: &mut Vec<Warning>,
    ) -> Result<(), FormatError> {
        match self.format {
            #[cfg(feature = "usda")]
            Format::Usda => self.fill_text(stream, curves, moves, warnings),
            #[cfg(feature = "usdc")]
            _ => self.fill_crate(stream, curves, moves, warnings),
            #[cfg(not(feature = "usdc"))]
            _ => Ok(()),
        }
    }

    #[cfg(feature = "usda")]
    fn fill_text(
        self,
        stream: &mut impl Write,
        curves: &Curves<'_>,
        moves: Moves<'_>,
        warnings: &mut Vec<Warning>,
    ) -> Result<(), FormatError> {
        let mut sink = text_sink::TextSink::new(stream, curves);
        self.fill(&mut sink, curves, moves, warnings)?;
        sink.finish().map_err(|e| FormatError::io(self.file, e))
    }

    #[cfg(feature = "usdc")]
    fn fill_crate(
        self,
        stream: &mut (impl Write + Seek),
        curves: &Curves<'_>,
        moves: Moves<'_>,
        warnings: &mut Vec<Warning>,
    ) -> Result<(), FormatError> {
        let failed = |e: WriteError| failed(e, self.format, self.file);
        if self.format == Format::Usdz {
            let mut package = PackageWriter::new(stream, IN_PACKAGE).map_err(failed)?;
            let mut sink = crate_sink::CrateSink::new(package.layer());
            self.fill(&mut sink, curves, moves, warnings)?;
            package.finish().map_err(failed)?;
        } else {
            let mut layer = CrateWriter::new(stream).map_err(failed)?;
            let mut sink = crate_sink::CrateSink::new(&mut layer);
            self.fill(&mut sink, curves, moves, warnings)?;
            layer.finish().map_err(failed)?;
        }
        Ok(())
    }
}

fn failed(error: WriteError, format: Format, file: &str) -> FormatError {
    let file = file.to_owned();
    match error {
        WriteError::Io(source) => FormatError::Io { file, source },
        WriteError::TooLarge { what, found, limit } => {
            FormatError::TooLarge { file, format, what, found, limit }
        }
        // Paths and prims are this module's own; should one be broken, it is told as it is.
        other => FormatError::Io { file, source: std::io::Error::other(other) },
    }
}
