//! A Mesh prim: its triangles, and which of its points and corners each vertex is.

use glam::{DMat3, DMat4, DVec3, Vec2, Vec3};
use usd_layer::{Attribute, Layer, Prim, Value, xform};

use super::between::{Between, Vectors};
use super::polygons::Fans;
use super::primvar::{Corner, Counts, Primvar, Spread};
use super::stage::{Place, fault_of};
use super::subsets::{self, Run};
use super::vertices;
use crate::error::Fault;
use crate::normals::{cofactors, turn};
use crate::recent::Recent;

/// A mesh of a stage.
#[derive(Debug)]
pub(super) struct Mesh {
    pub(super) place: Place,
    /// The corner that each vertex stands for. Where the corners of a point have different texture coordinates
    /// or normals, there is a vertex for each; their positions are the same number.
    pub(super) corners: Vec<Corner>,
    pub(super) triangles: Vec<[u32; 3]>,
    /// Triangles of one material: the prim that binds it to some faces, if it is not the mesh itself.
    pub(super) parts: Vec<Run>,
    pub(super) uvs: Option<Vec<Vec2>>,
    counts: Counts,
    normals: Option<(String, Spread)>,
    /// `world_from_prim` where nothing on the way to it moves.
    still_world: Option<DMat4>,
    points_read: Recent<Vectors>,
    normals_read: Recent<Vectors>,
}

impl Mesh {
    pub(super) fn read<B: AsRef<[u8]>>(layer: &Layer<B>, place: Place) -> Result<Mesh, Fault> {
        let chain = place.chain(layer);
        let prim = *chain.last().ok_or_else(|| Fault::invalid(&place.path, "no prim, expected one"))?;
        let integers = |name: &str| whole(layer, prim, name);
        let (counts, indices) = (integers("faceVertexCounts")?, integers("faceVertexIndices")?);
        let points = prim.attribute("points").and_then(|points| points.held(None));
        let points = points.map(|value| vectors(layer, "points", value)).transpose()?.unwrap_or_default();
        let numbers = Counts { faces: counts.len(), points: points.len(), corners: indices.len() };
        if let Some(i) = indices.iter().position(|&i| usize::try_from(i).map_or(true, |i| i >= points.len()))
        {
            let fault =
                format!("index {} at {i}, expected 0 to below the {} points", indices[i], points.len());
            return Err(Fault::invalid("faceVertexIndices", fault));
        }
        let orientation =
            prim.attribute("orientation").and_then(|orientation| orientation.held(None)?.text());
        let world = world(layer, &chain, None)?;
        // The hand that orientation means is that of the prim's own space.
        let clockwise = (orientation == Some("leftHanded")) != (world.determinant() < 0.0);
        let mut fans = Fans::cut(&counts, indices.len(), &integers("holeIndices")?, clockwise)?;
        let parts = subsets::part(layer, prim, &mut fans)?;
        let corner = |corner: usize| Corner {
            corner: corner as u32,
            point: indices[corner] as u32,
            face: fans.corner_faces[corner],
        };
        let corners: Vec<Corner> = (0..indices.len()).map(corner).collect();
        let uvs = uvs(layer, prim, numbers)?;
        let normals = normals(layer, prim, numbers)?;
        let split = uvs.as_ref().is_some_and(|uvs| uvs.spread.is_by_corner())
            || normals.as_ref().is_some_and(|normals| normals.spread.is_by_corner());
        let (vertices, triangles) = if split {
            vertices::apart(&corners, &fans.triangles, |at| {
                let uv = uvs.as_ref().map(|uvs| uvs.at(*at)).unwrap_or_default();
                let normal = normals.as_ref().map(|normals| normals.at(*at)).unwrap_or_default();
                (at.point, uv.map(f32::to_bits), normal.map(f32::to_bits))
            })
        } else {
            vertices::points(points.len(), &corners, &fans.triangles)
        };
        let uvs = uvs.map(|uvs| vertices.iter().map(|at| Vec2::from(uvs.at(*at))).collect());
        let moves = chain.iter().any(|prim| xform::moving_attributes(prim).next().is_some());
        Ok(Mesh {
            corners: vertices,
            triangles,
            parts,
            uvs,
            counts: numbers,
            normals: normals.map(|normals| (normals.name, normals.spread)),
            still_world: (!moves).then_some(world),
            points_read: Recent::default(),
            normals_read: Recent::default(),
            place,
        })
    }

    /// What it takes from the budget of a file.
    pub(super) fn elements(&self) -> usize {
        self.counts.points.saturating_add(self.counts.corners)
    }

    pub(super) fn has_normals(&self) -> bool {
        self.normals.is_some()
    }

    /// Times of all samples that move the mesh, in no order.
    pub(super) fn times<B>(&self, layer: &Layer<B>) -> Vec<f64> {
        let chain = self.place.chain(layer);
        let prim = chain.last();
        let named = |name: &str| prim.and_then(|prim| prim.attribute(name));
        let own = [named("points"), self.normals.as_ref().and_then(|(name, _)| named(name))];
        let ops = chain.iter().flat_map(|prim| xform::moving_attributes(prim));
        let samples =
            own.into_iter().flatten().chain(ops).filter_map(|attribute| attribute.samples.as_deref());
        samples.flat_map(|samples| samples.times.iter().copied()).collect()
    }

    /// Positions and normals of the vertices at a time code, added to `positions` and `normals`.
    pub(super) fn pose<B: AsRef<[u8]>>(
        &self,
        layer: &Layer<B>,
        time: Option<f64>,
        positions: &mut Vec<DVec3>,
        normals: Option<&mut Vec<Vec3>>,
    ) -> Result<(), Fault> {
        let chain = self.place.chain(layer);
        let Some(prim) = chain.last() else { return Ok(()) };
        let world = match self.still_world {
            Some(world) => world,
            None => self::world(layer, &chain, time)?,
        };
        if let Some(points) = prim.attribute("points") {
            let read = |value: &Value, name: &str| {
                let points = vectors(layer, name, value)?;
                if points.len() == self.counts.points {
                    return Ok(points);
                }
                let fault =
                    format!("{} points, expected the {} of the first", points.len(), self.counts.points);
                Err(Fault::invalid(name, fault))
            };
            let points = Between::of(points, time, &self.points_read, read)?;
            let point = |at: &Corner| world.transform_point3(points.at(at.point as usize));
            positions.extend(self.corners.iter().map(point));
        }
        if let (Some(to), Some((name, spread))) = (normals, &self.normals)
            && let Some(attribute) = prim.attribute(name)
        {
            let read = |value: &Value, name: &str| {
                let normals = spread.values(layer, name, value)?;
                normals.ok_or_else(|| Fault::invalid(name, "another number of normals than the first"))
            };
            let normals = Between::of(attribute, time, &self.normals_read, read)?;
            let cofactors = cofactors(&DMat3::from_mat4(world));
            to.extend(self.corners.iter().map(|at| {
                let mut normal = normals.at(spread.place(*at)).as_vec3();
                turn(&cofactors, &mut normal);
                normal
            }));
        }
        Ok(())
    }
}

/// From the space of the last prim of a chain to the stage's.
pub(super) fn world<B: AsRef<[u8]>>(
    layer: &Layer<B>,
    chain: &[&Prim],
    time: Option<f64>,
) -> Result<DMat4, Fault> {
    let mut world = DMat4::IDENTITY;
    for prim in chain {
        let local = xform::parent_from_prim(layer, prim, time);
        let (local, resets) = local.map_err(|error| {
            Fault::invalid(error.attribute, format!("found {}, expected {}", error.found, error.expected))
        })?;
        world = if resets { local } else { world * local };
    }
    Ok(world)
}

/// Whole numbers that must not change.
fn whole<B: AsRef<[u8]>>(layer: &Layer<B>, prim: &Prim, name: &str) -> Result<Vec<i32>, Fault> {
    let Some(attribute) = prim.attribute(name) else { return Ok(Vec::new()) };
    let read = |value: &Value| layer.numbers::<i32>(value).map_err(|error| fault_of(name, error));
    let first = attribute.held(None).map(read).transpose()?.unwrap_or_default();
    for (time, value) in attribute.samples.iter().flat_map(|s| s.times.iter().zip(&s.values)) {
        if read(value)? != first {
            let fault = "the mesh is another from here on, expected the same triangles at all times";
            return Err(Fault::invalid(format!("{name} at time code {time}"), fault));
        }
    }
    Ok(first)
}

fn vectors<B: AsRef<[u8]>>(layer: &Layer<B>, name: &str, value: &Value) -> Result<Vectors, Fault> {
    layer.values(value).map_err(|error| fault_of(name, error))
}

/// `primvars:st`, else the first primvar of texture coordinates.
fn uvs<B: AsRef<[u8]>>(layer: &Layer<B>, prim: &Prim, counts: Counts) -> Result<Option<Primvar<2>>, Fault> {
    let coordinates =
        |a: &&Attribute| a.name.starts_with("primvars:") && a.type_name.starts_with("texCoord2");
    let st = prim.attribute("primvars:st").or_else(|| prim.attributes.iter().find(coordinates));
    st.map_or(Ok(None), |st| Primvar::read(layer, prim, st, "constant", counts))
}

/// `primvars:normals`, else `normals`.
fn normals<B: AsRef<[u8]>>(
    layer: &Layer<B>,
    prim: &Prim,
    counts: Counts,
) -> Result<Option<Primvar<3>>, Fault> {
    for (name, fallback) in [("primvars:normals", "constant"), ("normals", "vertex")] {
        if let Some(attribute) = prim.attribute(name).filter(|attribute| attribute.has_value()) {
            return Primvar::read(layer, prim, attribute, fallback, counts);
        }
    }
    Ok(None)
}
