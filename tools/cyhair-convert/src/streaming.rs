//! Conversions block by block, in memory that does not grow with the strands.

use std::path::Path;

use anyhow::Result;
use command_line::progress_bar;
use groom_formats::{Format, Streamed, WriteOptions, convert_streaming_with};

use crate::args::{Args, is_stream};
use crate::report::Done;
use crate::store::{clear, size};

/// Converts so, if the pair of formats allows it and no option asks for the whole groom at once.
pub(crate) fn convert(input: &Path, output: &Path, format: Format, args: &Args) -> Result<Option<Done>> {
    let by_ending = |path, format| !is_stream(path) && Format::from_path(path) == Some(format);
    let asked = args.input_format()?;
    if !by_ending(input, asked)
        || !by_ending(output, format)
        || args.edits()
        || args.measuring.report.is_some()
    {
        return Ok(None);
    }
    let read = args.reading.options();
    // Only a HAIR file can be read so, and its header says how much there is; bytes are as good a guess.
    let bar = progress_bar(size(input), "converting");
    let per_point = 12;
    let streamed = convert_streaming_with(input, output, &read, &WriteOptions::default(), |block, _| {
        bar.inc(per_point * block.point_count() as u64);
        Ok::<_, anyhow::Error>(block)
    })?;
    bar.finish();
    let Some(Streamed { strands, points, odd, lost }) = streamed else { return Ok(None) };
    clear(output, format);
    let mut done = Done::new(input.display().to_string(), asked, size(input), output, format);
    done.tell(&[], &odd, args.json)?;
    done.finish(strands, points, size(output), &lost);
    Ok(Some(done))
}
