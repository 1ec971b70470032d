//! One prim of curves.

use glam::{DMat4, Vec3};
use groom::Values;
use usd_layer::{Attribute, Prim, Value};

use super::stage::{Place, Stage};
use super::values::{self, Fault};
use crate::FormatError;
use crate::cubic::Basis;
use crate::polylines::{Polylines, Shape, Wrap};

/// The curves of a prim at a time.
pub(super) struct Curves<'s, B> {
    pub(super) stage: &'s Stage<B>,
    pub(super) prim: &'s Prim,
    pub(super) path: &'s str,
    pub(super) time: Option<f64>,
    pub(super) polylines: Polylines,
    pub(super) control_points: usize,
    /// To the stage's space; `None` where it is the prim's own.
    pub(super) world_from_prim: Option<DMat4>,
}

impl<'s, B: AsRef<[u8]>> Curves<'s, B> {
    /// The curves and the points of their strands; `like` is how they were cut at another time, which must
    /// fit.
    pub(super) fn read(
        stage: &'s Stage<B>,
        place: &'s Place,
        time: Option<f64>,
        like: Option<&Polylines>,
    ) -> Result<(Self, Vec<Vec3>), FormatError> {
        let error = |fault: Fault| fault.into_error(&stage.context.file, &place.path);
        let Some(prim) = stage.chain(place).last() else {
            return Err(FormatError::invalid(&stage.context.file, &*place.path, "no prim", "one"));
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
        let counts = shape
            .check(&counts.flatten().unwrap_or_default(), points.len())
            .map_err(|(found, expected)| error(Fault::value("curveVertexCounts", found, expected)))?;
        let polylines = match like {
            Some(like) if like.counts == counts => like.clone(),
            Some(like) => {
                let found = format!(
                    "{} curves of {} points at time {}",
                    counts.len(),
                    points.len(),
                    time.unwrap_or_default()
                );
                let expected = format!(
                    "{} curves with as many points as at the first time: frames of a groom have the same strands",
                    like.counts.len()
                );
                return Err(error(Fault::value("curveVertexCounts", found, expected)));
            }
            None => Polylines::cut(shape, counts, &points, stage.context.curve_error),
        };
        let world = stage.world_from_prim(place, time)?;
        let world_from_prim = (world != DMat4::IDENTITY).then_some(world);
        let control_points = points.len();
        let curves =
            Curves { stage, prim, path: &place.path, time, polylines, control_points, world_from_prim };
        curves.refuse_too_many()?;
        curves.take("points", control_points, size_of::<Vec3>())?;
        curves.take_sampled(
            "points",
            control_points,
            curves.polylines.points() as usize,
            size_of::<Vec3>(),
        )?;
        let mut points = curves.polylines.per_point(points);
        if let Some(world) = curves.world_from_prim {
            points.iter_mut().for_each(|point| *point = world.transform_point3(point.as_dvec3()).as_vec3());
        }
        Ok((curves, points))
    }

    /// Takes room for what sampling adds to `control` values. What the user asks for by an error of his own is
    /// given: a span still has a bounded number of parts.
    pub(super) fn take_sampled(
        &self,
        attribute: &str,
        control: usize,
        sampled: usize,
        size: usize,
    ) -> Result<(), FormatError> {
        match self.stage.context.curve_error {
            Some(_) => Ok(()),
            None => self.take(attribute, sampled.saturating_sub(control), size),
        }
    }

    /// Refuses, before they are made, more points than a groom can count.
    fn refuse_too_many(&self) -> Result<(), FormatError> {
        let (found, limit) = (self.polylines.points(), u64::from(u32::MAX));
        if found <= limit {
            return Ok(());
        }
        let found = format!("lines of {found} points");
        let expected = format!("{limit} at most; a larger curve error makes fewer");
        Err(self.error(Fault::value("points", found, expected)))
    }

    /// Takes room for an attribute of the groom.
    pub(super) fn take(&self, attribute: &str, count: usize, size: usize) -> Result<(), FormatError> {
        let taken = self.stage.context.room.take(count, size);
        taken.map_err(|(found, expected)| self.error(Fault::value(attribute, found, expected)))
    }

    /// A value that is wrong.
    pub(super) fn error(&self, fault: Fault) -> FormatError {
        fault.into_error(&self.stage.context.file, self.path)
    }
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
