//! Headers of objects and properties, and the table of metadata they share.

use std::collections::HashMap;

use super::property::{Changes, Content, Property, StoredSample};
use crate::{DataType, Metadata, OgawaError};

/// The index of metadata that stands in the header itself.
const INLINE: u8 = 0xff;
/// The table names fewer than 255 texts, and index 0 is no text.
const MOST: usize = 254;

/// Metadata that several headers have, said once.
#[derive(Debug, Default)]
pub(super) struct MetadataTable {
    places: HashMap<String, u8>,
    bytes: Vec<u8>,
}

impl MetadataTable {
    /// As it stands in the file: a length byte and a text, for each.
    pub(super) fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// The index of a text, or [`INLINE`] when the table has no place for it.
    fn index(&mut self, text: &str) -> u8 {
        if text.is_empty() {
            return 0;
        }
        if let Some(&place) = self.places.get(text) {
            return place;
        }
        let Ok(len) = u8::try_from(text.len()) else { return INLINE };
        if self.places.len() >= MOST {
            return INLINE;
        }
        let place = self.places.len() as u8 + 1;
        self.places.insert(text.to_owned(), place);
        self.bytes.push(len);
        self.bytes.extend_from_slice(text.as_bytes());
        place
    }
}

/// Appends the header of an object.
pub(super) fn object(
    name: &str,
    metadata: &Metadata,
    table: &mut MetadataTable,
    out: &mut Vec<u8>,
) -> Result<(), OgawaError> {
    if name.is_empty() || name.contains(['/', '\0']) {
        let (what, found) = ("object", name.to_owned());
        return Err(OgawaError::Unwritable { what, found, expected: "a name without `/` or a 0 byte" });
    }
    let text = metadata.to_text()?;
    let index = table.index(&text);
    out.extend((name.len() as u32).to_le_bytes());
    out.extend_from_slice(name.as_bytes());
    out.push(index);
    if index == INLINE {
        out.extend((text.len() as u32).to_le_bytes());
        out.extend_from_slice(text.as_bytes());
    }
    Ok(())
}

/// Appends the header of a property. Its first word, from the low bits:
///
/// ```text
/// 0-1 compound 0, scalar 1, array 2, array that holds one value in every sample 3
/// 2-3 bytes of the counts that follow: 1, 2 or 4      4-7 kind of number
/// 8 times follow    9 first and last change follow    10 all samples are of one size    11 constant
/// 12-19 numbers a value                               20-27 index of the metadata
/// ```
pub(super) fn property(
    property: &Property,
    table: &mut MetadataTable,
    out: &mut Vec<u8>,
) -> Result<(), OgawaError> {
    let name = &property.name;
    if name.is_empty() || name.contains(['/', '\0']) {
        let expected = "a name without `/` or a 0 byte";
        return Err(OgawaError::Unwritable { what: "property", found: name.clone(), expected });
    }
    let text = property.metadata.to_text()?;
    let index = table.index(&text);
    let samples = match &property.content {
        Content::Compound(_) => 0,
        Content::Scalar(_, samples) | Content::Array(_, samples) => samples.len(),
    };
    let largest = text.len().max(name.len()).max(samples).max(property.times as usize);
    let hint = Hint::for_count(largest);
    let info = (hint as u32) << 2 | u32::from(index) << 20;
    match &property.content {
        Content::Compound(_) => out.extend(info.to_le_bytes()),
        Content::Scalar(data_type, samples) => {
            let info = info | 1 | info_of(*data_type, samples, property.times);
            numbers(info, samples, property.times, hint, out);
        }
        Content::Array(data_type, samples) => {
            let one = samples.iter().all(|sample| sample.count(*data_type) == 1);
            let info = info | 2 | u32::from(one) | info_of(*data_type, samples, property.times);
            numbers(info, samples, property.times, hint, out);
        }
    }
    hint.put(name.len(), out);
    out.extend_from_slice(name.as_bytes());
    if index == INLINE {
        hint.put(text.len(), out);
        out.extend_from_slice(text.as_bytes());
    }
    Ok(())
}

/// The bits that scalars and arrays share.
fn info_of(data_type: DataType, samples: &[StoredSample], times: u32) -> u32 {
    let changes = Changes::of(samples);
    let constant = changes.last == 0;
    let alike = samples.windows(2).all(|pair| pair[0].count(data_type) == pair[1].count(data_type));
    (data_type.pod as u32) << 4
        | u32::from(data_type.extent) << 12
        | u32::from(times != 0) << 8
        | u32::from(!constant && !every_one(changes, samples)) << 9
        | u32::from(alike) << 10
        | u32::from(constant) << 11
}

/// Whether the changes are those a reader takes for granted.
fn every_one(changes: Changes, samples: &[StoredSample]) -> bool {
    changes.first == 1 && changes.last as usize + 1 == samples.len()
}

fn numbers(info: u32, samples: &[StoredSample], times: u32, hint: Hint, out: &mut Vec<u8>) {
    out.extend(info.to_le_bytes());
    hint.put(samples.len(), out);
    if info & 1 << 9 != 0 {
        let changes = Changes::of(samples);
        hint.put(changes.first as usize, out);
        hint.put(changes.last as usize, out);
    }
    if times != 0 {
        hint.put(times as usize, out);
    }
}

/// How many bytes the counts of a header take.
#[derive(Clone, Copy, Debug)]
enum Hint {
    One = 0,
    Two = 1,
    Four = 2,
}

impl Hint {
    fn for_count(largest: usize) -> Self {
        match largest {
            0..=0xff => Hint::One,
            0x100..=0xffff => Hint::Two,
            _ => Hint::Four,
        }
    }

    fn put(self, count: usize, out: &mut Vec<u8>) {
        let bytes = (count as u32).to_le_bytes();
        out.extend_from_slice(&bytes[..1 << self as usize]);
    }
}
