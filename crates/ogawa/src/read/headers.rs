//! Headers of objects and properties.

use super::cursor::Cursor;
use super::group::Group;
use crate::{DataType, MetadataText, OgawaError, Pod};

/// Bytes of the two digests after the headers of an object's children.
const DIGESTS: usize = 32;
/// The index of metadata that stands in the header itself.
const INLINE: u32 = 0xff;
const OBJECT: &str = "header of an object";
const PROPERTY: &str = "header of a property";

/// The headers of an object's children.
pub(super) fn of_objects(group: Group<'_>) -> Result<Cursor<'_>, OgawaError> {
    let empty = Cursor::new(&[], group.offset);
    let Some(data) = group.last_data(OBJECT)? else { return Ok(empty) };
    let headers = data.bytes.len().checked_sub(DIGESTS).and_then(|len| data.bytes.get(..len));
    Ok(headers.map_or(empty, |bytes| Cursor::new(bytes, data.offset)))
}

/// The name and the metadata of the next object.
pub(super) fn object<'a>(
    cursor: &mut Cursor<'a>,
    table: &[MetadataText<'a>],
) -> Result<(&'a str, MetadataText<'a>), OgawaError> {
    let len = cursor.u32(OBJECT)?;
    let name = cursor.text(len.into(), OBJECT)?;
    let index = u32::from(cursor.u8(OBJECT)?);
    Ok((name, metadata(cursor, index, 2, table, OBJECT)?))
}

/// What the header of a property says.
#[derive(Clone, Copy, Debug)]
pub(super) struct PropertyHeader<'a> {
    pub(super) name: &'a str,
    pub(super) metadata: MetadataText<'a>,
    /// `None` for a compound.
    pub(super) values: Option<ValuesHeader>,
}

/// What the header of a scalar or an array says.
#[derive(Clone, Copy, Debug)]
pub(super) struct ValuesHeader {
    pub(super) is_array: bool,
    pub(super) data_type: DataType,
    pub(super) samples: u32,
    /// The first sample unlike the one before it; 0 when all are alike.
    pub(super) first_change: u32,
    /// The last such sample.
    pub(super) last_change: u32,
    /// Index of the archive's times.
    pub(super) times: u32,
}

/// The headers of a compound's properties.
pub(super) fn of_properties(group: Group<'_>) -> Result<Cursor<'_>, OgawaError> {
    let data = group.last_data(PROPERTY)?;
    Ok(data.map_or(Cursor::new(&[], group.offset), |data| data.cursor()))
}

/// The next property; [`crate::Property`] writes it and has a picture of its first word.
pub(super) fn property<'a>(
    cursor: &mut Cursor<'a>,
    table: &[MetadataText<'a>],
) -> Result<PropertyHeader<'a>, OgawaError> {
    let info = cursor.u32(PROPERTY)?;
    let hint = info >> 2 & 3;
    let values = if info & 3 == 0 { None } else { Some(values(cursor, info, hint)?) };
    let len = cursor.hinted(hint, PROPERTY)?;
    let name = cursor.text(len.into(), PROPERTY)?;
    let metadata = metadata(cursor, info >> 20 & 0xff, hint, table, PROPERTY)?;
    Ok(PropertyHeader { name, metadata, values })
}

fn values(cursor: &mut Cursor<'_>, info: u32, hint: u32) -> Result<ValuesHeader, OgawaError> {
    let (code, extent) = (info >> 4 & 0xf, (info >> 12 & 0xff) as u8);
    let offset = cursor.offset();
    let invalid = |found: String, expected| OgawaError::invalid(offset, PROPERTY, found, expected);
    let pod = Pod::from_code(code).ok_or_else(|| invalid(format!("kind of number {code}"), "0 to 13"))?;
    if extent == 0 {
        return Err(invalid("0 numbers a value".into(), "1 or more"));
    }
    let samples = cursor.hinted(hint, PROPERTY)?;
    let (first_change, last_change) = if info & 1 << 9 != 0 {
        (cursor.hinted(hint, PROPERTY)?, cursor.hinted(hint, PROPERTY)?)
    } else if info & 1 << 11 != 0 {
        (0, 0)
    } else {
        (1, samples.saturating_sub(1))
    };
    let times = if info & 1 << 8 != 0 { cursor.hinted(hint, PROPERTY)? } else { 0 };
    let (is_array, data_type) = (info & 3 != 1, DataType { pod, extent });
    Ok(ValuesHeader { is_array, data_type, samples, first_change, last_change, times })
}

fn metadata<'a>(
    cursor: &mut Cursor<'a>,
    index: u32,
    hint: u32,
    table: &[MetadataText<'a>],
    what: &'static str,
) -> Result<MetadataText<'a>, OgawaError> {
    if index == INLINE {
        let len = cursor.hinted(hint, what)?;
        return Ok(MetadataText(cursor.text(len.into(), what)?));
    }
    table.get(index as usize).copied().ok_or_else(|| {
        let expected = format!("less than {}", table.len());
        OgawaError::invalid(cursor.offset(), what, format!("metadata {index}"), expected)
    })
}
