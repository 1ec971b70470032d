//! The strands of one groom as the render loop needs them: where a hit is, what it scatters like.

use fibre_material::Varying;
use fibre_scattering::{Absorption, HairParameters, ScatteringError};
use glam::{DVec3, Vec3};
use groom::{Attribute, Groom, UpAxis, Values, names};
use strand_tracing::{Hit, HitKind, Primitive};

use crate::fibre_hit::FibrePoint;
use crate::models::Models;
use crate::{HairMaterial, RenderError, TableUse, Transparency};

/// The material of a groom's fibres, looked up by hit.
#[derive(Debug)]
pub(crate) struct Fibres {
    models: Models,
    absorption: Varying<Absorption>,
    transparency: Option<Varying<f32>>,
    fixed_offset: Option<f32>,
    /// Whether the medulla absorbs as the cortex does.
    medulla_as_cortex: bool,
    /// Roughness around the fibre, of the material as a whole.
    beta_n: f32,
    /// For each strand, roughly where the larger axis of its cross-section points; empty for round fibres.
    major_axes: Vec<Vec3>,
    /// Only kept where something varies by vertex.
    offsets: Vec<u32>,
    /// Strands and points of the groom.
    counts: (usize, usize),
}

impl Fibres {
    pub fn new(object: usize, groom: &Groom, material: &HairMaterial) -> Result<Self, RenderError> {
        if let Some(h) = material.fixed_offset.filter(|h| !(-1.0..=1.0).contains(h)) {
            return Err(RenderError::argument("fixed offset", h, "-1..1 fibre radii"));
        }
        let dressed =
            material.fibre.dress(groom).map_err(|source| RenderError::Material { object, source })?;
        let models = Models::new(object, &dressed)?;
        let transparency = match material.transparency {
            Transparency::Ignored => None,
            Transparency::Stochastic => groom.attribute(names::TRANSPARENCY).and_then(transparency),
        };
        let HairParameters { beta_n, aspect, .. } = dressed.parameters.hair;
        let major_axes = if aspect >= 1.0 { Vec::new() } else { major_axes(groom) };
        let absorption = dressed.absorption;
        let by_vertex =
            matches!(absorption, Varying::Vertex(_)) || matches!(transparency, Some(Varying::Vertex(_)));
        let offsets = if by_vertex { groom.offsets().to_vec() } else { Vec::new() };
        let fixed_offset = material.fixed_offset;
        let medulla_as_cortex = material.fibre.medulla_as_cortex;
        let counts = (groom.strand_count(), groom.point_count());
        Ok(Fibres {
            models,
            absorption,
            transparency,
            fixed_offset,
            medulla_as_cortex,
            beta_n,
            major_axes,
            offsets,
            counts,
        })
    }

    /// Strands and points of the groom.
    pub fn counts(&self) -> (usize, usize) {
        self.counts
    }

    /// The medulla's table, where there is one.
    pub fn table(&self) -> Option<&TableUse> {
        self.models.table()
    }

    /// How likely a ray passes the fibre untouched at this hit.
    pub fn transparency(&self, hit: &Hit) -> f32 {
        match (&self.transparency, place(hit)) {
            (Some(varying), Some(place)) => at(varying, &self.offsets, place, |a, b, u| a + (b - a) * u),
            _ => 0.0,
        }
    }

    /// Whether any ray may pass.
    pub fn may_be_passed(&self) -> bool {
        self.transparency.is_some()
    }

    /// The roughness around the fibre that Chiang's fit of colours asks for.
    pub fn beta_n(&self) -> f32 {
        self.beta_n
    }

    /// Gives all strands one absorption of the cortex, and returns what they had. The medulla's follows it
    /// where the material says so; else it stays where it is the same for all, and becomes its mean where it
    /// is not.
    pub fn set_cortex(&mut self, cortex: Vec3) -> Result<Varying<Absorption>, ScatteringError> {
        let medulla = match &self.absorption {
            _ if self.medulla_as_cortex => cortex,
            Varying::Constant(absorption) => absorption.medulla(),
            Varying::Strand(all) | Varying::Vertex(all) => {
                let sum: DVec3 = all.iter().map(|a| a.medulla().as_dvec3()).sum();
                (sum / all.len().max(1) as f64).as_vec3()
            }
        };
        Ok(self.set_absorption(Varying::Constant(Absorption::new(cortex, medulla)?)))
    }

    /// Puts another absorption in place, and returns the one before.
    pub fn set_absorption(&mut self, absorption: Varying<Absorption>) -> Varying<Absorption> {
        std::mem::replace(&mut self.absorption, absorption)
    }

    /// What the fibre is like at a hit.
    pub fn point(&self, hit: &Hit) -> FibrePoint<'_> {
        let place = place(hit);
        let absorption = match (&self.absorption, place) {
            (Varying::Constant(absorption), _) => *absorption,
            (varying, Some(place)) => at(varying, &self.offsets, place, |a, b, u| a.toward(b, u)),
            (_, None) => Absorption::default(),
        };
        let strand = place.map_or(0, |(strand, ..)| strand);
        FibrePoint {
            material: self.models.of(strand),
            absorption,
            fixed_offset: self.fixed_offset,
            major_axis: self.major_axes.get(strand as usize).copied(),
        }
    }
}

/// A direction across each strand, turned about it by chance: where an elliptical fibre is wide.
///
/// Nobody measures how fibres lie in their follicles, and a groom seldom says; the direction belongs to the
/// strand, so that its frame does not turn from hit to hit.
fn major_axes(groom: &Groom) -> Vec<Vec3> {
    let axis = |strand: usize| {
        let points = groom.strand(strand);
        let chord = match (points.first(), points.last()) {
            (Some(&root), Some(&tip)) => (tip - root).try_normalize().unwrap_or(Vec3::Y),
            _ => Vec3::Y,
        };
        let chord = groom.up_axis.rotate(chord, UpAxis::Y);
        let (across, other) = chord.any_orthonormal_pair();
        let angle = std::f32::consts::TAU * groom::random(0, groom.strand_id(strand), "cross-section");
        across * angle.cos() + other * angle.sin()
    };
    (0..groom.strand_count()).map(axis).collect()
}

/// Strand, segment and how far along it.
fn place(hit: &Hit) -> Option<(u32, u32, f32)> {
    match (hit.primitive, hit.kind) {
        (Primitive::Segment { strand, segment, .. }, HitKind::Segment { u, .. }) => {
            Some((strand, segment, u))
        }
        _ => None,
    }
}

fn at<T: Copy>(
    varying: &Varying<T>,
    offsets: &[u32],
    (strand, segment, u): (u32, u32, f32),
    lerp: impl Fn(T, T, f32) -> T,
) -> T {
    match varying {
        Varying::Constant(value) => *value,
        Varying::Strand(values) => values[strand as usize],
        Varying::Vertex(values) => {
            let vertex = (offsets[strand as usize] + segment) as usize;
            lerp(values[vertex], values[vertex + 1], u)
        }
    }
}

fn transparency(attribute: &Attribute) -> Option<Varying<f32>> {
    let Values::Float(values) = &attribute.values else { return None };
    let clear = |v: f32| if v.is_finite() { v.clamp(0.0, 1.0) } else { 0.0 };
    let values: Vec<f32> = values.iter().copied().map(clear).collect();
    let varying = Varying::new(attribute.domain, values)?;
    // Opaque hair needs no look-up.
    (!matches!(varying, Varying::Constant(0.0))).then_some(varying)
}
