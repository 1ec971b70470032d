//! The triangles of a scene as it stands before any animation.

use glam::{DMat4, DVec3, Vec3};
use gltf::accessor::Dimensions;
use gltf::mesh::Mode;
use gltf::{Accessor, Mesh, Primitive, Semantic, Skin};
use gltf_bytes::{Asset, Buffers, Elements};

use crate::TriangleMesh;
use crate::error::Fault;

/// All triangles of the default scene (else the first, else all nodes) in world space.
pub(crate) fn mesh(asset: &Asset<'_>) -> Result<TriangleMesh, Fault> {
    let Asset { document, buffers } = asset;
    let worlds = gltf_bytes::placements(document)?;
    let mut all = TriangleMesh::default();
    for node in document.nodes() {
        let (Some(world), Some(mesh)) = (worlds[node.index()], node.mesh()) else { continue };
        let weights = node.weights().or_else(|| mesh.weights()).unwrap_or_default();
        // A skinned mesh is placed by its joints alone (glTF 2.0, section 3.7.3.3).
        let joints = node.skin().map(|skin| joint_matrices(&skin, &worlds, buffers)).transpose()?;
        for primitive in mesh.primitives() {
            let place = format!("meshes[{}].primitives[{}]", mesh.index(), primitive.index());
            if let Some(part) = Part::read(&mesh, &primitive, weights, buffers, &place)? {
                all.append(part.posed(world, joints.as_deref(), &primitive, buffers, &place)?)?;
            }
        }
    }
    Ok(all)
}

fn joint_matrices(
    skin: &Skin<'_>,
    worlds: &[Option<DMat4>],
    buffers: &Buffers<'_>,
) -> Result<Vec<DMat4>, Fault> {
    let inverse_bind = match skin.inverse_bind_matrices() {
        Some(accessor) => Elements::of(&accessor, &[Dimensions::Mat4], buffers)?
            .all(|columns: [f64; 16]| DMat4::from_cols_array(&columns)),
        None => Vec::new(),
    };
    let place = |i| format!("skins[{}].joints[{i}]", skin.index());
    let mut matrices = Vec::new();
    for (i, joint) in skin.joints().enumerate() {
        let Some(world) = worlds[joint.index()] else {
            return Err(Fault::invalid(place(i), format!("node {} is outside the scene", joint.index())));
        };
        let bind = match inverse_bind.get(i) {
            Some(bind) => *bind,
            None if inverse_bind.is_empty() => DMat4::IDENTITY,
            None => return Err(Fault::invalid(place(i), "no inverse bind matrix for this joint")),
        };
        matrices.push(world * bind);
    }
    Ok(matrices)
}

/// One primitive in its mesh's own space, morph weights applied.
struct Part {
    positions: Vec<DVec3>,
    normals: Option<Vec<DVec3>>,
    triangles: Vec<[u32; 3]>,
}

impl Part {
    /// `None` for points and lines.
    fn read(
        mesh: &Mesh<'_>,
        primitive: &Primitive<'_>,
        weights: &[f32],
        buffers: &Buffers<'_>,
        place: &str,
    ) -> Result<Option<Part>, Fault> {
        if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            return Ok(None);
        }
        let Some(accessor) = primitive.get(&Semantic::Positions) else {
            return Err(Fault::invalid(
                format!("meshes[{}]", mesh.index()),
                format!("{place} has no POSITION"),
            ));
        };
        let mut positions = triples(&accessor, buffers)?;
        let mut normals = primitive.get(&Semantic::Normals).map(|a| triples(&a, buffers)).transpose()?;
        for (target, &weight) in primitive.morph_targets().zip(weights).filter(|&(_, &w)| w != 0.0) {
            add_weighted(&mut positions, target.positions(), weight, buffers, place)?;
            if let Some(normals) = &mut normals {
                add_weighted(normals, target.normals(), weight, buffers, place)?;
            }
        }
        let indices = match primitive.indices() {
            Some(accessor) => Elements::of(&accessor, &[Dimensions::Scalar], buffers)?.indices()?,
            None => (0..positions.len() as u32).collect::<Vec<u32>>(),
        };
        let normals = normals.filter(|n| n.len() == positions.len());
        Ok(Some(Part { positions, normals, triangles: triangles(&indices, primitive.mode()) }))
    }

    fn posed(
        self,
        world: DMat4,
        joints: Option<&[DMat4]>,
        primitive: &Primitive<'_>,
        buffers: &Buffers<'_>,
        place: &str,
    ) -> Result<TriangleMesh, Fault> {
        let matrices = match joints {
            Some(joints) => skinning(joints, primitive, self.positions.len(), buffers, place)?,
            None => vec![world],
        };
        let matrix = |vertex: usize| &matrices[if matrices.len() == 1 { 0 } else { vertex }];
        let point = |(i, p): (usize, &DVec3)| matrix(i).transform_point3(*p).as_vec3();
        let normal = |(i, n): (usize, &DVec3)| {
            let m = glam::DMat3::from_mat4(*matrix(i)).inverse().transpose();
            (m * *n).normalize_or_zero().as_vec3()
        };
        let positions: Vec<Vec3> = self.positions.iter().enumerate().map(point).collect();
        let normals = self.normals.as_ref().map(|normals| normals.iter().enumerate().map(normal).collect());
        Ok(TriangleMesh { positions, normals, triangles: self.triangles })
    }
}

/// One matrix a vertex: joints blended by weights over all `JOINTS_n` / `WEIGHTS_n` sets.
fn skinning(
    joints: &[DMat4],
    primitive: &Primitive<'_>,
    vertices: usize,
    buffers: &Buffers<'_>,
    place: &str,
) -> Result<Vec<DMat4>, Fault> {
    let mut blended = vec![DMat4::ZERO; vertices];
    let mut sums = vec![0.0; vertices];
    for set in 0.. {
        let pair = (primitive.get(&Semantic::Joints(set)), primitive.get(&Semantic::Weights(set)));
        let (Some(indices), Some(weights)) = pair else { break };
        let indices = quadruples(&indices, buffers)?;
        let weights = quadruples(&weights, buffers)?;
        if indices.len() != vertices || weights.len() != vertices {
            return Err(Fault::invalid(
                place,
                format!("JOINTS_{set} and WEIGHTS_{set} do not have one entry a vertex"),
            ));
        }
        let entries = indices.iter().flatten().zip(weights.iter().flatten());
        for (i, (&joint, &weight)) in entries.enumerate().filter(|(_, (_, w))| **w != 0.0) {
            let Some(matrix) = joints.get(joint as usize) else {
                let fault = format!("joint {joint} of vertex {}, expected below {}", i / 4, joints.len());
                return Err(Fault::invalid(format!("{place}.JOINTS_{set}"), fault));
            };
            blended[i / 4] += *matrix * weight;
            sums[i / 4] += weight;
        }
    }
    for (i, (matrix, sum)) in blended.iter_mut().zip(sums).enumerate() {
        if sum <= 0.0 {
            return Err(Fault::invalid(place, format!("vertex {i} has no skin weight")));
        }
        // Weights should sum to 1; quantised ones miss it by a little.
        *matrix *= 1.0 / sum;
    }
    Ok(blended)
}

fn triples(accessor: &Accessor<'_>, buffers: &Buffers<'_>) -> Result<Vec<DVec3>, Fault> {
    Ok(Elements::of(accessor, &[Dimensions::Vec3], buffers)?.all(DVec3::from_array))
}

fn quadruples(accessor: &Accessor<'_>, buffers: &Buffers<'_>) -> Result<Vec<[f64; 4]>, Fault> {
    Ok(Elements::of(accessor, &[Dimensions::Vec4], buffers)?.all(|v| v))
}

fn add_weighted(
    to: &mut [DVec3],
    deltas: Option<Accessor<'_>>,
    weight: f32,
    buffers: &Buffers<'_>,
    place: &str,
) -> Result<(), Fault> {
    let Some(deltas) = deltas else { return Ok(()) };
    let deltas = triples(&deltas, buffers)?;
    if deltas.len() != to.len() {
        let fault = format!("a morph target has {} vertices, expected {}", deltas.len(), to.len());
        return Err(Fault::invalid(place, fault));
    }
    for (value, delta) in to.iter_mut().zip(deltas) {
        *value += delta * f64::from(weight);
    }
    Ok(())
}

fn triangles(indices: &[u32], mode: Mode) -> Vec<[u32; 3]> {
    match mode {
        Mode::TriangleStrip => indices
            .windows(3)
            .enumerate()
            .map(|(i, t)| if i % 2 == 0 { [t[0], t[1], t[2]] } else { [t[1], t[0], t[2]] })
            .collect(),
        Mode::TriangleFan => {
            let Some((&hub, rim)) = indices.split_first() else { return Vec::new() };
            rim.windows(2).map(|t| [hub, t[0], t[1]]).collect()
        }
        _ => indices.as_chunks::<3>().0.to_vec(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_and_fans_keep_their_winding() {
        assert_eq!(triangles(&[0, 1, 2, 3], Mode::TriangleStrip), [[0, 1, 2], [2, 1, 3]]);
        assert_eq!(triangles(&[0, 1, 2, 3], Mode::TriangleFan), [[0, 1, 2], [0, 2, 3]]);
        assert_eq!(triangles(&[0, 1, 2, 3], Mode::Triangles), [[0, 1, 2]]);
        assert!(triangles(&[], Mode::TriangleFan).is_empty());
    }
}
