//! A whole HAIR file in memory.

use std::fs::File;
use std::io::Read;
use std::ops::Range;
use std::path::Path;

use crate::check::{self, Oddities};
use crate::little_endian::Value;
use crate::source::Source;
use crate::{Field, HEADER_BYTES, HairError, Header, Layout, Warning};

/// A HAIR file: the header and the arrays it announces.
///
/// Everything is as the file has it: thickness is a diameter, numbers have no unit and no up axis.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HairFile {
    /// The header; its counts and bits agree with the arrays in every file that was read.
    pub header: Header,
    /// Segments of each strand, one less than its points; `default_segments` each when absent.
    pub segments: Option<Vec<u16>>,
    /// Points, strand after strand, root to tip; without them there is no geometry.
    pub points: Option<Vec<[f32; 3]>>,
    /// Thickness (diameter) at each point; `default_thickness` when absent.
    pub thickness: Option<Vec<f32>>,
    /// Transparency at each point; `default_transparency` when absent.
    pub transparency: Option<Vec<f32>>,
    /// Colour at each point; `default_color` when absent.
    pub colors: Option<Vec<[f32; 3]>>,
}

/// A file that was read, and what is odd about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The file.
    pub file: HairFile,
    /// What is odd about it; empty for a clean file.
    pub warnings: Vec<Warning>,
}

impl HairFile {
    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`HairError::Open`], and everything [`HairFile::read`] refuses, as the source of a
    /// [`HairError::File`] that names the path.
    pub fn open(path: impl AsRef<Path>) -> Result<Loaded, HairError> {
        let path = path.as_ref();
        let (file, len) = open_file(path)?;
        Self::read(file, len).map_err(|error| error.of_file(path))
    }

    /// Reads a file from its bytes.
    ///
    /// # Errors
    /// Everything [`HairFile::read`] refuses.
    pub fn from_bytes(bytes: &[u8]) -> Result<Loaded, HairError> {
        Self::read(bytes, Some(bytes.len() as u64))
    }

    /// Reads a file from a stream, whose length is `known_len` if somebody knows it.
    ///
    /// With a length, counts that promise more are refused before anything is allocated. Without
    /// one, memory grows with what arrives: never to more than twice that plus 64 KiB, whatever the header
    /// says.
    /// No buffering is needed around `reader`.
    ///
    /// # Errors
    /// [`HairError`] for a file that lies: wrong magic, no strands, cut off, counts that exceed the
    /// file or disagree, points that are not finite. Nothing of it is returned then.
    pub fn read(reader: impl Read, known_len: Option<u64>) -> Result<Loaded, HairError> {
        let mut source = Source::new(reader, known_len);
        let header = read_header(&mut source)?;
        let layout = check::header(&header, known_len)?;
        let mut oddities = Oddities::default();

        let segments: Option<Vec<u16>> = read_array(&mut source, &layout, Field::Segments, |_, _| Ok(()))?;
        check_segments(&header, segments.as_deref(), &mut oddities)?;
        let mut coincide = false;
        let points = read_points(&mut source, &layout, &mut coincide)?;
        let thickness = read_values(&mut source, &layout, Field::Thickness, &mut oddities)?;
        let transparency = read_values(&mut source, &layout, Field::Transparency, &mut oddities)?;
        let colors = read_values(&mut source, &layout, Field::Colors, &mut oddities)?;

        let mut warnings = check::header_warnings(&header);
        let trailing = source.rest()?;
        if trailing > 0 {
            warnings.push(Warning::TrailingBytes { offset: layout.end, bytes: trailing });
        }
        let file = HairFile { header, segments, points, thickness, transparency, colors };
        // Looking at neighbours across strands first is quick, and nearly always enough.
        if let Some(points) = file.points.as_deref().filter(|_| coincide) {
            for range in file.strand_ranges() {
                oddities.strand(range.start as u64, &points[range]);
            }
        }
        warnings.extend(oddities.warnings(&layout));
        Ok(Loaded { file, warnings })
    }

    /// How many strands there are.
    #[must_use]
    pub fn strand_count(&self) -> usize {
        self.header.hair_count as usize
    }

    /// The strands in order, each as the range of its points in the per-point arrays.
    pub fn strand_ranges(&self) -> impl Iterator<Item = Range<usize>> + '_ {
        let mut start = 0;
        (0..self.strand_count()).map(move |strand| {
            let range = start..start + self.strand_segments(strand) + 1;
            start = range.end;
            range
        })
    }

    /// Segments of one strand.
    ///
    /// # Panics
    /// When there is a segments array and it has no such strand.
    #[must_use]
    pub fn strand_segments(&self, strand: usize) -> usize {
        match &self.segments {
            Some(segments) => segments[strand].into(),
            None => self.header.default_segments as usize,
        }
    }

    /// Sets the header's counts and array bits to what the arrays say, leaving counts no array
    /// tells as they are. Call it before writing a file put together by hand.
    pub fn sync_header(&mut self) {
        let lens = self.array_lens();
        self.header.arrays = 0;
        for (field, len) in Field::ARRAYS.into_iter().zip(lens) {
            let Some(len) = len else { continue };
            self.header.arrays |= field.bit();
            // A count beyond u32 is caught when writing, where lengths are compared with counts.
            let count = u32::try_from(len).unwrap_or(u32::MAX);
            match field {
                Field::Segments => self.header.hair_count = count,
                _ => self.header.point_count = count,
            }
        }
    }

    /// Length of the arrays that have a value for each point; `None` when there is none of them.
    pub(crate) fn per_point_len(&self) -> Option<usize> {
        self.array_lens()[1..].iter().copied().flatten().next()
    }

    /// Lengths of the arrays, in the order of [`Field::ARRAYS`].
    pub(crate) fn array_lens(&self) -> [Option<usize>; 5] {
        [
            self.segments.as_ref().map(Vec::len),
            self.points.as_ref().map(Vec::len),
            self.thickness.as_ref().map(Vec::len),
            self.transparency.as_ref().map(Vec::len),
            self.colors.as_ref().map(Vec::len),
        ]
    }
}

/// Opens a file and learns its length, if it is a regular one.
pub(crate) fn open_file(path: &Path) -> Result<(File, Option<u64>), HairError> {
    let fault = |source| HairError::Open { path: path.to_owned(), source };
    let file = File::open(path).map_err(fault)?;
    let metadata = file.metadata().map_err(fault)?;
    Ok((file, metadata.is_file().then_some(metadata.len())))
}

/// Reads the header, saying in which field a short file ends.
pub(crate) fn read_header<R: Read>(source: &mut Source<R>) -> Result<Header, HairError> {
    let mut bytes = [0; HEADER_BYTES];
    let filled = source.fill(&mut bytes, Field::Magic)?;
    if filled < HEADER_BYTES {
        crate::header::check_magic(&bytes[..filled], Some(filled as u64))?;
        return Err(short_header(filled as u64));
    }
    Header::from_bytes(&bytes, source.known_len)
}

fn short_header(found: u64) -> HairError {
    const FIELDS: [(Field, u64); 9] = [
        (Field::Magic, 4),
        (Field::HairCount, 4),
        (Field::PointCount, 4),
        (Field::ArrayBits, 4),
        (Field::DefaultSegments, 4),
        (Field::DefaultThickness, 4),
        (Field::DefaultTransparency, 4),
        (Field::DefaultColor, 12),
        (Field::Info, 88),
    ];
    let cut = FIELDS.into_iter().find(|(field, bytes)| found < field.header_offset() + bytes);
    let (field, expected) = cut.unwrap_or((Field::Info, 88));
    let offset = field.header_offset();
    HairError::Truncated { field, offset, expected, found: found - offset }
}

/// Reads one array, if the header announces it; `look` sees it block by block.
pub(crate) fn read_array<R: Read, T: Value>(
    source: &mut Source<R>,
    layout: &Layout,
    field: Field,
    look: impl FnMut(u64, &[T]) -> Result<(), HairError>,
) -> Result<Option<Vec<T>>, HairError> {
    layout.span(field).map(|span| source.array(field, span, look)).transpose()
}

/// Reads one array of values that need not be finite, and notes those that are not.
fn read_values<R: Read, T: Value>(
    source: &mut Source<R>,
    layout: &Layout,
    field: Field,
    oddities: &mut Oddities,
) -> Result<Option<Vec<T>>, HairError> {
    let floats = (size_of::<T>() / size_of::<f32>()) as u64;
    read_array(source, layout, field, |first, block| {
        oddities.values(field, first * floats, bytemuck::cast_slice(block));
        Ok(())
    })
}

/// Reads the points, refusing any that is not finite; sets `coincide` when neighbours coincide
/// somewhere, be it only where one strand ends and the next begins.
fn read_points<R: Read>(
    source: &mut Source<R>,
    layout: &Layout,
    coincide: &mut bool,
) -> Result<Option<Vec<[f32; 3]>>, HairError> {
    let offset = layout.span(Field::Points).map_or(0, |span| span.offset);
    let mut last = None;
    read_array(source, layout, Field::Points, |first, block: &[[f32; 3]]| {
        check::points(block, first, offset)?;
        *coincide |= check::neighbours_coincide(block) || last.as_ref() == block.first();
        last = block.last().copied();
        Ok(())
    })
}

/// Refuses segments that do not add up to the point count, and notes strands without any.
fn check_segments(
    header: &Header,
    segments: Option<&[u16]>,
    oddities: &mut Oddities,
) -> Result<(), HairError> {
    let Some(segments) = segments else {
        if header.default_segments == 0 {
            oddities.only_one_point_strands(header.hair_count.into());
        }
        return Ok(());
    };
    check::point_count(header, segments.iter().map(|&s| u64::from(s) + 1).sum())?;
    for (strand, _) in segments.iter().enumerate().filter(|(_, count)| **count == 0) {
        oddities.one_point_strand(strand as u64);
    }
    Ok(())
}
