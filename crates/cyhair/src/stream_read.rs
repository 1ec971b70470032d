//! Reading a HAIR file strand by strand.

use std::io::{Read, Seek, SeekFrom};

use crate::check::{self, Oddities};
use crate::cursor::Cursor;
use crate::file::read_header;
use crate::source::Source;
use crate::{Field, HairError, Header, Layout, Warning};

/// One strand: as many values in each array as it has points, root to tip.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Strand<'a> {
    /// Points, if the file has them.
    pub points: Option<&'a [[f32; 3]]>,
    /// Thickness (diameter) at each point, if the file has it.
    pub thickness: Option<&'a [f32]>,
    /// Transparency at each point, if the file has it.
    pub transparency: Option<&'a [f32]>,
    /// Colour at each point, if the file has it.
    pub colors: Option<&'a [[f32; 3]]>,
}

impl Strand<'_> {
    /// How many values the first of its arrays has.
    pub(crate) fn values(&self) -> Option<usize> {
        let points = self.points.or(self.colors).map(<[_]>::len);
        points.or(self.thickness.or(self.transparency).map(<[_]>::len))
    }
}

/// Reads a file strand by strand, with 64 KiB of memory an array (more only for a longer strand).
///
/// The arrays lie one behind the other in the file, so this needs to seek. Everything that can be
/// known without reading points is checked when the reader is made; points as they come.
#[derive(Debug)]
pub struct HairReader<R> {
    file: R,
    header: Header,
    layout: Layout,
    trailing: u64,
    next: u64,
    segments: Option<Cursor<u16>>,
    points: Option<Cursor<[f32; 3]>>,
    thickness: Option<Cursor<f32>>,
    transparency: Option<Cursor<f32>>,
    colors: Option<Cursor<[f32; 3]>>,
    oddities: Oddities,
}

impl<R: Read + Seek> HairReader<R> {
    /// Reads the header of the file that starts at byte 0 of `file`, and checks it and the segments.
    ///
    /// # Errors
    /// As [`crate::HairFile::read`], but for points that are not finite.
    pub fn new(mut file: R) -> Result<Self, HairError> {
        let io = |source| HairError::Io { field: Field::Magic, offset: 0, source };
        let len = file.seek(SeekFrom::End(0)).map_err(io)?;
        file.seek(SeekFrom::Start(0)).map_err(io)?;
        let header = read_header(&mut Source::new(&mut file, Some(len)))?;
        let layout = check::header(&header, Some(len))?;
        let mut reader = HairReader {
            file,
            header,
            layout,
            trailing: len - layout.end,
            next: 0,
            segments: cursor(&layout, Field::Segments),
            points: cursor(&layout, Field::Points),
            thickness: cursor(&layout, Field::Thickness),
            transparency: cursor(&layout, Field::Transparency),
            colors: cursor(&layout, Field::Colors),
            oddities: Oddities::default(),
        };
        reader.check_segments()?;
        Ok(reader)
    }

    /// The header.
    pub fn header(&self) -> &Header {
        &self.header
    }

    /// The next strand, or `None` after the last. After an error the reader is of no further use.
    ///
    /// # Errors
    /// [`HairError::NonFinitePoint`], [`HairError::Io`], or [`HairError::Truncated`] when the file was
    /// cut since the reader was made.
    pub fn next_strand(&mut self) -> Result<Option<Strand<'_>>, HairError> {
        if self.next == u64::from(self.header.hair_count) {
            return Ok(None);
        }
        self.next += 1;
        let count = match &mut self.segments {
            Some(segments) => usize::from(segments.take(&mut self.file, 1)?[0]) + 1,
            // The layout fits in the file, so a strand of this length does too.
            None => self.header.default_segments as usize + 1,
        };
        let (file, oddities) = (&mut self.file, &mut self.oddities);
        let points = match &mut self.points {
            Some(cursor) => Some(take_points(cursor, file, count, oddities)?),
            None => None,
        };
        let thickness = take(self.thickness.as_mut(), file, count)?;
        let transparency = take(self.transparency.as_mut(), file, count)?;
        let colors = take(self.colors.as_mut(), file, count)?;
        let mut note = |field, first: Option<u64>, values: Option<&[f32]>| {
            oddities.values(field, first.unwrap_or_default(), values.unwrap_or_default());
        };
        note(Field::Thickness, thickness.map(|t| t.0), thickness.map(|t| t.1));
        note(Field::Transparency, transparency.map(|t| t.0), transparency.map(|t| t.1));
        note(Field::Colors, colors.map(|c| c.0 * 3), colors.map(|c| bytemuck::cast_slice(c.1)));
        Ok(Some(Strand {
            points,
            thickness: thickness.map(|t| t.1),
            transparency: transparency.map(|t| t.1),
            colors: colors.map(|c| c.1),
        }))
    }

    /// What is odd about the file, as far as it has been read.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = check::header_warnings(&self.header);
        if self.trailing > 0 {
            warnings.push(Warning::TrailingBytes { offset: self.layout.end, bytes: self.trailing });
        }
        warnings.extend(self.oddities.warnings(&self.layout));
        warnings
    }

    fn check_segments(&mut self) -> Result<(), HairError> {
        let Some(mut segments) = cursor::<u16>(&self.layout, Field::Segments) else {
            if self.header.default_segments == 0 {
                self.oddities.only_one_point_strands(self.header.hair_count.into());
            }
            return Ok(());
        };
        let mut sum = 0;
        for strand in 0..u64::from(self.header.hair_count) {
            let count = segments.take(&mut self.file, 1)?[0];
            sum += u64::from(count) + 1;
            if count == 0 {
                self.oddities.one_point_strand(strand);
            }
        }
        check::point_count(&self.header, sum)
    }
}

fn cursor<T: crate::Value>(layout: &Layout, field: Field) -> Option<Cursor<T>> {
    layout.span(field).map(|span| Cursor::new(field, span))
}

fn take_points<'a>(
    cursor: &'a mut Cursor<[f32; 3]>,
    file: &mut (impl Read + Seek),
    count: usize,
    oddities: &mut Oddities,
) -> Result<&'a [[f32; 3]], HairError> {
    let offset = cursor.offset();
    cursor.take(file, count)?;
    let first = cursor.position(count);
    let points = cursor.latest(count);
    check::points(points, first, offset)?;
    oddities.strand(first, points);
    Ok(points)
}

/// The next values of an array, and the index of the first of them.
type Taken<'a, T> = Option<(u64, &'a [T])>;

fn take<'a, T: crate::Value>(
    cursor: Option<&'a mut Cursor<T>>,
    file: &mut (impl Read + Seek),
    count: usize,
) -> Result<Taken<'a, T>, HairError> {
    let Some(cursor) = cursor else { return Ok(None) };
    cursor.take(file, count)?;
    Ok(Some((cursor.position(count), cursor.latest(count))))
}
