//! From a HAIR file to another file, block by block.

use std::fs::File;
use std::io::{BufWriter, Read, Seek, SeekFrom, Write};
use std::path::Path;

use groom::Groom;

use crate::hair::Blocks;
use crate::output::is_device;
use crate::stream::sink::{self, Counts};
use crate::{Format, FormatError, Output, ReadOptions, Warning, WriteOptions, check};

/// Bytes gathered before the system is asked to write them.
const BUFFER: usize = 1 << 18;

/// What was converted block by block.
#[derive(Clone, Debug, PartialEq)]
pub struct Streamed {
    /// Strands of the file.
    pub strands: u64,
    /// Points of all strands.
    pub points: u64,
    /// What is odd about the input, as [`Loaded::warnings`](crate::Loaded::warnings).
    pub odd: Vec<Warning>,
    /// What the output could not hold, as [`write`](crate::write()) returns it.
    pub lost: Vec<Warning>,
}

/// Converts the HAIR file at `input` to `output` in memory that does not grow with the number of strands, if
/// the pair can be converted so: HAIR to HAIR, text, `.data` or PLY.
///
/// `None` says that it cannot, and nothing was done: another pair of formats, an input or (for HAIR and PLY)
/// an output that cannot go back, mending asked for. Bytes and warnings are those of [`read`](crate::read())
/// followed by [`write`](crate::write()), which is given what the HAIR file holds beside the groom
/// ([`Loaded::hair`](crate::Loaded::hair)) unless `write` has its own.
///
/// # Errors
/// [`FormatError`]; the old file at `output`, if any, is then untouched.
pub fn convert_streaming(
    input: &Path,
    output: &Path,
    read: &ReadOptions,
    write: &WriteOptions,
) -> Result<Option<Streamed>, FormatError> {
    convert_streaming_with(input, output, read, write, |block, _| Ok(block))
}

/// As [`convert_streaming`], with a change to every block of strands on the way.
///
/// `edit` gets some strands as a groom, and the index of the first of them in the whole file. What it gives
/// back must have as many strands, as many points in each, and for every block the same attributes on the same
/// domains. It runs once a block of about 32,000 points, and for PLY with a colour array once more before: the
/// head of that file says whether 8 bits hold the colours.
///
/// # Errors
/// [`FormatError`], and what `edit` returns.
pub fn convert_streaming_with<E: From<FormatError>>(
    input: &Path,
    output: &Path,
    read: &ReadOptions,
    write: &WriteOptions,
    mut edit: impl FnMut(Groom, u64) -> Result<Groom, E>,
) -> Result<Option<Streamed>, E> {
    let (Some(Format::Hair), Some(format)) = (Format::from_path(input), Format::from_path(output)) else {
        return Ok(None);
    };
    let name = input.display().to_string();
    let asks_more = read.repair || write.quantize.is_some();
    if asks_more || !sink::takes_pieces(format, !is_device(output)) {
        return Ok(None);
    }
    let Some(file) = open_hair(input, &name)? else { return Ok(None) };
    let blocks = Blocks::new(file, &name, read)?;
    let header = *blocks.header();
    let extras = write.hair.unwrap_or_else(|| blocks.extras());
    if extras.segments_array != blocks.extras().segments_array {
        return Ok(None);
    }
    let output_name = output.display().to_string();
    let mut colors_are_bytes = true;
    if sink::asks_about_colors(format) && header.has(cyhair::Field::Colors) {
        let Some(file) = open_hair(input, &name)? else { return Ok(None) };
        let blocks = Blocks::new(file, &name, read)?;
        let mut source = Edited { blocks, edit: &mut edit, output: &output_name, strands: 0, points: 0 };
        while let Some(block) = source.next()?.filter(|_| colors_are_bytes) {
            colors_are_bytes = sink::colors_are_bytes(&block);
        }
    } else {
        colors_are_bytes = false;
    }
    let mut source = Edited { blocks, edit, output: &output_name, strands: 0, points: 0 };
    // There is one: HAIR files without strands are refused.
    let Some(mut block) = source.next()? else { return Ok(None) };

    let mut file = Output::create(output)?;
    let mut stream = BufWriter::with_capacity(BUFFER, &mut file);
    let counts = Counts { strands: header.hair_count, points: header.point_count };
    let mut sink = sink::begin(format, &mut stream, &output_name, counts, &extras, &block, colors_are_bytes)?;
    loop {
        sink.push(&block)?;
        let Some(next) = source.next()? else { break };
        block = next;
    }
    let lost = sink.finish()?;
    stream.flush().map_err(|e| FormatError::io(&output_name, e))?;
    drop(stream);
    file.commit()?;
    let Edited { blocks, strands, points, .. } = source;
    Ok(Some(Streamed { strands, points, odd: blocks.warnings(), lost }))
}

/// Blocks of strands as they should be written.
struct Edited<'a, R, F> {
    blocks: Blocks<'a, R>,
    edit: F,
    output: &'a str,
    /// Strands and points that came.
    strands: u64,
    points: u64,
}

impl<R: Read + Seek, F> Edited<'_, R, F> {
    fn next<E: From<FormatError>>(&mut self) -> Result<Option<Groom>, E>
    where
        F: FnMut(Groom, u64) -> Result<Groom, E>,
    {
        let Some(block) = self.blocks.next()? else { return Ok(None) };
        let counts = |groom: &Groom| (groom.strand_count(), groom.point_count());
        let before = counts(&block);
        let block = (self.edit)(block, self.strands)?;
        if counts(&block) != before {
            let said = |(strands, points)| format!("{strands} strands of {points} points");
            let place = format!("the edit of the strands from {}", self.strands);
            return Err(FormatError::invalid(self.output, place, said(counts(&block)), said(before)).into());
        }
        check::values(&block, self.output).map_err(|error| self.in_whole_file(error))?;
        self.strands += before.0 as u64;
        self.points += before.1 as u64;
        Ok(Some(block))
    }

    /// An error with places in the block, as one with places in the file.
    fn in_whole_file(&self, error: FormatError) -> FormatError {
        match error {
            FormatError::Value { file, what, strand, vertex, found, expected } => {
                let (strand, vertex) = (strand + self.strands as usize, vertex + self.points as usize);
                FormatError::Value { file, what, strand, vertex, found, expected }
            }
            other => other,
        }
    }
}

/// The file, unless its first bytes say that it is something else than HAIR or it cannot go back.
fn open_hair(path: &Path, name: &str) -> Result<Option<File>, FormatError> {
    let fault = |e| FormatError::io(name, e);
    let mut file = File::open(path).map_err(fault)?;
    if !file.metadata().map_err(fault)?.is_file() {
        return Ok(None);
    }
    let mut head = Vec::new();
    (&file).take(crate::read::HEAD).read_to_end(&mut head).map_err(fault)?;
    file.seek(SeekFrom::Start(0)).map_err(fault)?;
    Ok((Format::Hair.sniff(&head) == Format::Hair).then_some(file))
}
