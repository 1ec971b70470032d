//! Arrays of numbers, packed where that is smaller and loses no bit.
//!
//! As OpenUSD writes them (`pxr/usd/usd/crateFile.cpp`): integers as runs of differences; floats of few values
//! as a table of those and a run of places in it. Anything else lies as it does in memory.

use std::collections::HashMap;

use crate::write::WriteError;
use crate::write::integers::{pack, pack_unsigned};

/// Arrays of fewer numbers are never packed: readers do not look for it.
const FEWEST: usize = 16;
/// Most entries of a table of floats.
const LARGEST_TABLE: usize = 1024;
/// Marks a table of floats.
const TABLE: u8 = b't';

/// `values` as differences, if there are enough of them.
pub(super) fn packed_ints(values: &[i32]) -> Result<Option<Vec<u8>>, WriteError> {
    if values.len() < FEWEST {
        return Ok(None);
    }
    let mut out = Vec::new();
    sized(&mut out, &pack(values.iter().copied())?);
    Ok(Some(out))
}

/// `values` as a table and places in it, if they are few different ones.
pub(super) fn packed_floats(values: &[f32]) -> Result<Option<Vec<u8>>, WriteError> {
    let Some((table, places)) = (values.len() >= FEWEST).then(|| table_of(values)).flatten() else {
        return Ok(None);
    };
    let mut out = vec![TABLE];
    out.extend((table.len() as u32).to_le_bytes());
    out.extend(table.iter().flat_map(|value| value.to_le_bytes()));
    sized(&mut out, &pack_unsigned(places.iter().map(|&place| place.into()))?);
    Ok(Some(out))
}

/// The different bit patterns among `values`, and which of them each is; `None` when they are too many.
fn table_of(values: &[f32]) -> Option<(Vec<u32>, Vec<u16>)> {
    let largest = LARGEST_TABLE.min(values.len() / 4);
    let mut known: HashMap<u32, u16> = HashMap::new();
    let mut table = Vec::new();
    let mut places = Vec::new();
    let mut before = None;
    for value in values {
        let bits = value.to_bits();
        let place = match before {
            Some((last, place)) if last == bits => place,
            _ => *known.entry(bits).or_insert_with(|| {
                table.push(bits);
                (table.len() - 1) as u16
            }),
        };
        if table.len() > largest {
            return None;
        }
        before = Some((bits, place));
        places.push(place);
    }
    Some((table, places))
}

fn sized(out: &mut Vec<u8>, bytes: &[u8]) {
    out.extend((bytes.len() as u64).to_le_bytes());
    out.extend(bytes);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tables_keep_every_bit_or_are_not_made() {
        let nan = f32::from_bits(0x7FC0_0001);
        let few: Vec<f32> = (0..40).map(|i| [0.0, -0.0, nan, 1.5][i % 4]).collect();
        let (table, places) = table_of(&few).unwrap();
        let back: Vec<u32> = places.iter().map(|&place| table[usize::from(place)]).collect();
        assert_eq!(back, few.iter().map(|v| v.to_bits()).collect::<Vec<_>>());
        let many: Vec<f32> = (0..40).map(|i| i as f32).collect();
        assert!(table_of(&many).is_none());
        assert!(packed_floats(&few[..15]).unwrap().is_none() && packed_ints(&[1; 15]).unwrap().is_none());
    }
}
