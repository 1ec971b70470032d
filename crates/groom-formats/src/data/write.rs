//! A groom as USC hair data.

use std::io::Write;

use glam::Vec3;
use groom::{Groom, UpAxis};

use crate::bytes::write_points;
use crate::{Format, FormatError, Warning, WriteOptions, unstored};

/// As much as the format's integers can count.
const MOST: u64 = i32::MAX as u64;

pub(crate) fn write(
    groom: &Groom,
    stream: &mut impl Write,
    name: &str,
    _options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    if groom.strand_count() == 0 {
        return Err(FormatError::Empty { file: name.to_owned(), format: Format::Data, points: 1 });
    }
    let mut writer = DataWriter::begin(stream, name, groom.strand_count() as u64)?;
    for points in groom.strands() {
        writer.push(points)?;
    }
    writer.finish()?;
    Ok(warnings(groom))
}

/// What a file of this groom's strands does not hold.
pub(crate) fn warnings(groom: &Groom) -> Vec<Warning> {
    let mut warnings = unstored::axis_and_unit(groom, Format::Data, UpAxis::Y);
    unstored::left_out(groom, Format::Data, &[], &mut warnings);
    warnings
}

/// Writes strands as they come; only their number must be known before.
pub(crate) struct DataWriter<'a, W: Write> {
    stream: &'a mut W,
    file: &'a str,
    strands: u64,
    pushed: u64,
}

impl<'a, W: Write> DataWriter<'a, W> {
    /// Starts a file of `strands` strands; `file` stands for it in messages.
    ///
    /// The stream should be buffered.
    pub(crate) fn begin(stream: &'a mut W, file: &'a str, strands: u64) -> Result<Self, FormatError> {
        let mut writer = DataWriter { stream, file, strands, pushed: 0 };
        let count = writer.counted(strands, "strands")?;
        writer.put(&count)?;
        Ok(writer)
    }

    /// Writes the next strand.
    pub(crate) fn push(&mut self, points: &[Vec3]) -> Result<(), FormatError> {
        let count = self.counted(points.len() as u64, "points of a strand")?;
        self.put(&count)?;
        self.pushed += 1;
        write_points(self.stream, points).map_err(|e| FormatError::io(self.file, e))
    }

    /// Holds the strands that came against those that were promised.
    pub(crate) fn finish(self) -> Result<(), FormatError> {
        if self.pushed == self.strands {
            return Ok(());
        }
        let found = format!("{} strands", self.pushed);
        Err(FormatError::invalid(self.file, "byte 0", found, format!("the {} promised", self.strands)))
    }

    fn put(&mut self, bytes: &[u8]) -> Result<(), FormatError> {
        self.stream.write_all(bytes).map_err(|e| FormatError::io(self.file, e))
    }

    fn counted(&self, found: u64, what: &'static str) -> Result<[u8; 4], FormatError> {
        if found > MOST {
            let (file, format) = (self.file.to_owned(), Format::Data);
            return Err(FormatError::TooLarge { file, format, what, found, limit: MOST });
        }
        Ok((found as u32).to_le_bytes())
    }
}
