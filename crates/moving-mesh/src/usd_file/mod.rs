//! Mesh prims of USD layers.
//!
//! | USD | mesh |
//! |---|---|
//! | `points`, samples of them | positions, linear between samples |
//! | `faceVertexCounts`, `faceVertexIndices`, `holeIndices` | triangles: each face a fan from its first corner |
//! | `orientation` leftHanded, transforms that mirror | triangles turned round, so that all are counter-clockwise |
//! | `xformOpOrder` of the prim and those above, samples of it | transforms, linear between samples |
//! | `primvars:st`, else the first `texCoord2` primvar | texture coordinates at the first time |
//! | `primvars:normals`, else `normals` | normals, linear between samples |
//! | `material:binding`, UsdPreviewSurface `diffuseColor` | part name, base colour, texture |
//! | `upAxis` (fallback Y), `metersPerUnit` (0.01), `timeCodesPerSecond` (24) | the same |
//!
//! A face may give one point several texture coordinates or normals, one a corner: the point becomes as many
//! vertices, which stand at the same place at all times. Where none does, vertices are points. Prims whose
//! `purpose` is `guide` or `proxy` are left out, as renderers leave them. Subdivision is not done: the cage is
//! the mesh. Materials are looked for in the layer itself; a `GeomSubset` with one of
//! its own is a part.
//!
//! Composition (references, payloads, sublayers, inherits, specializes, clips) and UsdSkel are evaluated by
//! usd-core into a plain layer with the samples that the options ask for, which is then read as any other.

mod between;
mod cameras;
mod looks;
mod mesh;
mod polygons;
mod primvar;
mod sources;
mod stage;
mod subsets;
mod vertices;

use std::path::Path;

use glam::Vec3;
use usd_core::{BakeOptions, UsdCore};
use usd_layer::{Layer, ReadError, Value};

use crate::budget::Budget;
use crate::error::Fault;
use crate::loaded::{Loaded, Motion, Source};
use crate::shape::{Look, Shape};
use crate::{Animation, AnimationChoice, MeshOptions, Pose};
pub(crate) use cameras::{UsdCamera, read_camera};
use mesh::Mesh;
pub(crate) use sources::sources;
use stage::{Found, Place};

/// Metres a unit has in a stage that does not say.
const METERS_PER_UNIT: f64 = 0.01;

/// Time codes a second has in a stage that does not say.
const TIME_CODES_PER_SECOND: f64 = 24.0;

/// Points and corners of all meshes together, for each byte of the file: a crate holds equal arrays once, and any
/// number of prims may share them.
const ELEMENTS_PER_BYTE: usize = 4;

/// The meshes of a layer, with its bytes.
#[derive(Debug)]
pub(crate) struct Film {
    layer: Layer<Vec<u8>>,
    meshes: Vec<Mesh>,
    time_codes_per_second: f64,
}

pub(crate) fn read(path: &Path, options: &MeshOptions) -> Result<Loaded, Fault> {
    let layer = open(path)?;
    let found = Found::search(&layer);
    if !found.composed && !found.skinned {
        return film(layer, found, |layer, place, subset| looks::at_place(layer, place, subset, path));
    }
    let folder = tempfile::tempdir().map_err(|source| Fault::Io { path: std::env::temp_dir(), source })?;
    let baked = folder.path().join("baked.usdc");
    let number = |name| positive(&layer, name);
    let rate = number("timeCodesPerSecond").or_else(|| number("framesPerSecond"));
    let bake = bake_options(options, rate.unwrap_or(TIME_CODES_PER_SECOND), start(&layer));
    UsdCore::find().and_then(|usd| usd.bake(path, &baked, bake)).map_err(Fault::UsdCore)?;
    let plain = open(&baked)?;
    let found = Found::search(&plain);
    film(plain, found, |_, place, subset| looks::at_place(&layer, place, subset, path))
}

fn open(path: &Path) -> Result<Layer<Vec<u8>>, Fault> {
    let bytes = std::fs::read(path).map_err(|source| Fault::Io { path: path.to_owned(), source })?;
    Layer::read(bytes).map_err(|ReadError { place, found, expected }| {
        Fault::invalid(place.to_string(), format!("found {found}, expected {expected}"))
    })
}

/// Frames are time codes unless another rate is given.
fn bake_options(options: &MeshOptions, time_codes_per_second: f64, start: f64) -> BakeOptions {
    let time_codes = time_codes_per_second / options.frame_rate.unwrap_or(time_codes_per_second);
    let moves = options.animation != AnimationChoice::None;
    let frames = options.frames.map(|(first, last)| (first * time_codes, last * time_codes));
    // A mesh that stays as it is needs one time.
    let still = (!moves).then_some((start, start));
    BakeOptions {
        step: options.step.map(|step| step * time_codes),
        frames: still.or(frames),
        hold: options.rest.time().filter(|_| moves).map(|seconds| seconds * time_codes_per_second),
        transforms: true,
    }
}

fn start<B>(layer: &Layer<B>) -> f64 {
    layer
        .metadata("startTimeCode")
        .and_then(Value::number)
        .filter(|time| time.is_finite())
        .unwrap_or_default()
}

fn positive<B>(layer: &Layer<B>, name: &str) -> Option<f64> {
    layer.metadata(name).and_then(Value::number).filter(|number| number.is_finite() && *number > 0.0)
}

/// The meshes that were found; `look` gives the look of the prim at a place.
fn film(
    layer: Layer<Vec<u8>>,
    found: Found,
    look: impl Fn(&Layer<Vec<u8>>, &Place, Option<&str>) -> Look,
) -> Result<Loaded, Fault> {
    if found.meshes.is_empty() {
        return Err(Fault::invalid(
            "/",
            "no Mesh prim, expected at least one that is defined, active and not a guide",
        ));
    }
    let mut budget = Budget::new(layer.bytes().len(), ELEMENTS_PER_BYTE);
    let (mut shape, mut meshes, mut times) = (Shape::default(), Vec::new(), Vec::new());
    for place in found.meshes {
        let path = place.path.clone();
        let mesh = Mesh::read(&layer, place).map_err(|fault| fault.below(&path))?;
        budget.take(mesh.elements(), &path)?;
        let name = path.rsplit('/').next().unwrap_or_default();
        let parts = mesh.parts.iter().map(|(subset, triangles)| {
            let name = subset.as_ref().map_or_else(|| name.to_owned(), |subset| format!("{name}/{subset}"));
            (name, triangles.clone(), look(&layer, &mesh.place, subset.as_deref()))
        });
        shape.append_parts(mesh.corners.len(), &mesh.triangles, mesh.uvs.as_deref(), parts.collect())?;
        times.extend(mesh.times(&layer));
        meshes.push(mesh);
    }
    let rate = positive(&layer, "timeCodesPerSecond").or_else(|| positive(&layer, "framesPerSecond"));
    let rate = rate.unwrap_or(TIME_CODES_PER_SECOND);
    let first = times.iter().copied().fold(f64::INFINITY, f64::min) / rate;
    let last = times.iter().copied().fold(f64::NEG_INFINITY, f64::max) / rate;
    let moves = last > first && first.is_finite() && last.is_finite();
    let animation = Animation { name: String::new(), start: first, end: last };
    let motion = Motion {
        animations: if moves { vec![animation] } else { Vec::new() },
        time_range: moves.then_some((first, last)),
        frame_rate: Some(rate),
        is_z_up: layer.metadata("upAxis").and_then(Value::text) == Some("Z"),
        meters_per_unit: positive(&layer, "metersPerUnit").unwrap_or(METERS_PER_UNIT),
    };
    let film = Film { layer, meshes, time_codes_per_second: rate };
    Ok(Loaded { shape, motion, source: Source::Usd(Box::new(film)) })
}

impl Film {
    /// The pose at a time in seconds, or without one.
    pub(crate) fn pose_into(&self, time: Option<f64>, pose: &mut Pose) -> Result<(), Fault> {
        pose.positions.clear();
        let has_normals = self.meshes.iter().all(Mesh::has_normals);
        pose.normals = has_normals.then(|| pose.normals.take().map_or_else(Vec::new, emptied));
        let time = time.map(|seconds| seconds * self.time_codes_per_second);
        for mesh in &self.meshes {
            let Pose { positions, normals } = pose;
            mesh.pose(&self.layer, time, positions, normals.as_mut())
                .map_err(|fault| fault.below(&mesh.place.path))?;
        }
        Ok(())
    }
}

fn emptied(mut normals: Vec<Vec3>) -> Vec<Vec3> {
    normals.clear();
    normals
}
