//! One prim of curves.

use glam::{DMat4, Vec3};
use groom::Values;
use usd_layer::{Attribute, Prim, Value};

use super::cubic::{self, Basis, Point};
use super::stage::{Place, Stage};
use super::topology::{Sampling, Shape, Wrap};
use super::values::{self, Fault};
use crate::FormatError;

/// The curves of a prim at a time.
pub(super) struct Curves<'s, B> {
    pub(super) stage: &'s Stage<'s, B>,
    pub(super) prim: &'s Prim,
    pub(super) path: &'s str,
    pub(super) time: Option<f64>,
    pub(super) shape: Shape,
    pub(super) sampling: Sampling,
    pub(super) control_points: usize,
    /// To the stage's space; `None` where it is the prim's own.
    pub(super) world_from_prim: Option<DMat4>,
}

impl<'s, B: AsRef<[u8]>> Curves<'s, B> {
    /// The curves and the points of their strands; `sampling` is that of another time, which must fit.
    pub(super) fn read(
        stage: &'s Stage<'s, B>,
        place: &'s Place,
        time: Option<f64>,
        sampling: Option<&Sampling>,
    ) -> Result<(Self, Vec<Vec3>), FormatError> {
        let error = |fault: Fault| fault.into_error(stage.context.file, &place.path);
        let Some(prim) = stage.chain(place).last() else {
            return Err(FormatError::invalid(stage.context.file, &*place.path, "no prim", "one"));
        };
        let points = match prim.attribute("points").map(|points| values::at(&stage.layer, points, time)) {
            Some(points) => match points.map_err(error)? {
                Some(Values::Vec3(points)) => points,
                None => Vec::new(),
                Some(_) => return Err(error(Fault::value("points", "values of another type", "point3f[]"))),
            },
            None => Vec::new(),
        };
        let counts = prim.attribute("curveVertexCounts");
        let counts =
            counts.map(|counts| values::integers(&stage.layer, counts, time)).transpose().map_err(error)?;
        let shape = shape_of(prim, time).map_err(error)?;
        let counts = shape.check(&counts.flatten().unwrap_or_default(), points.len()).map_err(error)?;
        let sampling = match sampling {
            Some(sampling) if sampling.counts == counts => sampling.clone(),
            Some(sampling) => {
                let found = format!(
                    "{} curves of {} points at time {}",
                    counts.len(),
                    points.len(),
                    time.unwrap_or_default()
                );
                let expected = format!(
                    "{} curves with as many points as at the first time: frames of a groom have the same strands",
                    sampling.counts.len()
                );
                return Err(error(Fault::value("curveVertexCounts", found, expected)));
            }
            None => {
                let mut sampling = Sampling { counts, parts: Vec::new() };
                if let Some(basis) = shape.basis {
                    for curve in each(&points, &sampling.counts) {
                        cubic::cut(curve, basis, shape, stage.context.curve_error, &mut sampling.parts);
                    }
                }
                sampling
            }
        };
        let world = stage.world_from_prim(place, time)?;
        let world_from_prim = (world != DMat4::IDENTITY).then_some(world);
        let control_points = points.len();
        let curves =
            Curves { stage, prim, path: &place.path, time, shape, sampling, control_points, world_from_prim };
        let mut points = curves.per_point(points);
        if let Some(world) = curves.world_from_prim {
            points.iter_mut().for_each(|point| *point = world.transform_point3(point.as_dvec3()).as_vec3());
        }
        Ok((curves, points))
    }

    /// Points of every strand that is not empty.
    pub(super) fn strand_lens(&self) -> impl Iterator<Item = u32> + '_ {
        let mut parts = self.sampling.parts.iter();
        self.sampling.counts.iter().filter(|&&count| count > 0).map(move |&count| {
            let spans = self.shape.spans(count).unwrap_or_default();
            match self.shape.basis {
                Some(_) => parts.by_ref().take(spans as usize).map(|&part| u32::from(part)).sum::<u32>() + 1,
                None => spans + 1,
            }
        })
    }

    /// Values of interpolation `vertex`, one a control point, at the points of the strands.
    pub(super) fn per_point<P: Point>(&self, values: Vec<P>) -> Vec<P> {
        let wrap = self.shape.wrap;
        let Some(basis) = self.shape.basis else {
            return if wrap == Wrap::Periodic { self.closed(&values) } else { values };
        };
        let mut out = Vec::new();
        for (curve, parts) in each(&values, &self.sampling.counts).zip(self.parts()) {
            cubic::sample(curve, basis, wrap, parts, &mut out);
        }
        out
    }

    /// Values of interpolation `varying`, one an end of a span, at the points of the strands; `None` if there
    /// are not as many.
    pub(super) fn per_span_end<P: Point>(&self, values: Vec<P>) -> Option<Vec<P>> {
        let counts: Vec<u32> = self.sampling.counts.iter().map(|&count| self.shape.varying(count)).collect();
        if counts.iter().map(|&count| u64::from(count)).sum::<u64>() != values.len() as u64 {
            return None;
        }
        if self.shape.basis.is_none() {
            return Some(if self.shape.wrap == Wrap::Periodic { self.closed(&values) } else { values });
        }
        let mut out = Vec::new();
        for (curve, parts) in each(&values, &counts).zip(self.parts()) {
            cubic::sample_varying(curve, self.shape.wrap, parts, &mut out);
        }
        Some(out)
    }

    /// Every curve with its first value again at its end.
    fn closed<P: Point>(&self, values: &[P]) -> Vec<P> {
        each(values, &self.sampling.counts)
            .flat_map(|curve| curve.iter().chain(curve.first()).copied())
            .collect()
    }

    /// The parts of the spans of every curve.
    fn parts(&self) -> impl Iterator<Item = &[u16]> {
        let mut rest = &self.sampling.parts[..];
        self.sampling.counts.iter().map(move |&count| {
            let spans = self.shape.spans(count).unwrap_or_default() as usize;
            let (parts, after) = rest.split_at_checked(spans).unwrap_or_default();
            rest = after;
            parts
        })
    }

    /// A value that is wrong.
    pub(super) fn error(&self, fault: Fault) -> FormatError {
        fault.into_error(self.stage.context.file, self.path)
    }
}

/// The values of every curve.
fn each<'v, P>(values: &'v [P], counts: &'v [u32]) -> impl Iterator<Item = &'v [P]> {
    let mut rest = values;
    counts.iter().map(move |&count| {
        let (curve, after) = rest.split_at_checked(count as usize).unwrap_or_default();
        rest = after;
        curve
    })
}

fn shape_of(prim: &Prim, time: Option<f64>) -> Result<Shape, Fault> {
    let token = |name: &str, fallback: &'static str| {
        let value =
            prim.attribute(name).and_then(|attribute: &Attribute| attribute.held(time)).and_then(Value::text);
        value.unwrap_or(fallback).to_owned()
    };
    let wrap = match &*token("wrap", "nonperiodic") {
        "nonperiodic" => Wrap::Nonperiodic,
        "periodic" => Wrap::Periodic,
        "pinned" => Wrap::Pinned,
        other => return Err(Fault::value("wrap", format!("`{other}`"), "nonperiodic, periodic or pinned")),
    };
    let basis = match &*token("type", "cubic") {
        "linear" => None,
        "cubic" => match &*token("basis", "bezier") {
            "bezier" => Some(Basis::Bezier),
            "bspline" => Some(Basis::Bspline),
            "catmullRom" => Some(Basis::CatmullRom),
            other => {
                return Err(Fault::value("basis", format!("`{other}`"), "bezier, bspline or catmullRom"));
            }
        },
        other => return Err(Fault::value("type", format!("`{other}`"), "linear or cubic")),
    };
    Ok(Shape { basis, wrap })
}
