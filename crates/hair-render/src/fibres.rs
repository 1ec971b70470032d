//! The strands of one groom as the render loop needs them: where a hit is, what it scatters like.

use fibre_material::{Dressed, Field, Varying};
use fibre_scattering::{
    Absorption, FarFieldBcsdf, FibreBcsdf, FibreScatter, FurBcsdf, HairBcsdf, MedullaKey, ScatteringError,
};
use glam::Vec3;
use groom::{Attribute, Groom, Values, names};
use strand_tracing::{Hit, HitKind, Primitive};

use crate::{HairMaterial, RenderError, Transparency};

/// The material of a groom's fibres, looked up by hit.
#[derive(Debug)]
pub(crate) struct Fibres {
    bcsdf: FibreBcsdf,
    absorption: Varying<Absorption>,
    transparency: Option<Varying<f32>>,
    /// Only kept where something varies by vertex.
    offsets: Vec<u32>,
}

impl Fibres {
    pub fn new(object: usize, groom: &Groom, material: &HairMaterial) -> Result<Self, RenderError> {
        let Dressed { parameters, absorption, field, .. } =
            material.fibre.dress(groom).map_err(|source| RenderError::Material { object, source })?;
        let refused = |source: ScatteringError| RenderError::Scattering { object, source };
        let bcsdf = match (field, MedullaKey::needed(&parameters)) {
            (_, Some(key)) => {
                let table =
                    medulla_tables::table(&key).map_err(|source| RenderError::Table { object, source })?;
                FibreBcsdf::Fur(FurBcsdf::new(&parameters, Some(table)).map_err(refused)?)
            }
            (_, None) if parameters.medulla.kappa > 0.0 => {
                FibreBcsdf::Fur(FurBcsdf::new(&parameters, None).map_err(refused)?)
            }
            (Field::Far { nodes }, None) => {
                FibreBcsdf::FarField(FarFieldBcsdf::new(&parameters.hair, nodes).map_err(refused)?)
            }
            (Field::Near, None) => FibreBcsdf::Hair(HairBcsdf::new(&parameters.hair).map_err(refused)?),
        };
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
            (Some(varying), Some(place)) => at(varying, &self.offsets, place, |a, b, u| a + (b - a) * u),
            _ => 0.0,
        }
    }

    /// Whether any ray may pass.
    pub fn may_be_passed(&self) -> bool {
        self.transparency.is_some()
    }

    /// The material at a hit, and the absorption found there.
    pub fn material(&self, hit: &Hit) -> (&FibreBcsdf, Absorption) {
        let absorption = match (&self.absorption, place(hit)) {
            (Varying::Constant(absorption), _) => *absorption,
            (varying, Some(place)) => at(varying, &self.offsets, place, |a, b, u| a.toward(b, u)),
            (_, None) => Absorption::default(),
        };
        (&self.bcsdf, absorption)
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

/// A fibre at a hit: the scattering function and the frame it is stated in.
pub(crate) struct FibreHit<'a> {
    scatter: FibreScatter<'a>,
    /// Along the fibre, towards the viewer, and across; the bcsdf's x, y and z.
    axes: [Vec3; 3],
}

impl<'a> FibreHit<'a> {
    /// `toward` is the unit direction back along the ray that hit.
    pub fn new(
        (material, absorption): (&'a FibreBcsdf, Absorption),
        tangent: Vec3,
        h: f32,
        toward: Vec3,
    ) -> Self {
        // The azimuth of the viewer is 0 by the choice of axes. `h` counts along z x x of the tracer's
        // frame, which is the negative of the third axis here: light that enters at positive h leaves
        // towards negative z, as the geometric reflection has it.
        let along = toward.dot(tangent);
        let facing =
            (toward - tangent * along).try_normalize().unwrap_or_else(|| tangent.any_orthonormal_vector());
        let axes = [tangent, facing, tangent.cross(facing)];
        let wo = Vec3::new(along, toward.dot(facing), 0.0).normalize();
        FibreHit { scatter: material.at(wo, h, absorption), axes }
    }

    pub fn scatter(&self) -> &FibreScatter<'a> {
        &self.scatter
    }

    pub fn to_fibre(&self, v: Vec3) -> Vec3 {
        Vec3::from_array(self.axes.map(|axis| axis.dot(v)))
    }

    pub fn to_world(&self, v: Vec3) -> Vec3 {
        (self.axes[0] * v.x + self.axes[1] * v.y + self.axes[2] * v.z).normalize()
    }
}
