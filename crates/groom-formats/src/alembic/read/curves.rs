//! One Curves object at a time.

use glam::{DMat4, Vec3};
use groom::Values;
use ogawa::{CompoundReader, OgawaError, PropertyReader};

use super::values::Samples;
use crate::alembic::schema;
use crate::cubic::Basis;
use crate::polylines::{Polylines, Shape, Wrap};

/// Orders of curves whose order varies, and their knots.
const ORDERS: &str = ".orders";
const KNOTS: &str = ".knots";

/// The number of a basis.
const CATMULL_ROM: u8 = 3;

/// Curves and where their strands' points are.
pub(super) struct Curves<'a> {
    pub(super) geometry: CompoundReader<'a>,
    pub(super) polylines: Polylines,
    pub(super) control_points: usize,
    pub(super) positions: Vec<Vec3>,
    /// To the archive's space; `None` where it is the curves' own.
    pub(super) world: Option<DMat4>,
}

impl<'a> Curves<'a> {
    /// Reads the curves; `like` is how they were cut at another time, which must fit.
    pub(super) fn read(
        geometry: CompoundReader<'a>,
        samples: &Samples,
        curve_error: Option<f32>,
        world: DMat4,
        like: Option<&Polylines>,
    ) -> Result<Self, OgawaError> {
        let Some(points) = geometry.find(schema::POINTS)?.filter(|points| points.sample_count() > 0) else {
            return Curves::of(geometry, Vec::new(), Vec::new(), samples, curve_error, world, like);
        };
        let positions = match samples.values(&points)? {
            Ok(Values::Vec3(positions)) => positions,
            _ => return Err(wrong(&points, format!("{:?}", points.data_type()), "three numbers a point")),
        };
        let counts = required(&geometry, schema::COUNTS)?;
        let sample = samples.held(&counts)?;
        samples.spend(4 * sample.len(), counts.name())?;
        let counts = sample.to_i32()?;
        Curves::of(geometry, counts, positions, samples, curve_error, world, like)
    }

    fn of(
        geometry: CompoundReader<'a>,
        counts: Vec<i32>,
        points: Vec<Vec3>,
        samples: &Samples,
        curve_error: Option<f32>,
        world: DMat4,
        like: Option<&Polylines>,
    ) -> Result<Self, OgawaError> {
        let shape = shape(&geometry, samples)?;
        let counts = shape.check(&counts, points.len()).map_err(|(found, expected)| {
            OgawaError::Property { name: schema::COUNTS.into(), found, expected }
        })?;
        let polylines = match like {
            Some(like) if like.counts == counts && like.shape == shape => like.clone(),
            Some(like) => {
                return Err(OgawaError::Property {
                    name: schema::COUNTS.into(),
                    found: format!("{} curves of {} points", counts.len(), points.len()),
                    expected: format!("the {} curves of the first time", like.counts.len()),
                });
            }
            None => Polylines::cut(shape, counts, &points, curve_error),
        };
        let control_points = points.len();
        let mut positions = polylines.per_point(points);
        let world = (world != DMat4::IDENTITY).then_some(world);
        if let Some(world) = world {
            positions.iter_mut().for_each(|p| *p = world.transform_point3(p.as_dvec3()).as_vec3());
        }
        Ok(Curves { geometry, polylines, control_points, positions, world })
    }

    /// Velocities at the points, where the curves have them.
    pub(super) fn velocities(&self, samples: &Samples) -> Result<Option<Vec<Vec3>>, OgawaError> {
        let Some(property) = self.geometry.find(schema::VELOCITIES)?.filter(|v| v.sample_count() > 0) else {
            return Ok(None);
        };
        let Ok(Values::Vec3(values)) = samples.values(&property)? else { return Ok(None) };
        if values.len() != self.control_points {
            return Ok(None);
        }
        let mut velocities = self.polylines.per_point(values);
        if let Some(world) = self.world {
            velocities.iter_mut().for_each(|v| *v = world.transform_vector3(v.as_dvec3()).as_vec3());
        }
        Ok(Some(velocities))
    }

    /// How much larger the curves are in the archive's space; exactly 1 where they are only turned.
    pub(super) fn scale(&self) -> f64 {
        let scale = self.world.map_or(1.0, |world| world.determinant().abs().cbrt());
        if (scale - 1.0).abs() < 1e-9 { 1.0 } else { scale }
    }
}

pub(super) fn required<'a>(
    compound: &CompoundReader<'a>,
    name: &str,
) -> Result<PropertyReader<'a>, OgawaError> {
    compound.find(name)?.filter(|property| property.sample_count() > 0).ok_or_else(|| OgawaError::Property {
        name: name.into(),
        found: "none".into(),
        expected: "one".into(),
    })
}

/// How the curves go through their points.
///
/// Alembic says no more than a basis, and its programs do not agree on ends. Catmull-Rom curves go through
/// all of their points, as in Blender. B-splines end before the outer ones, as in RenderMan, unless they
/// bring knots that are clamped: then the curve reaches its ends. Blender 5.0 calls its Catmull-Rom curves linear,
/// and reads any curve by the basis alone; no other program gives lines that basis.
fn shape(geometry: &CompoundReader<'_>, samples: &Samples) -> Result<Shape, OgawaError> {
    let property = required(geometry, schema::KIND)?;
    let &[kind, wrap, basis, ..] = samples.held(&property)?.bytes() else {
        return Err(wrong(&property, "too few numbers".into(), "4"));
    };
    let cubic = match kind {
        0 => true,
        1 => basis == CATMULL_ROM,
        2 => order(geometry, samples)?.map_or(basis == CATMULL_ROM, |order| order == 4),
        kind => {
            return Err(wrong(&property, format!("type {kind}"), "0 cubic, 1 linear or 2 variable order"));
        }
    };
    let basis = match (cubic, basis) {
        (false, _) | (true, 0) => None,
        (true, 1) => Some(Basis::Bezier),
        (true, 2) => Some(Basis::Bspline),
        (true, CATMULL_ROM) => Some(Basis::CatmullRom),
        (true, basis) => {
            let found = match basis {
                4 => "hermite curves".into(),
                5 => "power curves".into(),
                other => format!("basis {other}"),
            };
            return Err(wrong(&property, found, "linear, bezier, b-spline or Catmull-Rom curves"));
        }
    };
    let pinned = match basis {
        Some(Basis::CatmullRom) => true,
        Some(Basis::Bspline) => has_clamped_knots(geometry, samples)?,
        _ => false,
    };
    let wrap = match wrap {
        1 => Wrap::Periodic,
        _ if pinned => Wrap::Pinned,
        _ => Wrap::Nonperiodic,
    };
    Ok(Shape { basis, wrap })
}

/// Whether the first curve's knots begin with the same number several times; all curves are taken to be alike.
fn has_clamped_knots(geometry: &CompoundReader<'_>, samples: &Samples) -> Result<bool, OgawaError> {
    let Some(knots) = geometry.find(KNOTS)?.filter(|knots| knots.sample_count() > 0) else {
        return Ok(false);
    };
    // The second to the third knot: some writers leave out the outermost.
    let sample = samples.held(&knots)?;
    samples.spend(4 * sample.len(), KNOTS)?;
    Ok(matches!(sample.to_f32()?[..], [_, second, third, ..] if second == third))
}

/// The one order of all curves, 2 or 4; `None` where there are no orders.
fn order(geometry: &CompoundReader<'_>, samples: &Samples) -> Result<Option<u8>, OgawaError> {
    let Some(property) = geometry.find(ORDERS)?.filter(|orders| orders.sample_count() > 0) else {
        return Ok(None);
    };
    let orders = samples.held(&property)?.bytes();
    let Some(&first) = orders.first() else { return Ok(None) };
    if matches!(first, 2 | 4) && orders.iter().all(|&order| order == first) {
        return Ok(Some(first));
    }
    Err(wrong(&property, "curves of several or other orders".into(), "all 2 (lines) or all 4 (cubic)"))
}

fn wrong(property: &PropertyReader<'_>, found: String, expected: &str) -> OgawaError {
    OgawaError::Property { name: property.name().into(), found, expected: expected.into() }
}
