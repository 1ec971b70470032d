//! Reading arrays from a stream without trusting the counts that announce them.

use std::io::{self, Read};

use bytemuck::Pod;

use crate::{Field, HairError, Span};

/// What a stream of unknown length is asked for at first; later reads at most double what arrived.
const FIRST_CHUNK_BYTES: usize = 1 << 20;

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

    /// Reads one array. Memory is taken at once when the length is known to hold it, and otherwise
    /// in chunks, so that never more than twice what has arrived plus 1 MiB is allocated.
    pub(crate) fn array<T: Pod>(&mut self, field: Field, span: Span) -> Result<Vec<T>, HairError> {
        let out_of_memory = || HairError::OutOfMemory { field, offset: span.offset, bytes: span.bytes };
        let count = usize::try_from(span.count).map_err(|_| out_of_memory())?;
        let whole = self.known_len.is_some_and(|len| len >= span.offset + span.bytes);
        let mut values: Vec<T> = Vec::new();
        while values.len() < count {
            let filled = values.len();
            let chunk = filled.max(FIRST_CHUNK_BYTES / size_of::<T>());
            let target = if whole { count } else { count.min(filled + chunk) };
            if filled == 0 {
                // Zeroed pages come from the system for free; they are never written twice.
                values = bytemuck::try_zeroed_vec(target).map_err(|()| out_of_memory())?;
            } else {
                values.try_reserve_exact(target - filled).map_err(|_| out_of_memory())?;
                values.resize(target, T::zeroed());
            }
            let bytes: &mut [u8] = bytemuck::cast_slice_mut(&mut values[filled..]);
            let expected = bytes.len();
            if self.fill(bytes, field)? < expected {
                let found = self.offset - span.offset;
                return Err(HairError::Truncated { field, offset: span.offset, expected: span.bytes, found });
            }
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
