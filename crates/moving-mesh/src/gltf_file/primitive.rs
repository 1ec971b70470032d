//! The vertices of one primitive, in its mesh's own space.

use glam::{DVec3, Vec2, Vec3};
use gltf::accessor::Dimensions;
use gltf::mesh::Mode;
use gltf::{Accessor, Primitive, Semantic};
use gltf_bytes::{Buffers, Elements};

use crate::budget::Budget;
use crate::error::Fault;

/// What a primitive of triangles holds.
pub(super) struct Geometry {
    pub(super) positions: Vec<DVec3>,
    pub(super) normals: Option<Vec<Vec3>>,
    pub(super) uvs: Option<Vec<Vec2>>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) targets: Vec<MorphTarget>,
}

/// What a morph target moves; vertices that it leaves alone are not held.
#[derive(Clone, Debug, Default)]
pub(super) struct MorphTarget {
    pub(super) positions: Vec<(u32, Vec3)>,
    pub(super) normals: Vec<(u32, Vec3)>,
}

impl Geometry {
    /// `None` for points and lines; `uv_set` is the set of texture coordinates that is wanted.
    pub(super) fn read(
        primitive: &Primitive<'_>,
        uv_set: u32,
        buffers: &Buffers<'_>,
        budget: &mut Budget,
        place: &str,
    ) -> Result<Option<Geometry>, Fault> {
        if !matches!(primitive.mode(), Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
            return Ok(None);
        }
        let Some(accessor) = primitive.get(&Semantic::Positions) else {
            return Err(Fault::invalid(place, "no POSITION, expected one"));
        };
        let positions = Elements::of(&accessor, &[Dimensions::Vec3], buffers)?.all(DVec3::from_array);
        let count = positions.len();
        if let Some(i) = positions.iter().position(|p| !p.is_finite()) {
            let fault = format!("position {} is not finite, expected numbers", positions[i]);
            return Err(Fault::invalid(format!("{place} vertex {i}"), fault));
        }
        let normals =
            primitive.get(&Semantic::Normals).map(|accessor| triples(&accessor, buffers)).transpose()?;
        let uvs = primitive
            .get(&Semantic::TexCoords(uv_set))
            .map(|accessor| uvs(&accessor, buffers))
            .transpose()?;
        let indices = match primitive.indices() {
            Some(accessor) => Elements::of(&accessor, &[Dimensions::Scalar], buffers)?.indices()?,
            None => (0..count as u32).collect(),
        };
        let corners = if primitive.mode() == Mode::Triangles { 1 } else { 3 };
        budget.take(indices.len().saturating_mul(corners).saturating_add(count), place)?;
        let mut targets = Vec::new();
        for target in primitive.morph_targets() {
            let deltas = |accessor: Option<Accessor<'_>>| deltas(accessor, count, buffers, place);
            let target = MorphTarget {
                positions: deltas(target.positions())?,
                normals: deltas(target.normals().filter(|_| normals.is_some()))?,
            };
            budget.take(target.positions.len().saturating_add(target.normals.len()), place)?;
            targets.push(target);
        }
        Ok(Some(Geometry {
            // Values that are not one a vertex belong to no vertex.
            normals: normals.filter(|normals| normals.len() == count),
            uvs: uvs.filter(|uvs| uvs.len() == count),
            triangles: triangles(&indices, primitive.mode()),
            positions,
            targets,
        }))
    }
}

fn triples(accessor: &Accessor<'_>, buffers: &Buffers<'_>) -> Result<Vec<Vec3>, Fault> {
    Ok(Elements::of(accessor, &[Dimensions::Vec3], buffers)?.all(|v| DVec3::from_array(v).as_vec3()))
}

/// glTF's v goes down.
fn uvs(accessor: &Accessor<'_>, buffers: &Buffers<'_>) -> Result<Vec<Vec2>, Fault> {
    let elements = Elements::of(accessor, &[Dimensions::Vec2], buffers)?;
    Ok(elements.all(|[u, v]: [f64; 2]| Vec2::new(u as f32, (1.0 - v) as f32)))
}

fn deltas(
    accessor: Option<Accessor<'_>>,
    vertices: usize,
    buffers: &Buffers<'_>,
    place: &str,
) -> Result<Vec<(u32, Vec3)>, Fault> {
    let Some(accessor) = accessor else { return Ok(Vec::new()) };
    let deltas = triples(&accessor, buffers)?;
    if deltas.len() != vertices {
        let fault = format!("a morph target has {} vertices, expected {vertices}", deltas.len());
        return Err(Fault::invalid(place, fault));
    }
    if let Some(i) = deltas.iter().position(|delta| !delta.is_finite()) {
        let fault = format!("a morph target moves vertex {i} by {}, expected numbers", deltas[i]);
        return Err(Fault::invalid(place, fault));
    }
    Ok((0..).zip(deltas).filter(|(_, delta)| *delta != Vec3::ZERO).collect())
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
