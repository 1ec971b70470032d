//! OBJ files one a frame.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec2, Vec3};
use tobj::Model;

use super::{frames, load, materials, triangles, triples};
use crate::error::Fault;
use crate::loaded::{Loaded, Motion, Source};
use crate::recent::Recent;
use crate::shape::Shape;
use crate::{Animation, MeshOptions, Pose};

/// Frames a second where nothing is said.
const FRAME_RATE: f64 = 24.0;

/// Frames that are read when they are wanted.
///
/// Exporters number normals anew in every file, so vertices are told apart by position and texture coordinate
/// alone, those of the first frame; a vertex has the mean of the normals at its corners.
#[derive(Debug)]
pub(crate) struct Sequence {
    frames: Vec<(u32, PathBuf)>,
    frame_rate: f64,
    /// Indices of positions of the first frame, model by model.
    faces: Vec<Vec<u32>>,
    /// Positions of each model of the first frame.
    points: Vec<usize>,
    /// Model and position of each vertex.
    vertices: Vec<(usize, u32)>,
    /// Vertex of each corner, model by model.
    corners: Vec<Vec<u32>>,
    recent: Recent<Pose>,
}

pub(super) fn read(pattern: &Path, options: &MeshOptions) -> Result<Loaded, Fault> {
    let frames = frames::find(pattern)?;
    let frame_rate = options.frame_rate.unwrap_or(FRAME_RATE);
    let Some((_, first)) = frames.first() else { return Err(Fault::invalid("name", "no files")) };
    let in_first = |fault: Fault| Fault::Told(Box::new(fault.in_file(first)));
    let (models, materials) = load(first, false).map_err(in_first)?;
    let mut shape = Shape::default();
    let mut sequence = Sequence {
        frame_rate,
        faces: Vec::new(),
        points: Vec::new(),
        vertices: Vec::new(),
        corners: Vec::new(),
        recent: Recent::default(),
        frames: Vec::new(),
    };
    for model in &models {
        sequence.add(model, materials::look(model, &materials, first), &mut shape).map_err(in_first)?;
    }
    let range = frames.first().zip(frames.last());
    let range = range.map(|(a, b)| (f64::from(a.0) / frame_rate, f64::from(b.0) / frame_rate));
    let range = range.filter(|(start, end)| end > start);
    sequence.frames = frames;
    Ok(Loaded {
        shape,
        motion: Motion {
            animations: range
                .map(|(start, end)| Animation { name: String::new(), start, end })
                .into_iter()
                .collect(),
            time_range: range,
            frame_rate: Some(frame_rate),
            ..Motion::default()
        },
        source: Source::Sequence(Box::new(sequence)),
    })
}

impl Sequence {
    /// Takes in a model of the first frame.
    fn add(&mut self, model: &Model, look: crate::shape::Look, shape: &mut Shape) -> Result<(), Fault> {
        let mesh = &model.mesh;
        let points = triples(model, "positions", &mesh.positions)?.len();
        let (coordinates, _) = mesh.texcoords.as_chunks::<2>();
        let has_uvs = mesh.texcoord_indices.len() == mesh.indices.len() && !coordinates.is_empty();
        let (number, first) = (self.points.len(), self.vertices.len());
        let mut known = HashMap::new();
        let (mut corners, mut uvs) = (Vec::with_capacity(mesh.indices.len()), Vec::new());
        for (corner, &point) in mesh.indices.iter().enumerate() {
            let uv = if has_uvs { mesh.texcoord_indices[corner] } else { 0 };
            corners.push(*known.entry((point, uv)).or_insert_with(|| {
                self.vertices.push((number, point));
                let uv = coordinates.get(uv as usize).copied().unwrap_or_default();
                uvs.push(Vec2::from(uv));
                (self.vertices.len() - first - 1) as u32
            }));
        }
        triangles(model)?;
        let uvs = has_uvs.then_some(uvs.as_slice());
        let count = self.vertices.len() - first;
        shape.append(model.name.clone(), count, corners.as_chunks::<3>().0, uvs, look)?;
        self.faces.push(mesh.indices.clone());
        self.points.push(points);
        self.corners.push(corners.iter().map(|&vertex| first as u32 + vertex).collect());
        Ok(())
    }

    /// The pose at a time in seconds, or of the first frame.
    pub(crate) fn pose_into(&self, time: Option<f64>, pose: &mut Pose) -> Result<(), Fault> {
        let frame = time.map_or(f64::NEG_INFINITY, |time| time * self.frame_rate);
        let after = self.frames.partition_point(|(number, _)| f64::from(*number) <= frame);
        let before = after.saturating_sub(1);
        let number = |place: usize| self.frames.get(place).map(|(number, _)| f64::from(*number));
        let part = match (number(before), number(after)) {
            (Some(start), Some(end)) if frame > start => (frame - start) / (end - start),
            _ => 0.0,
        };
        let start = self.frame(before)?;
        if part == 0.0 {
            pose.positions.clone_from(&start.positions);
            pose.normals.clone_from(&start.normals);
            return Ok(());
        }
        let end = self.frame(after)?;
        pose.positions.clear();
        let pairs = start.positions.iter().zip(&end.positions);
        pose.positions.extend(pairs.map(|(a, b)| *a + (*b - *a) * part));
        let mut normals = pose.normals.take().unwrap_or_default();
        normals.clear();
        pose.normals = start.normals.as_ref().zip(end.normals.as_ref()).map(|(start, end)| {
            normals.extend(start.iter().zip(end).map(|(a, b)| a.lerp(*b, part as f32).normalize_or_zero()));
            normals
        });
        Ok(())
    }

    fn frame(&self, place: usize) -> Result<std::sync::Arc<Pose>, Fault> {
        let Some((number, path)) = self.frames.get(place) else {
            return Err(Fault::invalid("frames", "none, expected one"));
        };
        self.recent.get(place, || {
            self.load(path).map_err(|fault| {
                let fault = fault.below(&format!("frame {number}"));
                Fault::Told(Box::new(fault.in_file(path)))
            })
        })
    }

    fn load(&self, path: &Path) -> Result<Pose, Fault> {
        let (models, _) = load(path, false)?;
        let first = self.frames.first().map_or(0, |(number, _)| *number);
        if models.len() != self.faces.len() {
            let fault = format!(
                "{} objects with faces, expected the {} of frame {first}",
                models.len(),
                self.faces.len()
            );
            return Err(Fault::invalid("topology", fault));
        }
        for (model, (faces, points)) in models.iter().zip(self.faces.iter().zip(&self.points)) {
            let (triangles, expected) = (model.mesh.indices.len() / 3, faces.len() / 3);
            let place = format!("object `{}`", model.name);
            if triangles != expected {
                let fault = format!("{triangles} triangles, expected the {expected} of frame {first}");
                return Err(Fault::invalid(place, fault));
            }
            if let Some(corner) = model.mesh.indices.iter().zip(faces).position(|(a, b)| a != b) {
                let fault = format!("triangle {} joins other points than in frame {first}", corner / 3);
                return Err(Fault::invalid(place, fault));
            }
            let found = triples(model, "positions", &model.mesh.positions)?.len();
            if found != *points {
                return Err(Fault::invalid(
                    place,
                    format!("{found} points, expected the {points} of frame {first}"),
                ));
            }
        }
        let position = |&(model, point): &(usize, u32)| {
            let points = models[model].mesh.positions.as_chunks::<3>().0;
            DVec3::from_array(points[point as usize].map(f64::from))
        };
        Ok(Pose {
            positions: self.vertices.iter().map(position).collect(),
            normals: self.mean_normals(&models),
        })
    }

    /// `None` unless every corner has one.
    fn mean_normals(&self, models: &[Model]) -> Option<Vec<Vec3>> {
        let mut sums = vec![Vec3::ZERO; self.vertices.len()];
        for (model, corners) in models.iter().zip(&self.corners) {
            let (normals, _) = model.mesh.normals.as_chunks::<3>();
            if model.mesh.normal_indices.len() != corners.len() {
                return None;
            }
            for (&normal, &vertex) in model.mesh.normal_indices.iter().zip(corners) {
                sums[vertex as usize] += Vec3::from(*normals.get(normal as usize)?).normalize_or_zero();
            }
        }
        Some(sums.into_iter().map(Vec3::normalize_or_zero).collect())
    }
}
