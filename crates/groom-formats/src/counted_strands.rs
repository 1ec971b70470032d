//! Strands that each start with their number of points: what USC's `.data` and CT2Hair's `.bin` share.
//!
//! `i32 strands`, then for every strand `i32 points` and `points` records of as many bytes each; little endian.
//! Both makers' loaders read it so (`load_usc_data_strands` and `load_bin_strands` in CT2Hair's
//! `datautils.py`, `data.cpp` and `bin.cpp` in hairutil).

use crate::bytes::Bytes;
use crate::{Format, FormatError, Warning, assemble};

/// A file whose counts were held against its bytes.
pub(crate) struct CountedStrands<'a> {
    bytes: Bytes<'a>,
    stride: usize,
    strands: u32,
    /// Where every strand starts among all points, and their number.
    pub(crate) offsets: Vec<u32>,
    /// What is odd about the file.
    pub(crate) warnings: Vec<Warning>,
}

impl<'a> CountedStrands<'a> {
    /// Goes through the counts; records have `stride` bytes.
    pub(crate) fn new(
        file: &'a str,
        bytes: &'a [u8],
        stride: usize,
        format: Format,
    ) -> Result<Self, FormatError> {
        let mut rest = Bytes::new(file, bytes);
        let strands = rest.count("the number of strands", 4)?;
        let start = rest.clone();
        // Every strand has four bytes at least: no more than the file's size.
        let mut offsets = Vec::with_capacity(strands as usize + 1);
        offsets.push(0);
        let mut points = 0;
        for strand in 0..strands {
            let count = rest.count(format_args!("the number of points of strand {strand}"), stride as u64)?;
            rest.take(u64::from(count) * stride as u64, "points")?;
            points += count as usize;
            offsets.push(assemble::offset(points, format, file)?);
        }
        let warnings = match rest.left() {
            0 => Vec::new(),
            bytes => vec![Warning::TrailingBytes { offset: rest.at() as u64, bytes: bytes as u64 }],
        };
        Ok(CountedStrands { bytes: start, stride, strands, offsets, warnings })
    }

    /// How many points all strands have together.
    pub(crate) fn points(&self) -> usize {
        self.offsets.last().map_or(0, |&points| points as usize)
    }

    /// The records of every strand in turn.
    pub(crate) fn records(&self) -> impl Iterator<Item = &'a [u8]> {
        let (mut rest, stride) = (self.bytes.clone(), self.stride);
        (0..self.strands).map_while(move |_| {
            let count = rest.u32("").ok()?;
            rest.take(u64::from(count) * stride as u64, "").ok()
        })
    }

    /// Where point `index` is in the file, in words.
    pub(crate) fn place(&self, index: usize) -> String {
        let strand = self.offsets.partition_point(|&offset| offset as usize <= index);
        let byte = self.bytes.at() + 4 * strand + self.stride * index;
        format!("byte {byte} (strand {})", strand.saturating_sub(1))
    }
}
