//! glTF 2.0, its bytes checked by `gltf-bytes`.

mod cameras;
mod curve;
mod frame_rate;
mod materials;
mod nodes;
mod primitive;
mod rig;
mod skins;

use std::path::Path;

use glam::{DAffine3, DVec3, Vec3};
use gltf::{Node, Semantic};
use gltf_bytes::{Asset, GltfError};

use crate::budget::Budget;
use crate::error::Fault;
use crate::loaded::{Loaded, Motion, Source};
use crate::shape::Shape;
use crate::{Animation, MeshOptions};
pub(crate) use cameras::{GltfCamera, read_camera};
use curve::Curve;
use materials::Materials;
use nodes::Nodes;
use primitive::Geometry;
use rig::Piece;
pub(crate) use rig::Rig;
use skins::Skins;

/// Vertices, corners and keys for each byte of the file and its buffers: nodes may share a mesh.
const ELEMENTS_PER_BYTE: usize = 32;

/// Reads the default scene (else the first, else all nodes).
pub(crate) fn read(path: &Path, options: &MeshOptions) -> Result<Loaded, Fault> {
    let bytes = std::fs::read(path).map_err(|source| Fault::Io { path: path.to_owned(), source })?;
    let asset = Asset::open(&bytes, path.parent())?;
    let length = bytes.len().saturating_add(asset.buffers.total());
    let mut scene = Scene::new(&asset, Budget::new(length, ELEMENTS_PER_BYTE))?;
    let animations =
        asset.document.animations().map(|a| listed(&a, &asset)).collect::<Result<Vec<_>, _>>()?;
    let chosen = options.animation.among(&animations)?;
    let animation = chosen.and_then(|index| asset.document.animations().nth(index));
    if let Some(animation) = &animation {
        scene.weights = scene.nodes.animate(animation, &asset.buffers, &mut scene.budget)?;
    }
    let frame_rate = animation.map(|animation| rate(&animation, &asset)).transpose()?.flatten();
    let mut materials = Materials::new(&asset, path);
    for node in asset.document.nodes() {
        scene.add(&node, &mut materials)?;
    }
    Ok(Loaded {
        shape: scene.shape,
        motion: Motion {
            time_range: chosen.and_then(|index| animations.get(index)).map(|a| (a.start, a.end)),
            animations,
            frame_rate,
            is_z_up: false,
            meters_per_unit: 1.0,
        },
        source: Source::Gltf(Box::new(Rig {
            nodes: scene.nodes,
            pieces: scene.pieces,
            weights: scene.weights.into_iter().map(|(_, curve)| curve).collect(),
            positions: scene.positions,
            normals: scene.normals,
            skeleton: scene.skeleton,
            joint_slots: scene.skins.slots,
            rooms: Default::default(),
        })),
    })
}

/// A scene while it is being read.
struct Scene<'a> {
    asset: &'a Asset<'a>,
    budget: Budget,
    nodes: Nodes,
    weights: Vec<(usize, Curve)>,
    skins: Skins,
    shape: Shape,
    pieces: Vec<Piece>,
    positions: Vec<DVec3>,
    normals: Option<Vec<Vec3>>,
    skeleton: crate::Skeleton,
    /// `world_from_node` of every slot before any animation.
    worlds: Vec<glam::DMat4>,
}

impl<'a> Scene<'a> {
    fn new(asset: &'a Asset<'a>, budget: Budget) -> Result<Self, Fault> {
        let nodes = Nodes::read(&asset.document)?;
        let mut worlds = Vec::with_capacity(nodes.len());
        nodes.worlds(None, &mut Vec::new(), &mut worlds);
        let mut skins = Skins::of(&asset.document);
        for node in asset.document.nodes().filter(|node| nodes.slot(node.index()).is_some()) {
            if let (Some(skin), Some(_)) = (node.skin(), node.mesh()) {
                skins.add(&skin, &nodes, &asset.buffers)?;
            }
        }
        let skeleton = crate::Skeleton::new(std::mem::take(&mut skins.joints));
        let (shape, normals) = (Shape::default(), Some(Vec::new()));
        let (weights, pieces, positions) = (Vec::new(), Vec::new(), Vec::new());
        Ok(Scene {
            asset,
            budget,
            nodes,
            weights,
            skins,
            shape,
            pieces,
            positions,
            normals,
            skeleton,
            worlds,
        })
    }

    /// Adds the triangles of a node's mesh.
    fn add(&mut self, node: &Node<'_>, materials: &mut Materials<'_>) -> Result<(), Fault> {
        let (Some(slot), Some(mesh)) = (self.nodes.slot(node.index()), node.mesh()) else { return Ok(()) };
        let weights: Vec<f64> = node
            .weights()
            .or_else(|| mesh.weights())
            .unwrap_or_default()
            .iter()
            .map(|&weight| f64::from(weight))
            .collect();
        let curve = self.weights.iter().position(|(of, _)| *of == node.index());
        for primitive in mesh.primitives() {
            let place = format!("meshes[{}].primitives[{}]", mesh.index(), primitive.index());
            let buffers = &self.asset.buffers;
            let (look, uv_set) = materials.look(&primitive);
            let geometry = Geometry::read(&primitive, uv_set, buffers, &mut self.budget, &place)?;
            let Some(mut geometry) = geometry else { continue };
            let count = geometry.positions.len();
            // The skin is what counts where a node has both (glTF 2.0, section 3.7.3.3).
            match node.skin() {
                Some(skin) => {
                    let is_set = |(semantic, _): &(Semantic, _)| matches!(semantic, Semantic::Joints(_));
                    let sets = primitive.attributes().filter(is_set).count();
                    self.budget.take(count.saturating_mul(4).saturating_mul(sets), &place)?;
                    let skeleton = &mut self.skeleton;
                    let push = |influences: &mut Vec<(u32, f64)>| skeleton.push(influences);
                    self.skins.influences(&skin, &primitive, count, buffers, &place, push)?;
                }
                None => {
                    self.skeleton.skip(count);
                    self.face_outwards(slot, &mut geometry);
                }
            }
            let name = mesh.name().or_else(|| node.name()).map_or(place, str::to_owned);
            self.shape.append(name, count, &geometry.triangles, geometry.uvs.as_deref(), look)?;
            self.pieces.push(Piece {
                vertices: self.positions.len()..self.positions.len() + count,
                slot,
                skinned: node.skin().is_some(),
                default_weights: (0..geometry.targets.len())
                    .map(|target| weights.get(target).copied().unwrap_or_default())
                    .collect(),
                targets: geometry.targets,
                curve,
            });
            self.positions.extend(geometry.positions);
            self.normals = self.normals.take().zip(geometry.normals).map(|(mut all, more)| {
                all.extend(more);
                all
            });
        }
        Ok(())
    }

    /// Triangles of a node that mirrors are wound the other way round (glTF 2.0, section 3.7.4).
    fn face_outwards(&self, slot: usize, geometry: &mut Geometry) {
        let mirrors = self
            .worlds
            .get(slot)
            .is_some_and(|world| DAffine3::from_mat4(*world).matrix3.determinant() < 0.0);
        if mirrors {
            geometry.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
        }
    }
}

fn listed(animation: &gltf::Animation<'_>, asset: &Asset<'_>) -> Result<Animation, Fault> {
    let times = key_times(animation, asset)?;
    let (start, end) = times
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(start, end), &time| (time.min(start), time.max(end)));
    let (start, end) = if times.is_empty() { (0.0, 0.0) } else { (start, end) };
    Ok(Animation { name: animation.name().unwrap_or_default().to_owned(), start, end })
}

fn rate(animation: &gltf::Animation<'_>, asset: &Asset<'_>) -> Result<Option<f64>, Fault> {
    Ok(frame_rate::of_keys(key_times(animation, asset)?.into_iter()))
}

/// Times of all keys of an animation, in no order.
fn key_times(animation: &gltf::Animation<'_>, asset: &Asset<'_>) -> Result<Vec<f64>, Fault> {
    let mut seen = std::collections::BTreeSet::new();
    let mut times = Vec::new();
    for sampler in animation.samplers() {
        // Most samplers have their times in common.
        if seen.insert(sampler.input().index()) {
            let place = format!("animations[{}].samplers[{}]", animation.index(), sampler.index());
            times.extend(curve::times(&sampler, &asset.buffers, &place)?);
        }
    }
    Ok(times)
}

impl From<GltfError> for Fault {
    fn from(error: GltfError) -> Self {
        match error {
            GltfError::Invalid { place, found, expected } => {
                Fault::invalid(place, format!("{found}, expected {expected}"))
            }
            GltfError::Unsupported { what, remedy } => Fault::Unsupported { what, remedy },
            GltfError::Io { path, source } => Fault::Io { path, source },
            other => Fault::invalid("glTF", other.to_string()),
        }
    }
}
