//! Streams that count their bytes and show them on a bar.

use std::io::{self, Read, Seek, SeekFrom, Write};

use command_line::Bar;

/// A stream, the bytes that went through it, and the bar that shows them.
pub(crate) struct Counted<S> {
    stream: S,
    bar: Bar,
    pub(crate) bytes: u64,
}

impl<S> Counted<S> {
    pub(crate) fn new(stream: S, bar: Bar) -> Self {
        Counted { stream, bar, bytes: 0 }
    }

    fn count(&mut self, result: io::Result<usize>) -> io::Result<usize> {
        let bytes = result? as u64;
        self.bytes += bytes;
        self.bar.inc(bytes);
        Ok(bytes as usize)
    }

    /// Takes the bar off the terminal; returns the stream and its bytes.
    pub(crate) fn finish(self) -> (S, u64) {
        self.bar.finish();
        (self.stream, self.bytes)
    }
}

impl<S: Read> Read for Counted<S> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let result = self.stream.read(buffer);
        self.count(result)
    }
}

impl<S: Write> Write for Counted<S> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let result = self.stream.write(bytes);
        self.count(result)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush()
    }
}

impl<S: Seek> Seek for Counted<S> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.stream.seek(to)
    }
}
