//! Values on the faces, points or corners of a mesh.

use usd_layer::{Attribute, Layer, Prim, Value};

use super::stage::fault_of;
use crate::error::Fault;

/// What a primvar has a value for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Interpolation {
    Constant,
    Uniform,
    Vertex,
    FaceVarying,
}

/// A place on a mesh: one corner of a face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    pub(super) corner: u32,
    pub(super) point: u32,
    pub(super) face: u32,
}

/// How many faces, points and corners a mesh has.
#[derive(Clone, Copy, Debug)]
pub(super) struct Counts {
    pub(super) faces: usize,
    pub(super) points: usize,
    pub(super) corners: usize,
}

/// How an attribute's values are spread over a mesh.
#[derive(Clone, Debug)]
pub(super) struct Spread {
    pub(super) interpolation: Interpolation,
    indices: Option<Vec<i32>>,
    expected: usize,
}

impl Spread {
    /// That of `attribute`, which `prim` may hold indices for; `fallback` is meant where nothing is said.
    pub(super) fn of<B: AsRef<[u8]>>(
        layer: &Layer<B>,
        prim: &Prim,
        attribute: &Attribute,
        fallback: &str,
        counts: Counts,
    ) -> Result<Option<Spread>, Fault> {
        let (interpolation, expected) = match attribute.interpolation().unwrap_or(fallback) {
            "constant" => (Interpolation::Constant, 1),
            "uniform" => (Interpolation::Uniform, counts.faces),
            "vertex" | "varying" => (Interpolation::Vertex, counts.points),
            "faceVarying" => (Interpolation::FaceVarying, counts.corners),
            _ => return Ok(None),
        };
        let indices = prim.attribute(&format!("{}:indices", attribute.name));
        let indices = indices.and_then(|indices| indices.held(None).map(|value| (indices, value)));
        let indices = indices
            .map(|(of, value)| layer.numbers::<i32>(value).map_err(|e| fault_of(&of.name, e)))
            .transpose()?;
        Ok(Some(Spread { interpolation, indices, expected }))
    }

    /// One value a face, point or corner; `None` when their number is another, as no renderer then uses them.
    pub(super) fn values<B: AsRef<[u8]>, const N: usize>(
        &self,
        layer: &Layer<B>,
        name: &str,
        value: &Value,
    ) -> Result<Option<Vec<[f32; N]>>, Fault> {
        let values: Vec<[f32; N]> = layer.values(value).map_err(|e| fault_of(name, e))?;
        let values = match &self.indices {
            None => values,
            Some(indices) => {
                let look_up = |&index: &i32| usize::try_from(index).ok().and_then(|i| values.get(i)).copied();
                let found: Option<Vec<[f32; N]>> = indices.iter().map(look_up).collect();
                found.ok_or_else(|| {
                    let fault = format!("an index out of range, expected below {}", values.len());
                    Fault::invalid(format!("{name}:indices"), fault)
                })?
            }
        };
        Ok((values.len() == self.expected).then_some(values))
    }

    /// Which of the values belongs to a corner.
    pub(super) fn place(&self, at: Corner) -> usize {
        match self.interpolation {
            Interpolation::Constant => 0,
            Interpolation::Uniform => at.face as usize,
            Interpolation::Vertex => at.point as usize,
            Interpolation::FaceVarying => at.corner as usize,
        }
    }

    /// Whether corners that meet in a point may have different values.
    pub(super) fn is_by_corner(&self) -> bool {
        matches!(self.interpolation, Interpolation::Uniform | Interpolation::FaceVarying)
    }
}

/// An attribute spread over a mesh, and its values at the first time.
#[derive(Clone, Debug)]
pub(super) struct Primvar<const N: usize> {
    pub(super) name: String,
    pub(super) spread: Spread,
    values: Vec<[f32; N]>,
}

impl<const N: usize> Primvar<N> {
    /// `None` where `attribute` has no value, or one that does not fit the mesh.
    pub(super) fn read<B: AsRef<[u8]>>(
        layer: &Layer<B>,
        prim: &Prim,
        attribute: &Attribute,
        fallback: &str,
        counts: Counts,
    ) -> Result<Option<Self>, Fault> {
        let Some(value) = attribute.held(None) else { return Ok(None) };
        let Some(spread) = Spread::of(layer, prim, attribute, fallback, counts)? else { return Ok(None) };
        let values = spread.values(layer, &attribute.name, value)?;
        Ok(values.map(|values| Primvar { name: attribute.name.to_string(), spread, values }))
    }

    pub(super) fn at(&self, corner: Corner) -> [f32; N] {
        self.values[self.spread.place(corner)]
    }
}
