//! Guides that strands follow, as Unreal's schema has them: three ids of strands and three weights a strand.

use std::io::{Seek, Write};

use groom::{Attribute, Domain, Groom, Values, names};
use ogawa::{ArchiveWriter, Compound, DataType, OgawaError};

use super::attributes::geometry;
use crate::alembic::schema;

/// The id of the guide every strand follows, where the groom says it.
pub(super) fn closest(groom: &Groom) -> Option<&[i32]> {
    match groom.attribute(names::CLOSEST_GUIDE) {
        Some(Attribute { domain: Domain::Strand, values: Values::Int(ids) }) => Some(ids),
        _ => None,
    }
}

/// Writes one guide a strand, and the ids that guides are named by if the groom has none: there a strand's id is
/// its place.
pub(super) fn write<W: Write + Seek>(
    groom: &Groom,
    ids: &[i32],
    archive: &mut ArchiveWriter<W>,
    arbitrary: &mut Compound,
) -> Result<(), OgawaError> {
    let three: Vec<[i32; 3]> = ids.iter().map(|&id| [id; 3]).collect();
    let sample = archive.values(three.as_flattened())?;
    arbitrary.push(geometry(schema::CLOSEST_GUIDES, schema::THREE_GUIDES, Domain::Strand, sample));
    let weights = vec![schema::ONE_GUIDE; ids.len()];
    let sample = archive.values(weights.as_flattened())?;
    arbitrary.push(geometry(schema::GUIDE_WEIGHTS, DataType::F32X3, Domain::Strand, sample));
    if groom.attribute(names::ID).is_none() {
        let places: Vec<i32> = (0..).take(groom.strand_count()).collect();
        let sample = archive.values(&places)?;
        arbitrary.push(geometry(schema::GROOM_ID, DataType::I32, Domain::Strand, sample));
    }
    Ok(())
}

/// Three ids a strand, which a groom keeps as fractions and Unreal wants whole; `None` where they are not.
pub(super) fn three(written: &str, values: &Values) -> Option<Vec<[i32; 3]>> {
    let Values::Vec3(values) = values else { return None };
    let whole = |v: f32| (f64::from(v as i32) == f64::from(v)).then_some(v as i32);
    let three = |v: &glam::Vec3| Some([whole(v.x)?, whole(v.y)?, whole(v.z)?]);
    if written == schema::CLOSEST_GUIDES { values.iter().map(three).collect() } else { None }
}
