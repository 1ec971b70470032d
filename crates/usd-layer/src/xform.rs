//! Transforms of prims: `xformOpOrder` and the ops it names (UsdGeomXformable).

use glam::{DMat4, DQuat, DVec3};

use crate::{Attribute, Layer, Prim, ReadError, Value};

/// A transform that cannot be worked out.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{attribute}: found {found}, expected {expected}")]
pub struct XformError {
    /// The attribute at fault, with its place in the file where its bytes are broken.
    pub attribute: String,
    /// What is there.
    pub found: String,
    /// What would be right.
    pub expected: String,
}

impl XformError {
    fn value(attribute: &str, found: impl Into<String>, expected: impl Into<String>) -> Self {
        XformError { attribute: attribute.into(), found: found.into(), expected: expected.into() }
    }

    fn layer(attribute: &str, error: ReadError) -> Self {
        XformError::value(&format!("{attribute}, {}", error.place), error.found, error.expected)
    }
}

/// The op that leaves out the transforms of the prims above.
const RESET: &str = "!resetXformStack!";
const INVERSE: &str = "!invert!";

/// The ops of a prim that move.
pub fn moving_attributes(prim: &Prim) -> impl Iterator<Item = &Attribute> {
    let ops = prim.attributes.iter().filter(|attribute| attribute.name.starts_with("xformOp:"));
    ops.filter(|attribute| attribute.samples.is_some())
}

/// From the prim's space to its parent's, for columns of points, and whether the transforms above it do not count.
/// Numbers are linear between samples, turns given as quaternions go the shortest way. `None` asks for the
/// transform at no time in particular.
///
/// # Errors
/// [`XformError`]: an op that is named and not there, of a kind or a number of numbers that UsdGeomXformOp does
/// not have, or to be inverted without having an inverse.
pub fn parent_from_prim<B: AsRef<[u8]>>(
    layer: &Layer<B>,
    prim: &Prim,
    time: Option<f64>,
) -> Result<(DMat4, bool), XformError> {
    let (mut matrix, mut resets) = (DMat4::IDENTITY, false);
    let Some(order) = prim.attribute("xformOpOrder").and_then(|order| order.held(time)) else {
        return Ok((matrix, resets));
    };
    let fault = |error| XformError::layer("xformOpOrder", error);
    // The first op is the outermost: what is nearest to the points comes last.
    for op in layer.texts(order).map_err(fault)? {
        if &*op == RESET {
            (matrix, resets) = (DMat4::IDENTITY, true);
            continue;
        }
        let (name, inverse) = op.strip_prefix(INVERSE).map_or((&*op, false), |name| (name, true));
        let Some(attribute) = prim.attribute(name) else {
            return Err(XformError::value(name, "no such op", "one for every name in xformOpOrder"));
        };
        // An op without a value does nothing.
        let Some(value) = components(attribute, time) else { continue };
        let of = matrix_of(name, &value).ok_or_else(|| {
            XformError::value(name, format!("{} numbers of an op", value.len()), "an op of UsdGeomXformOp")
        })?;
        if inverse && of.determinant() == 0.0 {
            return Err(XformError::value(name, "a transform without an inverse", "one that keeps volumes"));
        }
        matrix *= if inverse { of.inverse() } else { of };
    }
    Ok((matrix, resets))
}

/// The op's numbers at a time, linear between samples but for turns given as quaternions.
fn components(attribute: &Attribute, time: Option<f64>) -> Option<Vec<f64>> {
    let samples = attribute.samples.as_ref().filter(|samples| samples.times.len() > 1);
    let (Some(samples), Some(time)) = (samples, time) else {
        return attribute.held(time).and_then(Value::components);
    };
    let (first, second, t) = samples.around(time);
    let a = samples.values.get(first)?.components()?;
    let b = samples.values.get(second)?.components()?;
    if a.len() != b.len() || t == 0.0 {
        return Some(a);
    }
    if attribute.type_name.starts_with("quat") {
        return Some(slerp(&a, &b, t));
    }
    Some(a.iter().zip(&b).map(|(a, b)| a + (b - a) * t).collect())
}

fn slerp(a: &[f64], b: &[f64], t: f64) -> Vec<f64> {
    let (Some(a), Some(b)) = (quaternion(a), quaternion(b)) else { return a.to_vec() };
    let q = a.slerp(b, t);
    vec![q.w, q.x, q.y, q.z]
}

/// Of length 1; one of length 0 turns nothing.
fn quaternion(value: &[f64]) -> Option<DQuat> {
    let [w, x, y, z] = *value else { return None };
    let given = DQuat::from_xyzw(x, y, z, w);
    Some(if given.length_squared() > 0.0 { given.normalize() } else { DQuat::IDENTITY })
}

/// The matrix, for columns of points, that an op with these numbers stands for.
fn matrix_of(name: &str, value: &[f64]) -> Option<DMat4> {
    let kind = name.strip_prefix("xformOp:")?.split(':').next()?;
    let single = || Some(*value.first()?).filter(|_| value.len() == 1);
    let vector = || match *value {
        [x, y, z] => Some(DVec3::new(x, y, z)),
        _ => None,
    };
    let axis = |axis: &str| match axis {
        "X" => Some(DVec3::X),
        "Y" => Some(DVec3::Y),
        "Z" => Some(DVec3::Z),
        _ => None,
    };
    match kind {
        "translate" => Some(DMat4::from_translation(vector()?)),
        "scale" => Some(DMat4::from_scale(vector()?)),
        "orient" => Some(DMat4::from_quat(quaternion(value)?)),
        // Rows of what multiplies rows from the right are columns of what multiplies columns.
        "transform" => Some(DMat4::from_cols_array(value.try_into().ok()?)),
        _ => {
            if let Some(along) = kind.strip_prefix("translate").and_then(axis) {
                return Some(DMat4::from_translation(along * single()?));
            }
            if let Some(along) = kind.strip_prefix("scale").and_then(axis) {
                return Some(DMat4::from_scale(DVec3::ONE + along * (single()? - 1.0)));
            }
            turns(kind.strip_prefix("rotate")?, value)
        }
    }
}

/// Turns by degrees about axes, the first of the name first.
fn turns(axes: &str, degrees: &[f64]) -> Option<DMat4> {
    if axes.len() == 3 && degrees.len() != 3
        || axes.len() == 1 && degrees.len() != 1
        || !matches!(axes.len(), 1 | 3)
    {
        return None;
    }
    let mut matrix = DMat4::IDENTITY;
    for axis in axes.chars() {
        let (place, turn): (usize, fn(f64) -> DMat4) = match axis {
            'X' => (0, DMat4::from_rotation_x),
            'Y' => (1, DMat4::from_rotation_y),
            'Z' => (2, DMat4::from_rotation_z),
            _ => return None,
        };
        let degrees = if degrees.len() == 1 { degrees.first() } else { degrees.get(place) };
        matrix = turn(degrees?.to_radians()) * matrix;
    }
    Some(matrix)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ops_are_matrices() {
        let moved = |name: &str, value: &[f64]| {
            let matrix = matrix_of(name, value).unwrap();
            matrix.transform_point3(DVec3::new(1.0, 2.0, 3.0)).round().to_array()
        };
        assert_eq!(moved("xformOp:translate", &[1.0, 0.0, -1.0]), [2.0, 2.0, 2.0]);
        assert_eq!(moved("xformOp:scale:pivot", &[2.0, 1.0, 1.0]), [2.0, 2.0, 3.0]);
        assert_eq!(moved("xformOp:rotateZ", &[90.0]), [-2.0, 1.0, 3.0]);
        assert_eq!(moved("xformOp:orient", &[2.0, 0.0, 0.0, 2.0]), [-2.0, 1.0, 3.0]);
        assert_eq!(moved("xformOp:orient", &[0.0; 4]), [1.0, 2.0, 3.0]);
        // About x first, then z.
        assert_eq!(moved("xformOp:rotateXYZ", &[90.0, 0.0, 90.0]), [3.0, 1.0, 2.0]);
        assert_eq!(moved("xformOp:rotateZYX", &[90.0, 0.0, 90.0]), [-2.0, -3.0, 1.0]);
        let mut matrix = [0.0; 16];
        for i in 0..4 {
            matrix[i * 5] = 1.0;
        }
        matrix[12] = 5.0;
        assert_eq!(moved("xformOp:transform", &matrix), [6.0, 2.0, 3.0]);
        for (name, value) in
            [("xformOp:rotateXY", &[1.0][..]), ("xformOp:translate", &[1.0]), ("scale", &[1.0])]
        {
            assert_eq!(matrix_of(name, value), None, "{name}");
        }
    }
}
