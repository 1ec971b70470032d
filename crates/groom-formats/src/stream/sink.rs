//! Formats that take strands in pieces.

use std::io::{Seek, Write};

use groom::Groom;

#[cfg(feature = "data")]
use crate::data::write::{self as data, DataWriter};
use crate::hair::HairSink;
use crate::{Format, FormatError, HairExtras, Warning};

/// What a file's head may have to say before the first strand is there.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Counts {
    pub(crate) strands: u32,
    pub(crate) points: u32,
}

/// A file being written from blocks of strands in order, all of them with the same attributes.
pub(crate) trait Sink {
    /// Writes the strands of `block`, whose values are checked.
    fn push(&mut self, block: &Groom) -> Result<(), FormatError>;

    /// Writes what is left to write; tells what the format could not hold.
    fn finish(self: Box<Self>) -> Result<Vec<Warning>, FormatError>;
}

/// Whether `format` can be written in pieces, to a file that can go back or to one that cannot.
pub(crate) fn takes_pieces(format: Format, can_seek: bool) -> bool {
    match format {
        Format::Hair => can_seek,
        Format::Text => cfg!(feature = "text"),
        Format::Data => cfg!(feature = "data"),
        Format::Ply => cfg!(feature = "ply"),
        _ => false,
    }
}

/// Whether the head of a file says if 8 bits hold every colour, so that all must be seen before the first
/// strand is written.
pub(crate) fn asks_about_colors(format: Format) -> bool {
    format == Format::Ply
}

/// Whether 8 bits hold every colour of a block.
#[cfg_attr(not(feature = "ply"), allow(unused_variables))]
pub(crate) fn colors_are_bytes(block: &Groom) -> bool {
    #[cfg(feature = "ply")]
    return crate::ply::colors_are_bytes(block);
    #[cfg(not(feature = "ply"))]
    true
}

/// Begins a file of a format that [`takes_pieces`]; `like` has the attributes of all blocks, and
/// `colors_are_bytes` says of them all what [`asks_about_colors`] asks.
pub(crate) fn begin<'a, W: Write + Seek>(
    format: Format,
    stream: &'a mut W,
    name: &'a str,
    counts: Counts,
    extras: &HairExtras,
    like: &Groom,
    colors_are_bytes: bool,
) -> Result<Box<dyn Sink + 'a>, FormatError> {
    Ok(match format {
        Format::Hair => Box::new(HairSink::begin(stream, name, counts, extras, like)?),
        #[cfg(feature = "text")]
        Format::Text => Box::new(TextSink { stream, name, warnings: None }),
        #[cfg(feature = "data")]
        Format::Data => Box::new(DataSink {
            writer: DataWriter::begin(stream, name, counts.strands.into())?,
            warnings: data::warnings(like),
        }),
        #[cfg(feature = "ply")]
        Format::Ply => {
            let counts = (counts.strands.into(), counts.points.into());
            Box::new(crate::ply::PlySink::begin(stream, name, counts, like, colors_are_bytes)?)
        }
        _ => {
            let what = "cannot be written strand by strand";
            return Err(FormatError::Unsupported { file: name.to_owned(), format, what });
        }
    })
}

#[cfg(feature = "text")]
struct TextSink<'a, W> {
    stream: &'a mut W,
    name: &'a str,
    /// Those of the first block, which are those of all.
    warnings: Option<Vec<Warning>>,
}

#[cfg(feature = "text")]
impl<W: Write> Sink for TextSink<'_, W> {
    fn push(&mut self, block: &Groom) -> Result<(), FormatError> {
        let first = self.warnings.is_none();
        let warnings = crate::text::write_strands(block, first, self.stream, self.name)?;
        self.warnings.get_or_insert(warnings);
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<Vec<Warning>, FormatError> {
        Ok(self.warnings.unwrap_or_default())
    }
}

#[cfg(feature = "data")]
struct DataSink<'a, W: Write> {
    writer: DataWriter<'a, W>,
    warnings: Vec<Warning>,
}

#[cfg(feature = "data")]
impl<W: Write> Sink for DataSink<'_, W> {
    fn push(&mut self, block: &Groom) -> Result<(), FormatError> {
        block.strands().try_for_each(|points| self.writer.push(points))
    }

    fn finish(self: Box<Self>) -> Result<Vec<Warning>, FormatError> {
        self.writer.finish()?;
        Ok(self.warnings)
    }
}

#[cfg(feature = "ply")]
impl<W: Write> Sink for crate::ply::PlySink<'_, W> {
    fn push(&mut self, block: &Groom) -> Result<(), FormatError> {
        crate::ply::PlySink::push(self, block)
    }

    fn finish(self: Box<Self>) -> Result<Vec<Warning>, FormatError> {
        // A HAIR file has nothing a strand.
        self.finish_with(|_, _| {})
    }
}
