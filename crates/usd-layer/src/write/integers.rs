//! Runs of integers as crates pack them (OpenUSD, `pxr/usd/sdf/integerCoding.h`): differences to the one
//! before, the commonest difference first, then two bits a number that say how many bytes its difference
//! takes (0 for the commonest, 1, 2 or 4), then those bytes; all of it through LZ4.

use std::collections::HashMap;

use crate::write::WriteError;
use crate::write::compress::compress;

/// Differences up to this size are counted in a table, larger ones in a map.
const NEAR: i32 = 1 << 10;

/// `values`, packed and compressed.
pub(super) fn pack(values: impl Iterator<Item = i32> + Clone) -> Result<Vec<u8>, WriteError> {
    compress(&encode(values))
}

/// As [`pack`], for numbers that use all 32 bits.
pub(super) fn pack_unsigned(values: impl Iterator<Item = u32> + Clone) -> Result<Vec<u8>, WriteError> {
    pack(values.map(u32::cast_signed))
}

fn encode(values: impl Iterator<Item = i32> + Clone) -> Vec<u8> {
    let differences = {
        let mut before = 0_i32;
        move |value: i32| value.wrapping_sub(std::mem::replace(&mut before, value))
    };
    let Some(common) = commonest(values.clone().map(differences)) else { return Vec::new() };
    let count = values.clone().count();
    let codes_at = size_of::<i32>();
    let mut out = Vec::with_capacity(codes_at + count.div_ceil(4) + count);
    out.extend(common.to_le_bytes());
    out.resize(codes_at + count.div_ceil(4), 0);
    for (place, difference) in values.map(differences).enumerate() {
        let code = if difference == common {
            0
        } else if let Ok(byte) = i8::try_from(difference) {
            out.extend(byte.to_le_bytes());
            1
        } else if let Ok(two) = i16::try_from(difference) {
            out.extend(two.to_le_bytes());
            2
        } else {
            out.extend(difference.to_le_bytes());
            3
        };
        out[codes_at + place / 4] |= code << (2 * (place % 4));
    }
    out
}

/// The value that comes most often; the largest of several.
fn commonest(values: impl Iterator<Item = i32>) -> Option<i32> {
    let mut near = vec![0_usize; 2 * NEAR as usize + 1];
    let mut far: HashMap<i32, usize> = HashMap::new();
    for value in values {
        if (-NEAR..=NEAR).contains(&value) {
            near[(value + NEAR) as usize] += 1;
        } else {
            *far.entry(value).or_default() += 1;
        }
    }
    let near = near.into_iter().enumerate().map(|(place, count)| (count, place as i32 - NEAR));
    let all = near.chain(far.into_iter().map(|(value, count)| (count, value)));
    all.max().filter(|&(count, _)| count > 0).map(|(_, value)| value)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn the_example_of_the_format() {
        // From the comment in integerCoding.h.
        let values = [123, 124, 125, 100_125, 100_125, 100_126, 100_126];
        assert_eq!(
            encode(values.into_iter()),
            [1, 0, 0, 0, 0b11_00_00_01, 0b01_00_01, 123, 0xA0, 0x86, 1, 0, 0, 0]
        );
        assert!(encode(std::iter::empty()).is_empty());
    }

    fn decode(bytes: &[u8], count: usize) -> Vec<i32> {
        let (common, rest) = bytes.split_first_chunk::<4>().unwrap();
        let (codes, mut rest) = rest.split_at(count.div_ceil(4));
        let mut value = 0_i32;
        (0..count)
            .map(|i| {
                let mut take = |n: usize| {
                    let (taken, after) = rest.split_at(n);
                    rest = after;
                    let sign = if taken[n - 1] >= 128 { 255 } else { 0 };
                    i32::from_le_bytes(std::array::from_fn(|b| taken.get(b).copied().unwrap_or(sign)))
                };
                let difference = match codes[i / 4] >> (2 * (i % 4)) & 3 {
                    0 => i32::from_le_bytes(*common),
                    1 => take(1),
                    2 => take(2),
                    _ => take(4),
                };
                value = value.wrapping_add(difference);
                value
            })
            .collect()
    }

    proptest! {
        #[test]
        fn numbers_come_back(
            values in prop::collection::vec(prop_oneof![any::<i32>(), -3..3, -40_000..40_000], 1..200)
        ) {
            prop_assert_eq!(decode(&encode(values.iter().copied()), values.len()), values);
        }
    }
}
