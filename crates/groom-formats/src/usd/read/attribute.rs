//! Attributes of curves as those of a groom.

use glam::{DMat4, Vec3};
use groom::{Attribute, Domain, Values, names};

use super::curves::Curves;
use super::values::{self, Fault};
use crate::join::value_size;
use crate::{FormatError, Warning};

/// What writes strands as joints move them.
const BAKE: &str = "; bake the stage first: tools/usd/bake.py";

/// Every attribute of a prim that a groom can hold, by its name there.
pub(super) fn all<B: AsRef<[u8]>>(
    curves: &Curves<'_, B>,
    warnings: &mut Vec<Warning>,
) -> Result<Vec<(String, Attribute)>, FormatError> {
    let mut found: Vec<(String, Attribute)> = Vec::new();
    let mut add = |name: String, attribute: Option<Attribute>| {
        if let Some(attribute) = attribute {
            found.push((name, attribute));
        }
    };
    let own_widths = curves.prim.attribute("primvars:widths").is_some_and(usd_layer::Attribute::has_value);
    for attribute in &curves.prim.attributes {
        let name = &*attribute.name;
        let primvar = name.strip_prefix("primvars:").filter(|name| !name.ends_with(":indices"));
        match (name, primvar) {
            ("widths", _) if !own_widths => add(names::RADIUS.into(), radius(curves, attribute, warnings)?),
            ("velocities", _) => add(names::VELOCITY.into(), velocity(curves, attribute, warnings)?),
            ("primvars:widths", _) => add(names::RADIUS.into(), radius(curves, attribute, warnings)?),
            ("primvars:displayColor", _) => {
                add(names::COLOR.into(), read(curves, attribute, "constant", warnings)?)
            }
            ("primvars:displayOpacity", _) => {
                let mut opacity = read(curves, attribute, "constant", warnings)?;
                if let Some(Attribute { values: Values::Float(values), .. }) = &mut opacity {
                    values.iter_mut().for_each(|value| *value = 1.0 - *value);
                }
                add(names::TRANSPARENCY.into(), opacity);
            }
            // The numbers of joints mean nothing without their skeleton.
            (_, Some(primvar)) if primvar.starts_with("skel:") => {
                let warning = Warning::StillAsModelled { by: "joints", remedy: BAKE };
                if primvar == "skel:jointIndices" && !warnings.contains(&warning) {
                    warnings.push(warning);
                }
            }
            ("primvars:st", _) => add(names::ROOT_UV.into(), read(curves, attribute, "constant", warnings)?),
            (_, Some(primvar)) => add(primvar.into(), read(curves, attribute, "constant", warnings)?),
            _ => {}
        }
    }
    Ok(found)
}

/// Half the width, times the mean scale of what brings the prim into the stage's space.
fn radius<B: AsRef<[u8]>>(
    curves: &Curves<'_, B>,
    widths: &usd_layer::Attribute,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Attribute>, FormatError> {
    let fallback = if widths.name.starts_with("primvars:") { "constant" } else { "vertex" };
    let mut radius = read(curves, widths, fallback, warnings)?;
    if let Some(Attribute { values: Values::Float(values), .. }) = &mut radius {
        let scale = curves.world_from_prim.map_or(1.0, |world| mean_scale(&world));
        values.iter_mut().for_each(|value| *value *= 0.5);
        if scale != 1.0 {
            values.iter_mut().for_each(|value| *value = (f64::from(*value) * scale) as f32);
        }
    }
    Ok(radius)
}

/// The side of the cube that a unit cube is as large as; exactly 1 for a turn.
fn mean_scale(world: &DMat4) -> f64 {
    let scale = world.determinant().abs().cbrt();
    if (scale - 1.0).abs() < 1e-9 { 1.0 } else { scale }
}

fn velocity<B: AsRef<[u8]>>(
    curves: &Curves<'_, B>,
    velocities: &usd_layer::Attribute,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Attribute>, FormatError> {
    let mut velocity = read(curves, velocities, "vertex", warnings)?;
    if let (Some(world), Some(Attribute { values: Values::Vec3(values), .. })) =
        (curves.world_from_prim, &mut velocity)
    {
        values.iter_mut().for_each(|v| *v = world.transform_vector3(v.as_dvec3()).as_vec3());
    }
    Ok(velocity)
}

/// Velocities or accelerations of the strands' points.
pub(super) fn rate<B: AsRef<[u8]>>(
    curves: &Curves<'_, B>,
    name: &str,
) -> Result<Option<Vec<Vec3>>, FormatError> {
    let Some(attribute) = curves.prim.attribute(name) else { return Ok(None) };
    Ok(match velocity(curves, attribute, &mut Vec::new())? {
        Some(Attribute { domain: Domain::Vertex, values: Values::Vec3(values) }) => Some(values),
        _ => None,
    })
}

/// An attribute at the points of the strands, or at strands, or one for all; `None`, with a warning, for what a
/// groom cannot hold.
fn read<B: AsRef<[u8]>>(
    curves: &Curves<'_, B>,
    attribute: &usd_layer::Attribute,
    fallback: &str,
    warnings: &mut Vec<Warning>,
) -> Result<Option<Attribute>, FormatError> {
    if !attribute.has_value() {
        return Ok(None);
    }
    let mut left_out = |why: String| {
        warnings.push(Warning::AttributeNotRead { name: attribute.name.to_string(), why });
        Ok(None)
    };
    let element_size = attribute.metadata("elementSize").and_then(usd_layer::Value::integer);
    if element_size.is_some_and(|size| size > 1) {
        return left_out("it has several values each".into());
    }
    let error = |fault: Fault| curves.error(fault);
    let Some(values) = values::at(&curves.stage.layer, attribute, curves.time).map_err(error)? else {
        return left_out(format!("a groom holds no {}", attribute.type_name));
    };
    let indices = curves.prim.attribute(&format!("{}:indices", attribute.name));
    let indices =
        indices.map(|indices| values::integers(&curves.stage.layer, indices, curves.time)).transpose();
    let (name, size) = (&*attribute.name, value_size(&values));
    let values = match indices.map_err(error)?.flatten() {
        Some(indices) => {
            curves.take(name, indices.len(), size)?;
            let fault = |found| {
                Fault::value(&format!("{}:indices", attribute.name), found, format!("0 to {}", values.len()))
            };
            look_up(&values, &indices).map_err(|index| error(fault(format!("index {index}"))))?
        }
        None => {
            curves.take(name, values.len(), size)?;
            values
        }
    };
    let (found, interpolation) = (values.len(), attribute.interpolation().unwrap_or(fallback));
    match place(curves, values, interpolation) {
        Some(attribute) => {
            curves.take_sampled(name, found, attribute.values.len(), size)?;
            Ok(Some(attribute))
        }
        None => left_out(format!("{found} values do not fit its interpolation, {interpolation}")),
    }
}

fn look_up(values: &Values, indices: &[i32]) -> Result<Values, i32> {
    fn each<T: Copy>(values: &[T], indices: &[i32]) -> Result<Vec<T>, i32> {
        let look =
            |&index: &i32| usize::try_from(index).ok().and_then(|i| values.get(i)).copied().ok_or(index);
        indices.iter().map(look).collect()
    }
    Ok(match values {
        Values::Float(values) => Values::Float(each(values, indices)?),
        Values::Vec2(values) => Values::Vec2(each(values, indices)?),
        Values::Vec3(values) => Values::Vec3(each(values, indices)?),
        Values::Int(values) => Values::Int(each(values, indices)?),
    })
}

/// Brings values to where the groom has them; `None` if they are too few or too many.
fn place<B: AsRef<[u8]>>(curves: &Curves<'_, B>, values: Values, interpolation: &str) -> Option<Attribute> {
    let counts = &curves.polylines.counts;
    match interpolation {
        "constant" => (values.len() == 1).then_some(Attribute { domain: Domain::Groom, values }),
        "uniform" => {
            let values = (values.len() == counts.len()).then(|| without_empty(values, counts))?;
            Some(Attribute { domain: Domain::Strand, values })
        }
        "vertex" => {
            let values = (values.len() == curves.control_points).then_some(values)?;
            let values = match values {
                Values::Float(values) => Values::Float(curves.polylines.per_point(values)),
                Values::Vec2(values) => Values::Vec2(curves.polylines.per_point(values)),
                Values::Vec3(values) => Values::Vec3(curves.polylines.per_point(values)),
                Values::Int(values) => {
                    // Whole numbers are not mixed on a cubic curve.
                    let plain = curves.polylines.are_plain();
                    plain.then_some(Values::Int(values))?
                }
            };
            Some(Attribute { domain: Domain::Vertex, values })
        }
        "varying" | "faceVarying" => {
            let values = match values {
                Values::Float(values) => Values::Float(curves.polylines.per_span_end(values)?),
                Values::Vec2(values) => Values::Vec2(curves.polylines.per_span_end(values)?),
                Values::Vec3(values) => Values::Vec3(curves.polylines.per_span_end(values)?),
                Values::Int(_) => return None,
            };
            Some(Attribute { domain: Domain::Vertex, values })
        }
        _ => None,
    }
}

/// Values of curves that have points.
fn without_empty(values: Values, counts: &[u32]) -> Values {
    fn keep<T>(values: Vec<T>, counts: &[u32]) -> Vec<T> {
        values.into_iter().zip(counts).filter(|(_, count)| **count > 0).map(|(value, _)| value).collect()
    }
    if !counts.contains(&0) {
        return values;
    }
    match values {
        Values::Float(values) => Values::Float(keep(values, counts)),
        Values::Vec2(values) => Values::Vec2(keep(values, counts)),
        Values::Vec3(values) => Values::Vec3(keep(values, counts)),
        Values::Int(values) => Values::Int(keep(values, counts)),
    }
}
