//! The stage: the layer's metadata, the Xform, the curves, their material.

use glam::DVec3;
use groom::{UpAxis, names};
use usd_layer::write::WriteError;

use crate::usd::write::array::{Array, Rows, Shape};
use crate::usd::write::curves::Curves;
use crate::usd::write::primvars::{Primvar, widths};
use crate::usd::write::sink::{Content, Declaration, Head, Single, Sink};
use crate::usd::write::skeleton::Skeleton;
use crate::usd::write::{extent, material};
use crate::{Dialect, Look};

/// Frames a second of a still groom: a still has no time samples, and this is the usual rate of film.
const STILL_RATE: f64 = 24.0;

/// What is written.
pub(super) struct Stage<'a> {
    pub curves: &'a Curves<'a>,
    pub primvars: &'a [Primvar<'a>],
    pub dialect: Option<Dialect>,
    pub look: Option<&'a Look>,
    /// Where the points are measured from.
    pub origin: DVec3,
    /// The joints that move the points.
    pub skeleton: Option<&'a Skeleton>,
}

/// What changes over time, put aside with the sink.
pub(super) struct Samples<S> {
    pub frame_rate: f64,
    /// Time codes of the first and the last frame.
    pub range: (f64, f64),
    pub points: Vec<(f64, S)>,
    pub extents: Vec<(f64, S)>,
    /// Empty when the frames have none.
    pub velocities: Vec<(f64, S)>,
    /// Likewise.
    pub accelerations: Vec<(f64, S)>,
}

impl Stage<'_> {
    /// Says all of it to `sink`.
    pub fn write<S: Sink>(
        &self,
        sink: &mut S,
        samples: Option<&Samples<S::Stored>>,
    ) -> Result<(), WriteError> {
        self.layer(sink, samples)?;
        let is_unreal = self.dialect == Some(Dialect::Unreal);
        let apis: &[&str] = if is_unreal { &["GroomAPI"] } else { &[] };
        let type_name = if self.skeleton.is_some() { "SkelRoot" } else { "Xform" };
        sink.begin(&Head { name: "Groom", type_name, apis, is_component: true })?;
        if let Some(skeleton) = self.skeleton {
            skeleton.root(sink, 0.5 * extent::largest(&widths(self.curves)))?;
        }
        let mut apis = Vec::new();
        apis.extend(self.look.map(|_| "MaterialBindingAPI"));
        apis.extend(self.skeleton.map(|_| "SkelBindingAPI"));
        sink.begin(&Head { name: "Strands", type_name: "BasisCurves", apis: &apis, is_component: false })?;
        self.strands(sink, samples)?;
        if let Some(skeleton) = self.skeleton {
            skeleton.binding(sink, self.curves)?;
        }
        if self.look.is_some() {
            sink.relationship("material:binding", material::PATH)?;
        }
        sink.end()?;
        if let Some(skeleton) = self.skeleton {
            skeleton.write(sink)?;
        }
        if let Some(look) = self.look {
            material::write(sink, look, self.curves.groom.colors().is_some())?;
        }
        sink.end()
    }

    fn layer<S: Sink>(&self, sink: &mut S, samples: Option<&Samples<S::Stored>>) -> Result<(), WriteError> {
        let groom = self.curves.groom;
        let moving = samples.map(|samples| (samples.frame_rate, samples.range));
        let moving = moving.or(self.skeleton.map(|skeleton| (skeleton.frame_rate, skeleton.range())));
        let rate = moving.map_or(STILL_RATE, |(rate, _)| rate);
        let up = match groom.up_axis {
            UpAxis::Y => "Y",
            UpAxis::Z => "Z",
        };
        let doc = concat!("Written by groomkit ", env!("CARGO_PKG_VERSION"));
        let mut metadata = vec![("defaultPrim", Single::Token("Groom")), ("doc", Single::Text(doc))];
        if let Some((_, (_, end))) = moving {
            metadata.push(("endTimeCode", Single::Double(end)));
            metadata.push(("framesPerSecond", Single::Double(rate)));
        }
        metadata.push(("metersPerUnit", Single::Double(groom.meters_per_unit)));
        if let Some((_, (start, _))) = moving {
            metadata.push(("startTimeCode", Single::Double(start)));
        }
        metadata.push(("timeCodesPerSecond", Single::Double(rate)));
        metadata.push(("upAxis", Single::Token(up)));
        sink.layer(&metadata)
    }

    fn strands<S: Sink>(&self, sink: &mut S, samples: Option<&Samples<S::Stored>>) -> Result<(), WriteError> {
        place(sink, self.origin)?;
        let curves = self.curves;
        let token = |word| Content::Single(Single::Token(word));
        let kind = if curves.phantoms { "cubic" } else { "linear" };
        sink.attribute(Declaration::uniform("token", "type"), token(kind))?;
        sink.attribute(Declaration::uniform("token", "basis"), token("catmullRom"))?;
        sink.attribute(Declaration::uniform("token", "wrap"), token("nonperiodic"))?;
        let counts = Array { curves, rows: Rows::Ints(&curves.counts), shape: Shape::FIXED };
        sink.attribute(Declaration::new("int[]", "curveVertexCounts"), Content::Array(&counts))?;

        let points = positions(curves);
        let moving = samples.map(|samples| &samples.points[..]);
        sink.attribute(Declaration::new("point3f[]", "points"), still_or(&points, moving))?;
        self.derivatives(sink, samples)?;
        let widths = widths(curves);
        let per_vertex =
            Declaration { interpolation: Some("vertex"), ..Declaration::new("float[]", "widths") };
        sink.attribute(per_vertex, Content::Array(&widths))?;
        let corners = extent::of(&points, &widths);
        let extent = Array { curves, rows: Rows::Float3s(&corners), shape: Shape::FIXED };
        let moving = samples.map(|samples| &samples.extents[..]);
        sink.attribute(Declaration::new("float3[]", "extent"), still_or(&extent, moving))?;

        for Primvar { name, type_name, array } in self.primvars {
            let interpolation = Some(array.interpolation());
            let declaration = Declaration { interpolation, ..Declaration::new(type_name, name) };
            sink.attribute(declaration, Content::Array(array))?;
        }
        Ok(())
    }

    /// Velocities and accelerations: those of the frames, or the still groom's own velocities.
    fn derivatives<S: Sink>(
        &self,
        sink: &mut S,
        samples: Option<&Samples<S::Stored>>,
    ) -> Result<(), WriteError> {
        let Some(samples) = samples else {
            let still = velocities(self.curves).filter(|_| self.skeleton.is_none());
            let Some(velocities) = still else { return Ok(()) };
            return sink.attribute(Declaration::new("vector3f[]", "velocities"), Content::Array(&velocities));
        };
        for (name, values) in [("velocities", &samples.velocities), ("accelerations", &samples.accelerations)]
        {
            if !values.is_empty() {
                sink.attribute(Declaration::new("vector3f[]", name), Content::Samples(values))?;
            }
        }
        Ok(())
    }
}

/// Puts the prim that is open at a place.
pub(super) fn place<S: Sink>(sink: &mut S, origin: DVec3) -> Result<(), WriteError> {
    if origin == DVec3::ZERO {
        return Ok(());
    }
    let translation = Content::Single(Single::Double3(origin.to_array()));
    sink.attribute(Declaration::new("double3", "xformOp:translate"), translation)?;
    let order = Content::Single(Single::Tokens(&["xformOp:translate"]));
    sink.attribute(Declaration::uniform("token[]", "xformOpOrder"), order)
}

fn still_or<'a, S>(still: &'a Array<'a>, samples: Option<&'a [(f64, S)]>) -> Content<'a, S> {
    samples.map_or(Content::Array(still), Content::Samples)
}

/// The groom's own positions.
pub(super) fn positions<'a>(curves: &'a Curves<'a>) -> Array<'a> {
    let rows = Rows::Float3s(bytemuck::cast_slice(curves.groom.positions()));
    Array { curves, rows, shape: Shape::points() }
}

/// The groom's own velocities, one a point whatever they belong to.
fn velocities<'a>(curves: &'a Curves<'a>) -> Option<Array<'a>> {
    let attribute = curves.groom.attribute(names::VELOCITY)?;
    let shape = Shape { from: attribute.domain, ..Shape::points() };
    Some(Array { curves, rows: Rows::from(&attribute.values), shape })
}
