//! The stream of a layer and the values in it.

use std::collections::HashMap;
use std::io::{Seek, SeekFrom, Write};

use crate::write::value::LARGEST_OFFSET;
use crate::write::{Stored, WriteError};

/// What identifies a value's bytes.
type Digest = [u8; blake3::OUT_LEN];

/// Bytes handed on, counted, and values stored once.
#[derive(Debug)]
pub(super) struct Heap<W> {
    stream: W,
    /// Where the layer starts in the stream.
    start: u64,
    /// Bytes of the layer so far.
    position: u64,
    stored: HashMap<Digest, Stored>,
    checksum: Option<crc32fast::Hasher>,
}

impl<W: Write + Seek> Heap<W> {
    /// A layer from where `stream` stands, with `head` bytes left free.
    pub fn new(mut stream: W, head: usize, with_checksum: bool) -> Result<Self, WriteError> {
        let start = stream.stream_position()?;
        stream.write_all(&vec![0; head])?;
        let checksum = with_checksum.then(crc32fast::Hasher::new);
        Ok(Heap { stream, start, position: head as u64, stored: HashMap::new(), checksum })
    }

    pub fn write(&mut self, bytes: &[u8]) -> Result<(), WriteError> {
        self.stream.write_all(bytes)?;
        self.position += bytes.len() as u64;
        if let Some(checksum) = &mut self.checksum {
            checksum.update(bytes);
        }
        Ok(())
    }

    /// Goes on at a multiple of eight bytes and says where that is.
    pub fn align(&mut self) -> Result<u64, WriteError> {
        let padding = self.position.next_multiple_of(8) - self.position;
        self.write(&[0; 8][..padding as usize])?;
        if self.position > LARGEST_OFFSET {
            let (what, found) = ("bytes in a layer", self.position);
            return Err(WriteError::TooLarge { what, found, limit: LARGEST_OFFSET });
        }
        Ok(self.position)
    }

    /// Writes `parts` and remembers them as what `refer` makes of their place; nothing is written when values
    /// of the same `kind` and bytes are there.
    pub fn store(
        &mut self,
        kind: u16,
        parts: &[&[u8]],
        refer: impl FnOnce(u64) -> Stored,
    ) -> Result<Stored, WriteError> {
        let mut hasher = blake3::Hasher::new();
        hasher.update(&kind.to_le_bytes());
        for part in parts {
            hasher.update(part);
        }
        let digest = *hasher.finalize().as_bytes();
        if let Some(&stored) = self.stored.get(&digest) {
            return Ok(stored);
        }
        let stored = refer(self.align()?);
        for part in parts {
            self.write(part)?;
        }
        self.stored.insert(digest, stored);
        Ok(stored)
    }

    /// Fills in the free bytes at the start. Gives the stream back, standing at the end of the layer, and the
    /// CRC-32 of the whole layer if it was asked for.
    pub fn finish(mut self, head: &[u8]) -> Result<(W, u64, Option<u32>), WriteError> {
        self.stream.seek(SeekFrom::Start(self.start))?;
        self.stream.write_all(head)?;
        self.stream.seek(SeekFrom::Start(self.start + self.position))?;
        let checksum = self.checksum.map(|body| {
            let mut whole = crc32fast::Hasher::new();
            whole.update(head);
            whole.combine(&body);
            whole.finalize()
        });
        Ok((self.stream, self.position, checksum))
    }
}
