//! Cameras of a scene, on their nodes (glTF 2.0, section 3.10).

use std::path::Path;

use gltf::Document;
use gltf::json;
use gltf_bytes::Asset;

use super::nodes::Nodes;
use super::{ELEMENTS_PER_BYTE, listed, rate};
use crate::budget::Budget;
use crate::camera_file::{self, Read, Track};
use crate::error::Fault;
use crate::{AnimationChoice, CameraOptions, CameraPose};

/// A camera and the nodes that carry it.
#[derive(Debug)]
pub(crate) struct GltfCamera {
    nodes: Nodes,
    slot: usize,
    time_range: Option<(f64, f64)>,
    frame_rate: Option<f64>,
    vertical_fov: f64,
    aspect: Option<f64>,
}

/// A node of the scene that bears a camera.
struct Bearer {
    name: String,
    own_name: Option<String>,
    slot: usize,
    camera: usize,
}

pub(crate) fn read_camera(path: &Path, options: &CameraOptions) -> Result<Read, Fault> {
    let bytes = std::fs::read(path).map_err(|source| Fault::Io { path: path.to_owned(), source })?;
    let asset = Asset::open(&bytes, path.parent())?;
    let mut nodes = Nodes::read(&asset.document)?;
    let bearers = bearers(&asset.document, &nodes);
    let names: Vec<String> = bearers.iter().map(|bearer| bearer.name.clone()).collect();
    let chosen = options.camera.among(&names, |index| bearers.get(index)?.own_name.clone())?;
    let Some(&Bearer { slot, camera, .. }) = bearers.get(chosen) else {
        return Err(Fault::NoCamera { asked: String::new(), known: "none".to_owned() });
    };
    let (vertical_fov, aspect) = lens(&asset.document, camera)?;
    let (mut time_range, mut frame_rate) = (None, None);
    if let Some(animation) = animation(&asset, &options.animation, &nodes, slot)? {
        let length = bytes.len().saturating_add(asset.buffers.total());
        nodes.animate(&animation, &asset.buffers, &mut Budget::new(length, ELEMENTS_PER_BYTE))?;
        let ends = listed(&animation, &asset)?;
        time_range = carries(&animation, &nodes, slot).then_some((ends.start, ends.end));
        frame_rate = rate(&animation, &asset)?;
    }
    let camera = GltfCamera { nodes, slot, time_range, frame_rate, vertical_fov, aspect };
    Ok(Read { names, chosen, track: Track::Gltf(Box::new(camera)) })
}

fn bearers(document: &Document, nodes: &Nodes) -> Vec<Bearer> {
    let mut bearers = Vec::new();
    for node in document.nodes() {
        let (Some(slot), Some(camera)) = (nodes.slot(node.index()), node.camera()) else { continue };
        let own_name = camera.name().map(str::to_owned);
        let name = node.name().map(str::to_owned).or_else(|| own_name.clone());
        let name = name.unwrap_or_else(|| format!("nodes[{}]", node.index()));
        bearers.push(Bearer { name, own_name, slot, camera: camera.index() });
    }
    bearers
}

/// The animation that is meant: by name or number, or the first that carries the camera.
fn animation<'a>(
    asset: &'a Asset<'_>,
    choice: &AnimationChoice,
    nodes: &Nodes,
    slot: usize,
) -> Result<Option<gltf::Animation<'a>>, Fault> {
    if *choice == AnimationChoice::First {
        return Ok(asset.document.animations().find(|animation| carries(animation, nodes, slot)));
    }
    let all = asset.document.animations().map(|a| listed(&a, asset)).collect::<Result<Vec<_>, _>>()?;
    Ok(choice.among(&all)?.and_then(|index| asset.document.animations().nth(index)))
}

/// Whether a channel moves the node or one above it.
fn carries(animation: &gltf::Animation<'_>, nodes: &Nodes, slot: usize) -> bool {
    let chain: Vec<usize> = std::iter::successors(Some(slot), |&slot| nodes.parent(slot)).collect();
    let is_above = |node: usize| nodes.slot(node).is_some_and(|slot| chain.contains(&slot));
    animation.channels().any(|channel| is_above(channel.target().node().index()))
}

/// Vertical field of view and aspect. `gltf` itself trusts that a camera has what its type names.
fn lens(document: &Document, camera: usize) -> Result<(f64, Option<f64>), Fault> {
    let place = format!("cameras[{camera}]");
    let Some(json) = document.as_json().cameras.get(camera) else {
        return Err(Fault::invalid(place, "no camera, expected one"));
    };
    let json::validation::Checked::Valid(kind) = json.type_ else {
        return Err(Fault::invalid(place, "another type, expected perspective or orthographic"));
    };
    match (kind, &json.perspective) {
        (json::camera::Type::Orthographic, _) => Err(Fault::Unsupported {
            what: format!("the orthographic camera {place}"),
            remedy: "use a perspective one, far away for nearly parallel rays",
        }),
        (json::camera::Type::Perspective, None) => {
            Err(Fault::invalid(place, "no `perspective`, expected one in a camera of that type"))
        }
        (json::camera::Type::Perspective, Some(lens)) => {
            let aspect = lens.aspect_ratio.map(f64::from).filter(|aspect| *aspect > 0.0);
            Ok((f64::from(lens.yfov), aspect))
        }
    }
}

impl GltfCamera {
    pub(crate) fn time_range(&self) -> Option<(f64, f64)> {
        self.time_range
    }

    pub(crate) fn frame_rate(&self) -> Option<f64> {
        self.frame_rate
    }

    pub(crate) fn at(&self, time: f64) -> Result<CameraPose, Fault> {
        let mut worlds = Vec::new();
        self.nodes.worlds(self.time_range.map(|_| time), &mut Vec::new(), &mut worlds);
        let world = worlds.get(self.slot).copied().unwrap_or_default();
        camera_file::pose(world, self.vertical_fov, self.aspect)
    }
}
