//! Writing a whole file.

use std::io::Write;

use crate::little_endian::Value;
use crate::{Field, HairError, HairFile, Header, KNOWN_ARRAYS, Span, check};

impl HairFile {
    /// Writes the file, refusing before the first byte what [`HairFile::read`] would refuse.
    ///
    /// Bits of `arrays` the format does not define are left out. Buffering around `writer` is not
    /// needed; a file that must never be seen half-written is the caller's to arrange.
    ///
    /// # Errors
    /// [`HairError::ArrayBit`], [`HairError::ArrayLength`], [`HairError::PointCount`],
    /// [`HairError::NoStrands`] or [`HairError::NonFinitePoint`] for a file that would lie
    /// ([`HairFile::sync_header`] mends the first two); [`HairError::Io`].
    pub fn write(&self, mut writer: impl Write) -> Result<(), HairError> {
        self.check()?;
        let header = Header { arrays: self.header.arrays & KNOWN_ARRAYS, ..self.header };
        let layout = header.layout();
        let io = |field, offset| move |source| HairError::Io { field, offset, source };
        writer.write_all(&header.to_bytes()).map_err(io(Field::Magic, 0))?;
        for (field, span) in layout.spans() {
            self.write_array(&mut writer, field, span)?;
        }
        writer.flush().map_err(io(Field::Colors, layout.end))
    }

    /// The file as bytes.
    ///
    /// # Errors
    /// As [`HairFile::write`].
    pub fn to_bytes(&self) -> Result<Vec<u8>, HairError> {
        let mut bytes = Vec::new();
        self.write(&mut bytes)?;
        Ok(bytes)
    }

    /// Refuses what a reader would refuse.
    ///
    /// # Errors
    /// As [`HairFile::write`], without [`HairError::Io`].
    pub fn check(&self) -> Result<(), HairError> {
        for (field, len) in Field::ARRAYS.into_iter().zip(self.array_lens()) {
            let announced = self.header.has(field);
            if announced != len.is_some() {
                return Err(HairError::ArrayBit { field, announced });
            }
        }
        let layout = check::header(&self.header, None)?;
        for (field, len) in Field::ARRAYS.into_iter().zip(self.array_lens()) {
            let (Some(span), Some(found)) = (layout.span(field), len.map(|len| len as u64)) else { continue };
            if span.count != found {
                return Err(HairError::ArrayLength { field, expected: span.count, found });
            }
        }
        if let Some(segments) = &self.segments {
            check::point_count(&self.header, segments.iter().map(|&s| u64::from(s) + 1).sum())?;
        }
        match (&self.points, layout.span(Field::Points)) {
            (Some(points), Some(span)) => check::points(points, 0, span.offset),
            _ => Ok(()),
        }
    }

    fn write_array(&self, writer: &mut impl Write, field: Field, span: Span) -> Result<(), HairError> {
        let written = match field {
            Field::Segments => write_values(writer, self.segments.as_deref()),
            Field::Points => write_values(writer, self.points.as_deref()),
            Field::Thickness => write_values(writer, self.thickness.as_deref()),
            Field::Transparency => write_values(writer, self.transparency.as_deref()),
            _ => write_values(writer, self.colors.as_deref()),
        };
        written.map_err(|source| HairError::Io { field, offset: span.offset, source })
    }
}

/// Writes values in the file's byte order, straight from memory where that is the machine's.
pub(crate) fn write_values<T: Value>(writer: &mut impl Write, values: Option<&[T]>) -> std::io::Result<()> {
    let values = values.unwrap_or_default();
    if cfg!(target_endian = "little") {
        return writer.write_all(bytemuck::cast_slice(values));
    }
    for block in values.chunks(4096) {
        let swapped: Vec<T> = block.iter().map(|value| value.swapped_on_big_endian()).collect();
        writer.write_all(bytemuck::cast_slice(&swapped))?;
    }
    Ok(())
}
