//! The strands of one groom as the render loop needs them: where a hit is, what it scatters like.

use fibre_scattering::{
    HairBcsdf, HairScatter, ScatteringError, absorption_from_color, absorption_from_melanin,
};
use glam::Vec3;
use groom::{Attribute, Domain, Groom, Values, names};
use strand_tracing::{Hit, HitKind, Primitive};

use crate::{HairColor, HairMaterial, RenderError, Transparency};

/// The material of a groom's fibres, looked up by hit.
#[derive(Debug)]
pub(crate) struct Fibres {
    bcsdf: HairBcsdf,
    /// Only what varies is kept; a constant is in `bcsdf`.
    absorption: Varying<Vec3>,
    transparency: Option<Varying<f32>>,
    /// Only kept where something varies by vertex.
    offsets: Vec<u32>,
}

/// A value that may differ by strand or vertex.
#[derive(Debug)]
enum Varying<T> {
    Constant(T),
    Strand(Vec<T>),
    Vertex(Vec<T>),
}

impl Fibres {
    pub fn new(object: usize, groom: &Groom, material: &HairMaterial) -> Result<Self, RenderError> {
        let refused = |source: ScatteringError| RenderError::Scattering { object, source };
        let absorption = absorption(groom, material)?;
        let mut parameters = material.parameters;
        parameters.sigma_a = match absorption {
            Varying::Constant(sigma) => sigma,
            _ => Vec3::ZERO,
        };
        let bcsdf = HairBcsdf::new(&parameters).map_err(refused)?;
        let transparency = match material.transparency {
            Transparency::Ignored => None,
            Transparency::Stochastic => groom.attribute(names::TRANSPARENCY).and_then(transparency),
        };
        let by_vertex =
            matches!(absorption, Varying::Vertex(_)) || matches!(transparency, Some(Varying::Vertex(_)));
        let offsets = if by_vertex { groom.offsets().to_vec() } else { Vec::new() };
        Ok(Fibres { bcsdf, absorption, transparency, offsets })
    }

    /// How likely a ray passes the fibre untouched at this hit.
    pub fn transparency(&self, hit: &Hit) -> f32 {
        match (&self.transparency, place(hit)) {
            (Some(varying), Some(place)) => varying.at(&self.offsets, place, |a, b, u| a + (b - a) * u),
            _ => 0.0,
        }
    }

    /// Whether any ray may pass.
    pub fn may_be_passed(&self) -> bool {
        self.transparency.is_some()
    }

    /// The material at a hit, with the absorption found there.
    pub fn material(&self, hit: &Hit) -> HairBcsdf {
        match (&self.absorption, place(hit)) {
            (Varying::Constant(_), _) | (_, None) => self.bcsdf,
            (varying, Some(place)) => {
                self.bcsdf.with_absorption(varying.at(&self.offsets, place, |a, b, u| a.lerp(b, u)))
            }
        }
    }
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

impl<T: Copy> Varying<T> {
    fn at(&self, offsets: &[u32], (strand, segment, u): (u32, u32, f32), lerp: impl Fn(T, T, f32) -> T) -> T {
        match self {
            Varying::Constant(value) => *value,
            Varying::Strand(values) => values[strand as usize],
            Varying::Vertex(values) => {
                let vertex = (offsets[strand as usize] + segment) as usize;
                lerp(values[vertex], values[vertex + 1], u)
            }
        }
    }
}

fn transparency(attribute: &Attribute) -> Option<Varying<f32>> {
    let Values::Float(values) = &attribute.values else { return None };
    let clear = |v: f32| if v.is_finite() { v.clamp(0.0, 1.0) } else { 0.0 };
    let values: Vec<f32> = values.iter().copied().map(clear).collect();
    let varying = vary(attribute.domain, values)?;
    // Opaque hair needs no look-up.
    (!matches!(varying, Varying::Constant(0.0))).then_some(varying)
}

fn vary<T: Copy>(domain: Domain, values: Vec<T>) -> Option<Varying<T>> {
    Some(match domain {
        Domain::Groom => Varying::Constant(*values.first()?),
        Domain::Strand => Varying::Strand(values),
        Domain::Vertex => Varying::Vertex(values),
    })
}

fn absorption(groom: &Groom, material: &HairMaterial) -> Result<Varying<Vec3>, RenderError> {
    let beta_n = material.parameters.beta_n;
    Ok(match material.color {
        HairColor::Absorption(sigma) => Varying::Constant(sigma),
        HairColor::Melanin { concentration, redness } => {
            for (what, value) in [("melanin concentration", concentration), ("melanin redness", redness)] {
                if !(0.0..=1.0).contains(&value) {
                    return Err(RenderError::argument(what, value, "0..1"));
                }
            }
            Varying::Constant(absorption_from_melanin(concentration, redness))
        }
        HairColor::Color(color) => Varying::Constant(absorption_from_color(checked(color)?, beta_n)),
        HairColor::Groom { fallback } => match groom.attribute(names::COLOR) {
            Some(Attribute { domain, values: Values::Vec3(colors) }) => by_color(*domain, colors, beta_n)?,
            _ => Varying::Constant(absorption_from_color(checked(fallback)?, beta_n)),
        },
    })
}

/// Colours turned into absorption, kept once when they are all the same.
fn by_color(domain: Domain, colors: &[Vec3], beta_n: f32) -> Result<Varying<Vec3>, RenderError> {
    let first = checked(colors.first().copied().unwrap_or(Vec3::ONE))?;
    if colors.iter().all(|&color| color == first) {
        return Ok(Varying::Constant(absorption_from_color(first, beta_n)));
    }
    let sigmas: Result<Vec<_>, _> = colors
        .iter()
        .map(|&color| checked(color).map(|color| absorption_from_color(color, beta_n)))
        .collect();
    Ok(vary(domain, sigmas?).unwrap_or(Varying::Constant(Vec3::ZERO)))
}

fn checked(color: Vec3) -> Result<Vec3, RenderError> {
    if color.is_finite() && color.min_element() >= 0.0 {
        Ok(color.min(Vec3::ONE))
    } else {
        Err(RenderError::argument("hair colour", color, "finite, 0..1"))
    }
}

/// A fibre at a hit: the scattering function and the frame it is stated in.
pub(crate) struct FibreHit {
    scatter: HairScatter,
    /// Along the fibre, towards the viewer, and across; the bcsdf's x, y and z.
    axes: [Vec3; 3],
}

impl FibreHit {
    /// `toward` is the unit direction back along the ray that hit.
    pub fn new(material: &HairBcsdf, tangent: Vec3, h: f32, toward: Vec3) -> Self {
        // The azimuth of the viewer is 0 by the choice of axes. `h` counts along z x x of the tracer's
        // frame, which is the negative of the third axis here: light that enters at positive h leaves
        // towards negative z, as the geometric reflection has it.
        let along = toward.dot(tangent);
        let facing =
            (toward - tangent * along).try_normalize().unwrap_or_else(|| tangent.any_orthonormal_vector());
        let axes = [tangent, facing, tangent.cross(facing)];
        let wo = Vec3::new(along, toward.dot(facing), 0.0).normalize();
        FibreHit { scatter: material.at(wo, h), axes }
    }

    pub fn scatter(&self) -> &HairScatter {
        &self.scatter
    }

    pub fn to_fibre(&self, v: Vec3) -> Vec3 {
        Vec3::from_array(self.axes.map(|axis| axis.dot(v)))
    }

    pub fn to_world(&self, v: Vec3) -> Vec3 {
        (self.axes[0] * v.x + self.axes[1] * v.y + self.axes[2] * v.z).normalize()
    }
}
