//! From the columns of a PLY element to attributes of a groom.

use glam::{Vec2, Vec3};
use groom::{Values, names};

use super::columns::{Column, Columns};
use super::header::Type;
use crate::FormatError;

/// What colours are called, the exact ones last.
const COLORS: [[&str; 3]; 4] = [
    ["r", "g", "b"],
    ["diffuse_red", "diffuse_green", "diffuse_blue"],
    ["red", "green", "blue"],
    ["color_x", "color_y", "color_z"],
];

/// Triples with a meaning of their own.
const TRIPLES: [([&str; 3], &str); 2] =
    [(["nx", "ny", "nz"], "normal"), (["vx", "vy", "vz"], names::VELOCITY)];

/// Whether `alpha` says how opaque a point is (everybody) or how clear (hairutil).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Alpha {
    Opacity,
    Transparency,
}

/// Takes every column out of `columns`; what comes later under one name wins.
pub(crate) fn of(
    mut columns: Columns,
    alpha: Alpha,
    file: &str,
    element: &str,
) -> Result<Vec<(String, Values)>, FormatError> {
    let mut found = Vec::new();
    for names in COLORS {
        if let Some(colors) = take_triple(&mut columns, names, scale) {
            found.push((names::COLOR.to_owned(), Values::Vec3(colors)));
        }
    }
    for (names, meaning) in TRIPLES {
        if let Some(values) = take_triple(&mut columns, names, |_| 1.0) {
            found.push((meaning.to_owned(), Values::Vec3(values)));
        }
    }
    if let Some((kind, column)) = columns.take("alpha") {
        let mut values = Columns::floats(column);
        let most = scale(kind);
        values.iter_mut().for_each(|value| {
            let part = *value / most;
            *value = if alpha == Alpha::Opacity { 1.0 - part } else { part };
        });
        found.push((names::TRANSPARENCY.to_owned(), Values::Float(values)));
    }
    for (name, factor) in [("width", 0.5), ("thickness", 0.5), (names::RADIUS, 1.0)] {
        if let Some(mut radii) = columns.take_floats(name) {
            if let Some(row) = radii.iter().position(|radius| !(radius.is_finite() && *radius >= 0.0)) {
                let place = format!("row {row} of the element `{element}`");
                let found = format!("the {name} {}", radii[row]);
                return Err(FormatError::invalid(file, place, found, "a finite number, 0 or more"));
            }
            radii.iter_mut().for_each(|radius| *radius *= factor);
            found.push((names::RADIUS.to_owned(), Values::Float(radii)));
        }
    }
    if let Some(values) = columns.take_floats(names::TRANSPARENCY) {
        found.push((names::TRANSPARENCY.to_owned(), Values::Float(values)));
    }
    take_vectors(&mut columns, &mut found);
    while let Some((name, column)) = columns.take_first() {
        let values = match column {
            Column::Float(values) => Values::Float(values),
            Column::Int(values) => Values::Int(values),
            Column::Byte(values) => Values::Int(values.into_iter().map(i32::from).collect()),
        };
        found.push((name, values));
    }
    Ok(found)
}

/// Floats called `NAME_x` and so on.
fn take_vectors(columns: &mut Columns, found: &mut Vec<(String, Values)>) {
    let stems: Vec<String> =
        columns.names().filter_map(|name| Some(name.strip_suffix("_x")?.to_owned())).collect();
    for stem in stems {
        let [x, y, z] = ["x", "y", "z"].map(|axis| format!("{stem}_{axis}"));
        let values = if ![&x, &y].iter().all(|name| columns.is_float(name)) {
            None
        } else if columns.is_float(&z) {
            take_triple(columns, [&x, &y, &z], |_| 1.0).map(Values::Vec3)
        } else {
            let (x, y) = (columns.take_floats(&x), columns.take_floats(&y));
            let pairs = x.into_iter().flatten().zip(y.into_iter().flatten());
            Some(Values::Vec2(pairs.map(Vec2::from).collect()))
        };
        found.extend(values.map(|values| (stem, values)));
    }
}

/// Three columns as one, each value over the `most` of its type; none unless all are there.
pub(crate) fn take_triple(
    columns: &mut Columns,
    names: [&str; 3],
    most: fn(Type) -> f32,
) -> Option<Vec<Vec3>> {
    if !names.iter().all(|name| columns.has(name)) {
        return None;
    }
    let mut values = vec![Vec3::ZERO; columns.rows];
    for (axis, name) in names.into_iter().enumerate() {
        let (kind, column) = columns.take(name)?;
        let most = most(kind);
        match column {
            Column::Byte(from) => put(&mut values, axis, from.into_iter().map(|v| f32::from(v) / most)),
            Column::Int(from) => put(&mut values, axis, from.into_iter().map(|v| v as f32 / most)),
            Column::Float(from) => put(&mut values, axis, from.into_iter()),
        }
    }
    Some(values)
}

fn put(values: &mut [Vec3], axis: usize, from: impl Iterator<Item = f32>) {
    values.iter_mut().zip(from).for_each(|(value, from)| value[axis] = from);
}

/// What stands for 1 in a colour of this type.
fn scale(kind: Type) -> f32 {
    match kind {
        Type::I8 => i8::MAX.into(),
        Type::U8 => u8::MAX.into(),
        Type::I16 => i16::MAX.into(),
        Type::U16 => u16::MAX.into(),
        Type::I32 => i32::MAX as f32,
        Type::U32 => u32::MAX as f32,
        Type::F32 | Type::F64 => 1.0,
    }
}
