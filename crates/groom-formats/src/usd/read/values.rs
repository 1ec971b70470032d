//! Values of attributes as those of a groom, at a time.

use bytemuck::allocation::cast_vec;
use glam::{Vec2, Vec3};
use groom::Values;
use usd_layer::xform::XformError;
use usd_layer::{Attribute, Element, Layer, ReadError, Value};

use crate::FormatError;

/// What is wrong with an attribute.
#[derive(Debug)]
pub(super) enum Fault {
    /// Its bytes.
    Layer { attribute: String, error: ReadError },
    /// What they mean.
    Value { attribute: String, found: String, expected: String },
}

impl From<XformError> for Fault {
    fn from(error: XformError) -> Self {
        Fault::value(&error.attribute, error.found, error.expected)
    }
}

impl Fault {
    pub(super) fn value(attribute: &str, found: impl Into<String>, expected: impl Into<String>) -> Self {
        Fault::Value { attribute: attribute.into(), found: found.into(), expected: expected.into() }
    }

    pub(super) fn into_error(self, file: &str, path: &str) -> FormatError {
        match self {
            Fault::Layer { attribute, error } => {
                let place = format!("{path}.{attribute}, {}", error.place);
                FormatError::invalid(file, place, error.found, error.expected)
            }
            Fault::Value { attribute, found, expected } => {
                FormatError::invalid(file, format!("{path}.{attribute}"), found, expected)
            }
        }
    }
}

/// The value at a time, linear between samples where it is not whole numbers; `None` when there is none, or one
/// of a type that a groom cannot hold.
pub(super) fn at<B: AsRef<[u8]>>(
    layer: &Layer<B>,
    attribute: &Attribute,
    time: Option<f64>,
) -> Result<Option<Values>, Fault> {
    let name = attribute.type_name.strip_suffix("[]").unwrap_or(&attribute.type_name);
    let Some(element) = Element::from_type_name(name) else { return Ok(None) };
    let fault = |error| Fault::Layer { attribute: attribute.name.to_string(), error };
    let read = |value: &Value| read(layer, element, value).map_err(fault);
    let samples = attribute.samples.as_ref().filter(|samples| samples.times.len() > 1);
    if let (Some(samples), Some(time)) = (samples, time) {
        let (first, second, t) = samples.around(time);
        if t > 0.0 {
            let ends = samples.values.get(first).zip(samples.values.get(second));
            if let Some((a @ (Value::Array(_) | Value::Float(_) | Value::Tuple(_)), b)) = ends
                && *b != Value::Blocked
            {
                return Ok(read(a)?.zip(read(b)?).map(|(a, b)| between(a, &b, t)));
            }
        }
    }
    attribute.held(time).map_or(Ok(None), read)
}

/// Whole numbers: `curveVertexCounts` and indices.
pub(super) fn integers<B: AsRef<[u8]>>(
    layer: &Layer<B>,
    attribute: &Attribute,
    time: Option<f64>,
) -> Result<Option<Vec<i32>>, Fault> {
    let fault = |error| Fault::Layer { attribute: attribute.name.to_string(), error };
    attribute.held(time).map(|value| layer.numbers::<i32>(value).map_err(fault)).transpose()
}

fn read<B: AsRef<[u8]>>(
    layer: &Layer<B>,
    element: Element,
    value: &Value,
) -> Result<Option<Values>, ReadError> {
    if element.scalar.is_text() {
        return Ok(None);
    }
    if let Value::Bool(value) = value {
        return Ok(Some(Values::Int(vec![i32::from(*value)])));
    }
    Ok(match (element.components, element.scalar.is_integer()) {
        (1, true) => Some(Values::Int(layer.numbers(value)?)),
        (1, false) => Some(Values::Float(layer.numbers(value)?)),
        (2, _) => Some(Values::Vec2(cast_vec::<[f32; 2], Vec2>(layer.values(value)?))),
        (3, _) => Some(Values::Vec3(cast_vec::<[f32; 3], Vec3>(layer.values(value)?))),
        _ => None,
    })
}

/// From `a` to `b`; `a` if they do not fit, as USD holds values that it cannot interpolate.
fn between(mut a: Values, b: &Values, t: f64) -> Values {
    let mix = |a: f32, b: f32| (f64::from(a) * (1.0 - t) + f64::from(b) * t) as f32;
    if a.len() != b.len() {
        return a;
    }
    match (&mut a, b) {
        (Values::Float(a), Values::Float(b)) => a.iter_mut().zip(b).for_each(|(a, b)| *a = mix(*a, *b)),
        (Values::Vec2(a), Values::Vec2(b)) => {
            a.iter_mut().zip(b).for_each(|(a, b)| *a = Vec2::new(mix(a.x, b.x), mix(a.y, b.y)));
        }
        (Values::Vec3(a), Values::Vec3(b)) => {
            a.iter_mut()
                .zip(b)
                .for_each(|(a, b)| *a = Vec3::new(mix(a.x, b.x), mix(a.y, b.y), mix(a.z, b.z)));
        }
        _ => {}
    }
    a
}
