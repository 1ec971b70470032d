//! Writing a HAIR file array by array.

use std::io::Write;

use crate::little_endian::Value;
use crate::write::write_values;
use crate::{Field, HairError, Header, KNOWN_ARRAYS, Layout, check};

/// Writes a file array by array in the order of [`Field::ARRAYS`], each in as many pieces as one likes:
/// nothing is copied and nothing is gone back to, so any stream will do.
///
/// Nothing is promised about the file before [`ArrayWriter::finish`].
#[derive(Debug)]
pub struct ArrayWriter<W> {
    writer: W,
    header: Header,
    layout: Layout,
    /// The array being written.
    at: Field,
    /// Values of it that came.
    came: u64,
    /// Points that the segments ask for.
    points: u64,
}

impl<W: Write> ArrayWriter<W> {
    /// Writes the header, which announces the arrays that will come and their lengths.
    ///
    /// # Errors
    /// [`HairError::NoStrands`], [`HairError::PointCount`], [`HairError::Io`].
    pub fn new(mut writer: W, header: Header) -> Result<Self, HairError> {
        let header = Header { arrays: header.arrays & KNOWN_ARRAYS, ..header };
        let layout = check::header(&header, None)?;
        let io = |source| HairError::Io { field: Field::Magic, offset: 0, source };
        writer.write_all(&header.to_bytes()).map_err(io)?;
        Ok(ArrayWriter { writer, header, layout, at: Field::Segments, came: 0, points: 0 })
    }

    /// Writes the segments, or more of them.
    ///
    /// # Errors
    /// [`HairError::ArrayLength`] for more than the header announces, and when an array before this one
    /// is not complete or one after it was begun; [`HairError::Io`].
    pub fn segments(&mut self, values: &[u16]) -> Result<(), HairError> {
        self.put(Field::Segments, values)?;
        self.points += values.iter().map(|&segments| u64::from(segments) + 1).sum::<u64>();
        Ok(())
    }

    /// Writes the points, or more of them.
    ///
    /// # Errors
    /// As [`ArrayWriter::segments`], and [`HairError::NonFinitePoint`].
    pub fn points(&mut self, values: &[[f32; 3]]) -> Result<(), HairError> {
        let (first, span) =
            (if self.at == Field::Points { self.came } else { 0 }, self.layout.span(Field::Points));
        check::points(values, first, span.map_or(0, |span| span.offset))?;
        self.put(Field::Points, values)
    }

    /// Writes the thickness, or more of it.
    ///
    /// # Errors
    /// As [`ArrayWriter::segments`].
    pub fn thickness(&mut self, values: &[f32]) -> Result<(), HairError> {
        self.put(Field::Thickness, values)
    }

    /// Writes the transparency, or more of it.
    ///
    /// # Errors
    /// As [`ArrayWriter::segments`].
    pub fn transparency(&mut self, values: &[f32]) -> Result<(), HairError> {
        self.put(Field::Transparency, values)
    }

    /// Writes the colours, or more of them.
    ///
    /// # Errors
    /// As [`ArrayWriter::segments`].
    pub fn colors(&mut self, values: &[[f32; 3]]) -> Result<(), HairError> {
        self.put(Field::Colors, values)
    }

    /// Gives the stream back, at the end of the file.
    ///
    /// # Errors
    /// [`HairError::ArrayLength`] for an array that is not complete, [`HairError::PointCount`] for segments
    /// that do not add up, [`HairError::Io`].
    pub fn finish(mut self) -> Result<W, HairError> {
        self.move_to(None)?;
        if self.header.has(Field::Segments) {
            check::point_count(&self.header, self.points)?;
        }
        let io = |source| HairError::Io { field: Field::Colors, offset: self.layout.end, source };
        self.writer.flush().map_err(io)?;
        Ok(self.writer)
    }

    fn put<T: Value>(&mut self, field: Field, values: &[T]) -> Result<(), HairError> {
        self.move_to(Some(field))?;
        let span = self.layout.span(field);
        let (expected, found) = (span.map_or(0, |span| span.count), self.came + values.len() as u64);
        if found > expected {
            return Err(HairError::ArrayLength { field, expected, found });
        }
        let offset = span.map_or(0, |span| span.offset);
        write_values(&mut self.writer, Some(values)).map_err(|source| HairError::Io {
            field,
            offset,
            source,
        })?;
        self.came = found;
        Ok(())
    }

    /// Moves on to `field` (or the end), once every array before it is complete.
    fn move_to(&mut self, field: Option<Field>) -> Result<(), HairError> {
        if field == Some(self.at) {
            return Ok(());
        }
        let mut passed = false;
        for array in Field::ARRAYS {
            passed |= array == self.at;
            if Some(array) == field {
                if !passed {
                    // It was left behind already.
                    let expected = self.layout.span(array).map_or(0, |span| span.count);
                    return Err(HairError::ArrayLength { field: array, expected, found: expected + 1 });
                }
                self.at = array;
                self.came = 0;
                return Ok(());
            }
            let found = if array == self.at { self.came } else { 0 };
            let expected = self.layout.span(array).map_or(0, |span| span.count);
            if passed && found != expected {
                return Err(HairError::ArrayLength { field: array, expected, found });
            }
        }
        Ok(())
    }
}
