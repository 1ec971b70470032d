//! Values on their way to a stream, a block at a time.

use std::io::{self, Write};

use bytemuck::NoUninit;

/// Bytes of a block: as large as the buffers of streams, which then pass it on untouched.
const BLOCK: usize = 1 << 20;

/// Gathers values and writes them in blocks. Call [`Blocks::finish`].
pub(super) struct Blocks<'s, W, T> {
    stream: &'s mut W,
    values: Vec<T>,
    full: usize,
}

impl<'s, W: Write, T: NoUninit> Blocks<'s, W, T> {
    pub(super) fn new(stream: &'s mut W) -> Self {
        let full = (BLOCK / size_of::<T>().max(1)).max(1);
        Blocks { stream, values: Vec::with_capacity(full), full }
    }

    #[inline]
    pub(super) fn push(&mut self, value: T) -> io::Result<()> {
        if self.values.len() >= self.full {
            self.flush()?;
        }
        self.values.push(value);
        Ok(())
    }

    #[inline]
    pub(super) fn push_all(&mut self, values: &[T]) -> io::Result<()> {
        if self.values.len() + values.len() > self.full {
            self.flush()?;
        }
        self.values.extend_from_slice(values);
        Ok(())
    }

    /// Values that are as they should be already.
    pub(super) fn write(&mut self, values: &[T]) -> io::Result<()> {
        self.flush()?;
        self.stream.write_all(bytemuck::cast_slice(values))
    }

    pub(super) fn finish(mut self) -> io::Result<()> {
        self.flush()
    }

    #[cold]
    fn flush(&mut self) -> io::Result<()> {
        self.stream.write_all(bytemuck::cast_slice(&self.values))?;
        self.values.clear();
        Ok(())
    }
}
