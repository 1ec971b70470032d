//! Blocks of LZ4 and integers stored as differences: OpenUSD's `fastCompression.cpp` and `integerCoding.cpp`.

use super::bytes::Bytes;
use crate::read::ReadError;
use crate::read::budget::{self, Budget};

/// The most that LZ4 makes out of one byte.
const LZ4_RATIO: u64 = 255;

/// Reads a compressed size and block and unpacks it; it makes `size` bytes or, unless `exact`, fewer.
pub(super) fn block(
    bytes: &mut Bytes<'_>,
    size: u64,
    exact: bool,
    budget: &mut Budget,
    what: &str,
) -> Result<Vec<u8>, ReadError> {
    let at = bytes.at;
    let packed = bytes.count(1, "compressed bytes")? as u64;
    let packed = bytes.take(packed, what)?;
    // What cannot come out of so few bytes need not have room.
    let possible = (packed.len() as u64).saturating_mul(LZ4_RATIO).saturating_add(16);
    if exact && size > possible {
        let found = format!("{size} bytes of {what} in {} compressed ones", packed.len());
        return Err(ReadError::byte(at, found, format!("no more than LZ4 can hold in them, {possible}")));
    }
    let room = size.min(possible);
    budget.take(room, || too_much(at, room, what))?;
    let mut out = vec![0; room as usize];
    let broken = |found: String| ReadError::byte(at, found, format!("{what}: blocks of LZ4"));
    let len = unpack(packed, &mut out).map_err(broken)?;
    if exact && len as u64 != size {
        return Err(ReadError::byte(at, format!("{len} bytes of {what}"), size.to_string()));
    }
    out.truncate(len);
    Ok(out)
}

pub(super) fn too_much(at: u64, size: u64, what: &str) -> ReadError {
    ReadError::byte(at, format!("{size} bytes of {what}"), budget::EXPECTED)
}

/// A byte counts the chunks, 0 for one without a size of its own before it.
fn unpack(packed: &[u8], out: &mut [u8]) -> Result<usize, String> {
    let broken = |error: lz4_flex::block::DecompressError| format!("a broken block ({error})");
    let short = || "a block that ends too soon".to_owned();
    let (&chunks, mut rest) = packed.split_first().ok_or_else(short)?;
    if chunks == 0 {
        return lz4_flex::block::decompress_into(rest, out).map_err(broken);
    }
    let mut done = 0;
    for _ in 0..chunks {
        let (size, after) = rest.split_first_chunk::<4>().ok_or_else(short)?;
        let size = u32::from_le_bytes(*size) as usize;
        let chunk = after.get(..size).ok_or_else(short)?;
        rest = &after[size..];
        done += lz4_flex::block::decompress_into(chunk, &mut out[done..]).map_err(broken)?;
    }
    Ok(done)
}

/// Whole numbers of 32 or 64 bits.
pub(super) trait Coded: Copy + Default {
    /// Bytes of a number, and of the differences of the three kinds.
    const SIZE: usize;
    /// The number in little-endian bytes, sign kept; as many as the code says.
    fn read(bytes: &[u8]) -> Self;
    fn plus(self, other: Self) -> Self;
}

impl Coded for i32 {
    const SIZE: usize = 4;
    #[inline]
    fn read(bytes: &[u8]) -> Self {
        match *bytes {
            [a] => i32::from(a as i8),
            [a, b] => i32::from(i16::from_le_bytes([a, b])),
            [a, b, c, d] => i32::from_le_bytes([a, b, c, d]),
            _ => 0,
        }
    }
    #[inline]
    fn plus(self, other: Self) -> Self {
        self.wrapping_add(other)
    }
}

impl Coded for i64 {
    const SIZE: usize = 8;
    #[inline]
    fn read(bytes: &[u8]) -> Self {
        match *bytes {
            [a, b] => i64::from(i16::from_le_bytes([a, b])),
            [a, b, c, d] => i64::from(i32::from_le_bytes([a, b, c, d])),
            [a, b, c, d, e, f, g, h] => i64::from_le_bytes([a, b, c, d, e, f, g, h]),
            _ => 0,
        }
    }
    #[inline]
    fn plus(self, other: Self) -> Self {
        self.wrapping_add(other)
    }
}

/// Reads `count` numbers stored as differences: the commonest one, two bits a number for how many bytes its
/// difference takes (none: the commonest), then the differences.
pub(super) fn integers<T: Coded>(
    bytes: &mut Bytes<'_>,
    count: usize,
    budget: &mut Budget,
    what: &str,
) -> Result<Vec<T>, ReadError> {
    let at = bytes.at;
    let codes = (count as u64).div_ceil(4);
    let whole = (T::SIZE as u64).saturating_mul(count as u64);
    budget.take(whole, || too_much(at, whole, what))?;
    let packed =
        block(bytes, whole.saturating_add(codes).saturating_add(T::SIZE as u64), false, budget, what)?;
    if count == 0 {
        return Ok(Vec::new());
    }
    let short = || {
        let found = format!("{} unpacked bytes", packed.len());
        ReadError::byte(at, found, format!("differences of {count} {what}"))
    };
    let (common, rest) = packed.split_at_checked(T::SIZE).ok_or_else(short)?;
    let (codes, mut rest) = rest.split_at_checked(codes as usize).ok_or_else(short)?;
    let common = T::read(common);
    let mut value = T::default();
    let mut out = Vec::with_capacity(count);
    for place in 0..count {
        let code = (codes[place / 4] >> (2 * (place % 4))) & 3;
        let difference = if code == 0 {
            common
        } else {
            let (difference, after) = rest.split_at_checked(T::SIZE >> (3 - code)).ok_or_else(short)?;
            rest = after;
            T::read(difference)
        };
        value = value.plus(difference);
        out.push(value);
    }
    Ok(out)
}
