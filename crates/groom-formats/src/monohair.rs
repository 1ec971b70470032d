//! MonoHair's strands, read: a layout of its own in files that also end in `.hair`.
//!
//! | bytes | what |
//! |---|---|
//! | `u32` | number of strands |
//! | `u32` | number of points |
//! | `u16` for every strand | its number of **points** (HAIR counts segments) |
//! | `f32 x y z` for every point | root first |
//!
//! Little endian, without a magic; `save_hair_strands` and `load_strand` in MonoHair's `Utils.py`. No unit and no
//! axis are in the file; MonoHair's head stands upright in y and is in metres, and so is this read.

use groom::UpAxis;

use crate::assemble::{self, Parts};
use crate::bytes::{self, Bytes};
use crate::{Format, FormatError, Loaded, ReadOptions, Warning};

/// Said in every fault, for the file may be a broken one of another kind.
const TAKEN_FOR: &str = "(without HAIR's magic, the file is taken for MonoHair's)";

pub(crate) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let mut rest = Bytes::new(name, bytes);
    let strands = rest.count("the number of strands", 2)?;
    let points = rest.count("the number of points", 12)?;
    let counts_at = rest.at();
    let counts =
        rest.take(2 * u64::from(strands), format_args!("point counts of {strands} strands {TAKEN_FOR}"))?;
    let mut offsets = Vec::with_capacity(strands as usize + 1);
    offsets.push(0);
    let mut sum = 0;
    for count in counts.chunks_exact(2) {
        sum += usize::from(u16::from_le_bytes([count[0], count[1]]));
        offsets.push(assemble::offset(sum, Format::MonoHair, name)?);
    }
    if sum != points as usize {
        let found = format!("point counts that add up to {sum}");
        return Err(rest.fault(counts_at, found, format!("{points}, the number of points {TAKEN_FOR}")));
    }
    let points_at = rest.at();
    let points = rest.take(12 * u64::from(points), format_args!("{points} points {TAKEN_FOR}"))?;
    let warnings = match rest.left() {
        0 => Vec::new(),
        bytes => vec![Warning::TrailingBytes { offset: rest.at() as u64, bytes: bytes as u64 }],
    };
    let parts = Parts {
        file: name,
        format: Format::MonoHair,
        up_axis: UpAxis::Y,
        offsets,
        positions: bytes::points(points, 12).collect(),
        attributes: Vec::new(),
        warnings,
    };
    parts.load(options, |point| format!("byte {} (point {point})", points_at + 12 * point))
}
