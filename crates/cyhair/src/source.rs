//! Reading arrays from a stream without trusting the counts that announce them.

use std::io::{self, Read};

use crate::little_endian::{Value, swap_on_big_endian};
use crate::{Field, HairError, Span};

/// Arrays are read in blocks of this size, which are still in the processor's cache when they are
/// looked at and copied to their place: fresh memory is touched once, and never only to be zeroed.
const BLOCK_BYTES: usize = 1 << 16;

/// A byte stream that knows how far it has come and, perhaps, how long it is.
pub(crate) struct Source<R> {
    reader: R,
    pub(crate) offset: u64,
    pub(crate) known_len: Option<u64>,
}

impl<R: Read> Source<R> {
    pub(crate) fn new(reader: R, known_len: Option<u64>) -> Self {
        Source { reader, offset: 0, known_len }
    }

    /// Fills `buffer`, or as much of it as the stream still has; returns how much that is.
    pub(crate) fn fill(&mut self, buffer: &mut [u8], field: Field) -> Result<usize, HairError> {
        let mut filled = 0;
        while filled < buffer.len() {
            match self.reader.read(&mut buffer[filled..]) {
                Ok(0) => break,
                Ok(count) => filled += count,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(source) => {
                    return Err(HairError::Io { field, offset: self.offset + filled as u64, source });
                }
            }
        }
        self.offset += filled as u64;
        Ok(filled)
    }

    /// Reads one array, showing `look` each block as it comes, with the index of its first value.
    ///
    /// Memory for the array is taken at once when the length is known to hold it; otherwise it grows
    /// with what arrives, to never more than twice that. A block comes on top.
    pub(crate) fn array<T: Value>(
        &mut self,
        field: Field,
        span: Span,
        mut look: impl FnMut(u64, &[T]) -> Result<(), HairError>,
    ) -> Result<Vec<T>, HairError> {
        let out_of_memory = || HairError::OutOfMemory { field, offset: span.offset, bytes: span.bytes };
        let count = usize::try_from(span.count).map_err(|_| out_of_memory())?;
        let mut values: Vec<T> = Vec::new();
        if self.known_len.is_some_and(|len| len >= span.offset + span.bytes) {
            values.try_reserve_exact(count).map_err(|_| out_of_memory())?;
        }
        let mut block = vec![T::zeroed(); count.min(BLOCK_BYTES / size_of::<T>())];
        while values.len() < count {
            let missing = block.len().min(count - values.len());
            let block = &mut block[..missing];
            if self.fill(bytemuck::cast_slice_mut(block), field)? < size_of_val(block) {
                let found = self.offset - span.offset;
                return Err(HairError::Truncated { field, offset: span.offset, expected: span.bytes, found });
            }
            swap_on_big_endian(block);
            look(values.len() as u64, block)?;
            values.try_reserve(missing).map_err(|_| out_of_memory())?;
            values.extend_from_slice(block);
        }
        Ok(values)
    }

    /// Counts the bytes up to the end, reading them only when the length is unknown.
    pub(crate) fn rest(&mut self) -> Result<u64, HairError> {
        if let Some(len) = self.known_len {
            return Ok(len.saturating_sub(self.offset));
        }
        let (start, mut buffer) = (self.offset, [0; 1 << 14]);
        while self.fill(&mut buffer, Field::Colors)? == buffer.len() {}
        Ok(self.offset - start)
    }
}
