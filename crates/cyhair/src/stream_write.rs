//! Writing a HAIR file strand by strand.

use std::io::{Seek, SeekFrom, Write};

use crate::little_endian::Value;
use crate::write::write_values;
use crate::{Field, HairError, Header, KNOWN_ARRAYS, Layout, Span, Strand, check};

/// Bytes of one array collected before they are written to their place.
const BUFFER_BYTES: usize = 1 << 16;

/// Writes a file strand by strand, with about 100 KiB of memory an array (beyond segments given before).
///
/// The header is needed up front: it says where each array lies. Nothing is promised about the file
/// before [`HairWriter::finish`].
#[derive(Debug)]
pub struct HairWriter<W> {
    file: W,
    header: Header,
    segments: Segments,
    next: u64,
    points: Option<Lane>,
    thickness: Option<Lane>,
    transparency: Option<Lane>,
    colors: Option<Lane>,
}

/// Where the numbers of segments come from.
#[derive(Debug)]
enum Segments {
    /// All strands are alike.
    Default,
    /// They were given before the first strand.
    Given(Vec<u16>),
    /// They are counted as the strands come: so far for this many points.
    Counted { lane: Lane, points: u64 },
}

/// Where one array has got to.
#[derive(Debug)]
struct Lane {
    field: Field,
    span: Span,
    written: u64,
    buffer: Vec<u8>,
}

impl<W: Write + Seek> HairWriter<W> {
    /// Writes the header and the segments at the start of `file`, which must be empty.
    ///
    /// `header` announces the arrays the strands will bring; `segments` go with its bit for them.
    ///
    /// # Errors
    /// [`HairError::NoStrands`], [`HairError::ArrayBit`], [`HairError::ArrayLength`] or
    /// [`HairError::PointCount`] for a header that would lie; [`HairError::Io`].
    pub fn new(mut file: W, header: Header, segments: Option<Vec<u16>>) -> Result<Self, HairError> {
        let header = Header { arrays: header.arrays & KNOWN_ARRAYS, ..header };
        let announced = header.has(Field::Segments);
        if announced != segments.is_some() {
            return Err(HairError::ArrayBit { field: Field::Segments, announced });
        }
        let layout = check::header(&header, None)?;
        if let Some(segments) = &segments {
            let (expected, found) = (header.hair_count.into(), segments.len() as u64);
            if expected != found {
                return Err(HairError::ArrayLength { field: Field::Segments, expected, found });
            }
            check::point_count(&header, segments.iter().map(|&s| u64::from(s) + 1).sum())?;
        }
        let io = |field: Field| move |source| HairError::Io { field, offset: field.header_offset(), source };
        file.write_all(&header.to_bytes()).map_err(io(Field::Magic))?;
        write_values(&mut file, segments.as_deref()).map_err(io(Field::Segments))?;
        let segments = segments.map_or(Segments::Default, Segments::Given);
        Ok(Self::begun(file, header, &layout, segments))
    }

    /// As [`HairWriter::new`], for strands whose lengths are not known yet: a segments array that `header`
    /// announces is counted from the strands as they come, so that memory does not grow with them.
    ///
    /// # Errors
    /// [`HairError::NoStrands`], [`HairError::PointCount`], [`HairError::Io`].
    pub fn counting(mut file: W, header: Header) -> Result<Self, HairError> {
        let header = Header { arrays: header.arrays & KNOWN_ARRAYS, ..header };
        let layout = check::header(&header, None)?;
        let io = |source| HairError::Io { field: Field::Magic, offset: 0, source };
        file.write_all(&header.to_bytes()).map_err(io)?;
        let segments = Lane::new(&layout, Field::Segments)
            .map_or(Segments::Default, |lane| Segments::Counted { lane, points: 0 });
        Ok(Self::begun(file, header, &layout, segments))
    }

    fn begun(file: W, header: Header, layout: &Layout, segments: Segments) -> Self {
        let lane = |field| Lane::new(layout, field);
        HairWriter {
            file,
            header,
            segments,
            next: 0,
            points: lane(Field::Points),
            thickness: lane(Field::Thickness),
            transparency: lane(Field::Transparency),
            colors: lane(Field::Colors),
        }
    }

    /// Writes the next strand, which must bring exactly the arrays announced, as long as announced.
    ///
    /// # Errors
    /// [`HairError::StrandCount`] for a strand too many, [`HairError::Strand`] for one that does not
    /// fit, [`HairError::NonFinitePoint`], [`HairError::Io`].
    pub fn push(&mut self, strand: Strand<'_>) -> Result<(), HairError> {
        let (index, hair_count) = (self.next, u64::from(self.header.hair_count));
        if index == hair_count {
            return Err(HairError::StrandCount { expected: hair_count, found: index + 1 });
        }
        let count = self.points_of(index, strand)?;
        let fit = |field, lane: &Option<Lane>, len: Option<usize>| {
            let (expected, found) = (if lane.is_some() { count } else { 0 }, len.unwrap_or(0) as u64);
            if expected == found {
                Ok(())
            } else {
                Err(HairError::Strand { strand: index, field, expected, found })
            }
        };
        fit(Field::Points, &self.points, strand.points.map(<[_]>::len))?;
        fit(Field::Thickness, &self.thickness, strand.thickness.map(<[_]>::len))?;
        fit(Field::Transparency, &self.transparency, strand.transparency.map(<[_]>::len))?;
        fit(Field::Colors, &self.colors, strand.colors.map(<[_]>::len))?;
        if let (Some(lane), Some(points)) = (&self.points, strand.points) {
            check::points(points, lane.values(), lane.span.offset)?;
        }
        put(&mut self.file, self.points.as_mut(), strand.points)?;
        put(&mut self.file, self.thickness.as_mut(), strand.thickness)?;
        put(&mut self.file, self.transparency.as_mut(), strand.transparency)?;
        put(&mut self.file, self.colors.as_mut(), strand.colors)?;
        if let Segments::Counted { lane, points } = &mut self.segments {
            // points_of has seen that it fits.
            put(&mut self.file, Some(lane), Some(&[(count - 1) as u16]))?;
            *points += count;
        }
        self.next += 1;
        Ok(())
    }

    /// Points that strand `index` must have.
    fn points_of(&self, index: u64, strand: Strand<'_>) -> Result<u64, HairError> {
        match &self.segments {
            Segments::Default => Ok(u64::from(self.header.default_segments) + 1),
            Segments::Given(all) => Ok(u64::from(all[index as usize]) + 1),
            Segments::Counted { points, .. } => {
                let found = strand.values().unwrap_or(0) as u64;
                // More than a number of segments can say, or than the points array was given room for.
                let room = u64::from(self.header.point_count) - points;
                let expected = found.clamp(1, room.clamp(1, u64::from(u16::MAX) + 1));
                if found == expected && found <= room {
                    return Ok(found);
                }
                Err(HairError::Strand { strand: index, field: Field::Segments, expected, found })
            }
        }
    }

    /// Writes what is still held back and gives the file back, at its end.
    ///
    /// # Errors
    /// [`HairError::StrandCount`] when strands are missing, [`HairError::Io`].
    pub fn finish(mut self) -> Result<W, HairError> {
        let (expected, found) = (u64::from(self.header.hair_count), self.next);
        if expected != found {
            return Err(HairError::StrandCount { expected, found });
        }
        let segments = match &mut self.segments {
            Segments::Counted { lane, points } => {
                check::point_count(&self.header, *points)?;
                Some(lane)
            }
            _ => None,
        };
        let lanes = [&mut self.points, &mut self.thickness, &mut self.transparency, &mut self.colors];
        for lane in lanes.into_iter().flatten().chain(segments) {
            lane.drain(&mut self.file)?;
        }
        let end = self.header.layout().end;
        let io = |source| HairError::Io { field: Field::Colors, offset: end, source };
        self.file.seek(SeekFrom::Start(end)).map_err(io)?;
        self.file.flush().map_err(io)?;
        Ok(self.file)
    }
}

impl Lane {
    fn new(layout: &Layout, field: Field) -> Option<Lane> {
        layout.span(field).map(|span| Lane { field, span, written: 0, buffer: Vec::new() })
    }

    /// How many values have come so far.
    fn values(&self) -> u64 {
        (self.written + self.buffer.len() as u64) / self.field.value_bytes()
    }

    fn drain(&mut self, file: &mut (impl Write + Seek)) -> Result<(), HairError> {
        let offset = self.span.offset + self.written;
        let io = |source| HairError::Io { field: self.field, offset, source };
        file.seek(SeekFrom::Start(offset)).map_err(io)?;
        file.write_all(&self.buffer).map_err(io)?;
        self.written += self.buffer.len() as u64;
        self.buffer.clear();
        Ok(())
    }
}

fn put<T: Value>(
    file: &mut (impl Write + Seek),
    lane: Option<&mut Lane>,
    values: Option<&[T]>,
) -> Result<(), HairError> {
    let (Some(lane), Some(values)) = (lane, values) else { return Ok(()) };
    // Pieces, so that a very long strand is not copied whole.
    for block in values.chunks(4096) {
        write_values(&mut lane.buffer, Some(block)).map_err(|source| HairError::Io {
            field: lane.field,
            offset: lane.span.offset,
            source,
        })?;
        if lane.buffer.len() >= BUFFER_BYTES {
            lane.drain(file)?;
        }
    }
    Ok(())
}
