//! The place that points are measured from, as a transform above their curves.

use std::io::{Seek, Write};

use glam::DVec3;
use ogawa::{ArchiveWriter, Compound, DataType, Metadata, Object, OgawaError, Pod, Property};

use crate::alembic::schema;

/// The transform's object.
const OBJECT: &str = "origin";

/// `object` below a transform that puts it at `origin`; itself where that is nowhere else.
pub(super) fn place<W: Write + Seek>(
    object: Object,
    origin: DVec3,
    archive: &mut ArchiveWriter<W>,
) -> Result<Object, OgawaError> {
    if origin == DVec3::ZERO {
        return Ok(object);
    }
    let yes = archive.values(&[1_u8])?;
    let truth = DataType::new(Pod::Bool, 1);
    let operations = archive.values(&[schema::TRANSLATE])?;
    let channels = archive.values(&origin.to_array())?;
    let mut xform = Compound::new();
    for (name, data_type, sample) in [
        (schema::INHERITS, truth, yes),
        (schema::OPERATIONS, DataType::U8, operations),
        (schema::CHANNELS, DataType::new(Pod::F64, 3), channels),
        (schema::NOT_IDENTITY, truth, yes),
    ] {
        xform.push(Property::scalar(name, data_type, Metadata::new()).with(sample));
    }
    let (of_object, of_xform) = schema::xform();
    let mut placed = Object::new(OBJECT, of_object);
    placed.properties.push(Property::compound(schema::XFORM_COMPOUND, of_xform, xform));
    placed.children.push(object);
    Ok(placed)
}
