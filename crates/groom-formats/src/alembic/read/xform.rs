//! Transforms above curves (`AbcGeom_Xform_v3`).

use glam::{DMat4, DVec3};
use ogawa::{CompoundReader, OgawaError};

use super::tree::Tree;
use super::values::Samples;
use crate::alembic::schema;

/// What brings a node's points into the archive's space.
pub(super) fn world_from_node(tree: &Tree<'_>, node: usize, samples: &Samples) -> Result<DMat4, OgawaError> {
    let mut world = DMat4::IDENTITY;
    let mut next = Some(node);
    while let Some(node) = next.and_then(|node| tree.nodes.get(node)) {
        next = node.parent;
        if let Some(xform) = node.xform {
            world = matrix(xform, samples)? * world;
            if !inherits(xform, samples)? {
                break;
            }
        }
    }
    Ok(world)
}

/// Whether what is above a transform moves it too.
fn inherits(xform: CompoundReader<'_>, samples: &Samples) -> Result<bool, OgawaError> {
    let Some(inherits) = xform.find(schema::INHERITS)?.filter(|inherits| inherits.sample_count() > 0) else {
        return Ok(true);
    };
    Ok(samples.held(&inherits)?.bytes().first() != Some(&0))
}

/// The operations of a transform one after another, the last first upon a point.
fn matrix(xform: CompoundReader<'_>, samples: &Samples) -> Result<DMat4, OgawaError> {
    let (Some(ops), Some(vals)) = (xform.find(schema::OPERATIONS)?, xform.find(schema::CHANNELS)?) else {
        return Ok(DMat4::IDENTITY);
    };
    if ops.sample_count() == 0 || vals.sample_count() == 0 {
        return Ok(DMat4::IDENTITY);
    }
    let moment = samples.moment(&vals)?;
    let sample = vals.sample(moment.before)?;
    samples.spend(2 * 8 * sample.len() * usize::from(sample.data_type().extent), ".vals")?;
    let mut numbers = sample.to_f64()?;
    if moment.blend > 0.0 {
        let after = vals.sample(moment.after)?.to_f64()?;
        numbers.iter_mut().zip(after).for_each(|(a, b)| *a += (b - *a) * moment.blend);
    }
    let mut rest = &numbers[..];
    let mut matrix = DMat4::IDENTITY;
    for &op in ops.sample(0)?.bytes() {
        let len = channels(op);
        let taken = len.and_then(|len| rest.split_at_checked(len));
        let Some((channels, after)) = taken else {
            return Err(OgawaError::Property {
                name: ".ops".into(),
                found: format!("operation {op} with {} numbers left", rest.len()),
                expected: "a scale, translation, rotation or matrix and its numbers".into(),
            });
        };
        rest = after;
        matrix *= operation(op, channels);
    }
    Ok(matrix)
}

/// Numbers of an operation: its kind is in the upper four bits, a hint to artists in the lower.
fn channels(op: u8) -> Option<usize> {
    match op >> 4 {
        0 | 1 => Some(3),
        2 => Some(4),
        3 => Some(16),
        4..=6 => Some(1),
        _ => None,
    }
}

fn operation(op: u8, v: &[f64]) -> DMat4 {
    match (op >> 4, v) {
        (0, &[x, y, z]) => DMat4::from_scale(DVec3::new(x, y, z)),
        (1, &[x, y, z]) => DMat4::from_translation(DVec3::new(x, y, z)),
        (2, &[x, y, z, degrees]) => {
            let axis = DVec3::new(x, y, z).try_normalize();
            axis.map_or(DMat4::IDENTITY, |axis| DMat4::from_axis_angle(axis, degrees.to_radians()))
        }
        // Rows for points that are rows are columns for points that are columns.
        (3, v) => v.try_into().map_or(DMat4::IDENTITY, |v: &[f64; 16]| DMat4::from_cols_array(v)),
        (4, &[degrees]) => DMat4::from_rotation_x(degrees.to_radians()),
        (5, &[degrees]) => DMat4::from_rotation_y(degrees.to_radians()),
        (6, &[degrees]) => DMat4::from_rotation_z(degrees.to_radians()),
        _ => DMat4::IDENTITY,
    }
}
