//! A place in one array of a file that is read strand by strand.

use std::io::{Read, Seek, SeekFrom};

use bytemuck::Zeroable;

use crate::little_endian::{Value, swap_on_big_endian};
use crate::{Field, HairError, Span};

/// Values of one array read ahead, in bytes.
const BUFFER_BYTES: u64 = 1 << 16;

/// Reads one array from front to back while others are read from the same file.
#[derive(Debug)]
pub(crate) struct Cursor<T> {
    field: Field,
    span: Span,
    /// Values read ahead; those before `taken` are used up.
    buffer: Vec<T>,
    taken: usize,
    /// Values of the array not read from the file yet.
    unread: u64,
}

impl<T: Value + Zeroable> Cursor<T> {
    pub(crate) fn new(field: Field, span: Span) -> Self {
        Cursor { field, span, buffer: Vec::new(), taken: 0, unread: span.count }
    }

    /// The next `count` values; they stay until the next call.
    ///
    /// The buffer grows only for a strand longer than it.
    pub(crate) fn take(&mut self, file: &mut (impl Read + Seek), count: usize) -> Result<&[T], HairError> {
        if self.buffer.len() - self.taken < count {
            self.refill(file, count)?;
        }
        let start = self.taken;
        self.taken += count;
        Ok(&self.buffer[start..self.taken])
    }

    fn refill(&mut self, file: &mut (impl Read + Seek), count: usize) -> Result<(), HairError> {
        self.buffer.drain(..self.taken);
        self.taken = 0;
        let held = self.buffer.len();
        let missing = (count - held) as u64;
        let ahead = (BUFFER_BYTES / size_of::<T>() as u64).max(missing).min(self.unread);
        if ahead < missing {
            return Err(self.truncated(self.unread));
        }
        let io = |source| HairError::Io { field: self.field, offset: self.span.offset, source };
        let start = self.span.offset + (self.span.count - self.unread) * size_of::<T>() as u64;
        file.seek(SeekFrom::Start(start)).map_err(io)?;
        let Span { offset, bytes, .. } = self.span;
        let out_of_memory = |_| HairError::OutOfMemory { field: self.field, offset, bytes };
        self.buffer.try_reserve(ahead as usize).map_err(out_of_memory)?;
        self.buffer.resize(held + ahead as usize, T::zeroed());
        let bytes = bytemuck::cast_slice_mut(&mut self.buffer[held..]);
        match file.read_exact(bytes) {
            Ok(()) => {}
            // The file was long enough when it was opened: somebody cut it since.
            Err(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
                return Err(self.truncated(self.unread));
            }
            Err(error) => return Err(io(error)),
        }
        swap_on_big_endian(&mut self.buffer[held..]);
        self.unread -= ahead;
        Ok(())
    }

    fn truncated(&self, unread: u64) -> HairError {
        let Span { offset, bytes: expected, count } = self.span;
        HairError::Truncated {
            field: self.field,
            offset,
            expected,
            found: (count - unread) * size_of::<T>() as u64,
        }
    }

    /// The `count` values taken last.
    pub(crate) fn latest(&self, count: usize) -> &[T] {
        &self.buffer[self.taken - count..self.taken]
    }

    /// Index in the array of the first of the `count` values taken last.
    pub(crate) fn position(&self, count: usize) -> u64 {
        self.span.count - self.unread - (self.buffer.len() - self.taken) as u64 - count as u64
    }

    pub(crate) fn offset(&self) -> u64 {
        self.span.offset
    }
}
