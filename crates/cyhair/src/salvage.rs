//! Reading a file that lies, as far as the truth is plain.

use std::io::Read;

use crate::file::{read_array, read_header};
use crate::source::Source;
use crate::{Field, HairError, HairFile, Header, Layout, Repair, Value, check};

/// A file that was mended while it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Repaired {
    /// The file, which a strict reader takes without a warning (but for a missing points array).
    pub file: HairFile,
    /// What was done; empty for a clean file.
    pub repairs: Vec<Repair>,
}

impl HairFile {
    /// Reads a file and mends what can be: everything [`HairFile::repair`] mends, trailing bytes, a
    /// file cut off inside its arrays, and one wrong count where the other counts and the length of
    /// the file leave only one way it can be right.
    ///
    /// Takes memory for the whole stream as it arrives, and for the arrays once more.
    ///
    /// # Errors
    /// [`HairError`] for what cannot be mended: no magic, no strands (left), a file cut off inside
    /// the header or the segments, counts that contradict each other in more than one way.
    pub fn read_and_repair(mut reader: impl Read) -> Result<Repaired, HairError> {
        let mut bytes = Vec::new();
        let io = |source| HairError::Io { field: Field::Magic, offset: 0, source };
        reader.read_to_end(&mut bytes).map_err(io)?;
        let len = bytes.len() as u64;
        let mut source = Source::new(&bytes[..], Some(len));
        let mut header = read_header(&mut source)?;
        if header.hair_count == 0 {
            return Err(HairError::NoStrands);
        }
        let mut repairs = Vec::new();
        let segments = read_array(&mut source, &header.layout(), Field::Segments, |_, _| Ok(()))?;
        mend_counts(&mut header, segments.as_deref(), len, &mut repairs)?;
        let promised = header.layout().end;
        drop_cut_arrays(&mut header, len, &mut repairs);
        let layout = header.layout();
        let mut file = HairFile {
            header,
            segments,
            points: values(&bytes, &layout, Field::Points),
            thickness: values(&bytes, &layout, Field::Thickness),
            transparency: values(&bytes, &layout, Field::Transparency),
            colors: values(&bytes, &layout, Field::Colors),
        };
        if len > promised {
            repairs.push(Repair::DroppedTrailingBytes { offset: promised, bytes: len - promised });
        }
        keep_whole_strands(&mut file, &layout, len, &mut repairs)?;
        repairs.extend(file.repair()?);
        Ok(Repaired { file, repairs })
    }
}

/// Sets the one count that is wrong, if the others and the file's length leave one way only.
fn mend_counts(
    header: &mut Header,
    segments: Option<&[u16]>,
    len: u64,
    repairs: &mut Vec<Repair>,
) -> Result<(), HairError> {
    let (hairs, points) = (u64::from(header.hair_count), u64::from(header.point_count));
    let default = u64::from(header.default_segments);
    let sum = segments.map_or(hairs * (default + 1), |all| all.iter().map(|&s| u64::from(s) + 1).sum());
    if sum == points {
        return Ok(());
    }
    // The length tells something about the points only where there are values for them.
    let per_point = header.layout().spans().any(|(field, _)| field != Field::Segments);
    let ends_right = |point_count| Header { point_count, ..*header }.layout().end == len;
    let trusted = per_point || segments.is_some();
    let by_sum = u32::try_from(sum).ok().filter(|&sum| trusted && ends_right(sum));
    let by_count = per_point && ends_right(header.point_count);
    // Neither divisor can be zero: there are strands, and every strand has a point.
    let exact = |value: u64, by: u64| value.is_multiple_of(by).then(|| value / by);
    let (field, to) = match (by_sum, by_count, segments) {
        (Some(sum), false, _) => (Field::PointCount, u64::from(sum)),
        // The length proves the point count, so the strands are wrong: in their number or in theirs.
        (None, true, None) => match (exact(points, default + 1), exact(points, hairs)) {
            (Some(hairs), None) if hairs > 0 => (Field::HairCount, hairs),
            (None, Some(each)) if each > 0 => (Field::DefaultSegments, each - 1),
            _ => return check::point_count(header, sum),
        },
        _ => return check::point_count(header, sum),
    };
    let (slot, to) = match field {
        Field::PointCount => (&mut header.point_count, to as u32),
        Field::HairCount => (&mut header.hair_count, to as u32),
        _ => (&mut header.default_segments, to as u32),
    };
    repairs.push(Repair::SetCount { field, from: *slot, to });
    *slot = to;
    Ok(())
}

/// Takes arrays behind the points that the file does not hold whole out of the header.
fn drop_cut_arrays(header: &mut Header, len: u64, repairs: &mut Vec<Repair>) {
    let layout = header.layout();
    for (field, span) in layout.spans().filter(|(field, _)| !matches!(field, Field::Segments | Field::Points))
    {
        if span.offset + span.bytes > len {
            header.arrays &= !field.bit();
            repairs.push(Repair::DroppedArray { field });
        }
    }
}

/// The values of an array that are there.
fn values<T: Value>(bytes: &[u8], layout: &Layout, field: Field) -> Option<Vec<T>> {
    let span = layout.span(field)?;
    let len = bytes.len() as u64;
    // Both are at most the length of `bytes`, so they fit in a usize.
    let (start, end) = (span.offset.min(len) as usize, (span.offset + span.bytes).min(len) as usize);
    let there = bytes.get(start..end).unwrap_or_default().chunks_exact(size_of::<T>());
    Some(there.map(|value| bytemuck::pod_read_unaligned::<T>(value).swapped_on_big_endian()).collect())
}

/// Cuts a file whose points end early back to its whole strands.
fn keep_whole_strands(
    file: &mut HairFile,
    layout: &Layout,
    len: u64,
    repairs: &mut Vec<Repair>,
) -> Result<(), HairError> {
    let (Some(points), Some(span)) = (&file.points, layout.span(Field::Points)) else { return Ok(()) };
    let there = points.len();
    if there as u64 == span.count {
        return Ok(());
    }
    let (mut kept, mut end) = (0, 0);
    for range in file.strand_ranges().take_while(|range| range.end <= there) {
        (kept, end) = (kept + 1, range.end);
    }
    if kept == 0 {
        let found = len.saturating_sub(span.offset);
        return Err(HairError::Truncated {
            field: Field::Points,
            offset: span.offset,
            expected: span.bytes,
            found,
        });
    }
    let dropped = u64::from(file.header.hair_count) - kept as u64;
    repairs.push(Repair::DroppedCutStrands { kept: kept as u64, dropped });
    if let Some(points) = &mut file.points {
        points.truncate(end);
    }
    if let Some(segments) = &mut file.segments {
        segments.truncate(kept);
    }
    // Both only shrink.
    (file.header.hair_count, file.header.point_count) = (kept as u32, end as u32);
    Ok(())
}
