//! The file being written.

use std::collections::HashMap;
use std::io::{Seek, SeekFrom, Write};

use super::headers::MetadataTable;
use super::object::{Object, Tree};
use super::property::StoredSample;
use crate::{DATA, HEADER, KEY, Metadata, OgawaError, TimeSampling, Value};

/// The first 16 bytes: magic, not yet whole, version, no root yet.
const UNFINISHED: [u8; HEADER as usize] = *b"Ogawa\x00\x00\x01\0\0\0\0\0\0\0\0";
/// `AbcCoreOgawa`'s version of the layout.
const VERSION: i32 = 0;
/// The Alembic library whose layout this is: 1.8.8.
const LIBRARY: i32 = 10_808;

/// An archive being written to a stream that can go back to its start.
///
/// Samples are written when they are given and identical ones once; only their places stay in memory.
/// The tree follows in [`ArchiveWriter::finish`]; until then readers refuse the file as not whole.
/// Give it a buffered stream: the tree is many small writes.
#[derive(Debug)]
pub struct ArchiveWriter<W> {
    stream: W,
    /// Where the archive begins in the stream.
    start: u64,
    /// Bytes written since.
    position: u64,
    samples: HashMap<[u8; KEY], u64>,
    times: Vec<TimeSampling>,
}

impl<W: Write + Seek> ArchiveWriter<W> {
    /// Begins an archive at the stream's position.
    ///
    /// # Errors
    /// [`OgawaError::Io`].
    pub fn new(mut stream: W) -> Result<Self, OgawaError> {
        let start = stream.stream_position()?;
        stream.write_all(&UNFINISHED)?;
        let times = vec![TimeSampling::default()];
        Ok(ArchiveWriter { stream, start, position: HEADER, samples: HashMap::new(), times })
    }

    /// Adds times at which samples are taken; 0 is there already, a sample a second from 0.
    pub fn add_times(&mut self, times: TimeSampling) -> u32 {
        let known = self.times.iter().position(|other| *other == times);
        let place = known.unwrap_or_else(|| {
            self.times.push(times);
            self.times.len() - 1
        });
        place as u32
    }

    /// Writes a sample of numbers: the values of an array, or the numbers of a scalar.
    ///
    /// # Errors
    /// [`OgawaError::Io`].
    pub fn values<T: Value>(&mut self, values: &[T]) -> Result<StoredSample, OgawaError> {
        if cfg!(target_endian = "little") {
            return self.bytes(bytemuck::cast_slice(values));
        }
        let mut bytes = bytemuck::cast_slice(values).to_vec();
        bytes.chunks_exact_mut(size_of::<T>()).for_each(<[u8]>::reverse);
        self.bytes(&bytes)
    }

    /// Writes a sample of texts.
    ///
    /// # Errors
    /// [`OgawaError::Io`], [`OgawaError::Unwritable`] for a text with a 0 byte in it.
    pub fn texts(&mut self, texts: &[&str]) -> Result<StoredSample, OgawaError> {
        let mut bytes = Vec::new();
        for text in texts {
            if text.contains('\0') {
                let found = (*text).to_owned();
                return Err(OgawaError::Unwritable { what: "text", found, expected: "no 0 byte" });
            }
            bytes.extend_from_slice(text.as_bytes());
            bytes.push(0);
        }
        let sample = self.bytes(&bytes)?;
        Ok(StoredSample { strings: Some(texts.len() as u64), ..sample })
    }

    /// Writes a sample as its bytes, little endian; a sample that is there already is not written again.
    ///
    /// # Errors
    /// [`OgawaError::Io`].
    pub fn bytes(&mut self, bytes: &[u8]) -> Result<StoredSample, OgawaError> {
        let len = bytes.len() as u64;
        if bytes.is_empty() {
            return Ok(StoredSample::EMPTY);
        }
        // Readers take the key for the content and cache by it.
        let mut key = [0; KEY];
        key.copy_from_slice(&blake3::hash(bytes).as_bytes()[..KEY]);
        let place = match self.samples.get(&key) {
            Some(&place) => place,
            None => {
                let place = DATA | self.position;
                self.put(&(len + KEY as u64).to_le_bytes())?;
                self.put(&key)?;
                self.put(bytes)?;
                self.samples.insert(key, place);
                place
            }
        };
        Ok(StoredSample { place, len, key, strings: None })
    }

    /// Writes the tree and the header, which makes the file whole, and gives the stream back, at its end.
    ///
    /// # Errors
    /// [`OgawaError::Io`], [`OgawaError::Unwritable`] for a name the layout cannot hold.
    pub fn finish(mut self, top: &Object, metadata: &Metadata) -> Result<W, OgawaError> {
        let mut table = MetadataTable::default();
        let mut tree = Tree { archive: &mut self, table: &mut table, samples: Vec::new() };
        let (top, _) = tree.object(top)?;
        let counts = tree.samples;
        let mut times = Vec::new();
        for (i, sampling) in self.times.iter().enumerate() {
            sampling.write(counts.get(i).copied().unwrap_or(0), &mut times);
        }
        let children = [
            self.data(&VERSION.to_le_bytes())?,
            self.data(&LIBRARY.to_le_bytes())?,
            top,
            self.data(metadata.to_text()?.as_bytes())?,
            self.data(&times)?,
            self.data(table.bytes())?,
        ];
        let root = self.group(&children)?;
        self.stream.seek(SeekFrom::Start(self.start + 8))?;
        self.stream.write_all(&root.to_le_bytes())?;
        // Last, so that half a file is never taken for a whole one.
        self.stream.seek(SeekFrom::Start(self.start + 5))?;
        self.stream.write_all(&[0xff])?;
        self.stream.seek(SeekFrom::Start(self.start + self.position))?;
        Ok(self.stream)
    }

    /// Writes data that is no sample.
    pub(super) fn data(&mut self, bytes: &[u8]) -> Result<u64, OgawaError> {
        if bytes.is_empty() {
            return Ok(DATA);
        }
        let place = DATA | self.position;
        self.put(&(bytes.len() as u64).to_le_bytes())?;
        self.put(bytes)?;
        Ok(place)
    }

    /// Writes a group of children.
    pub(super) fn group(&mut self, children: &[u64]) -> Result<u64, OgawaError> {
        if children.is_empty() {
            return Ok(0);
        }
        let place = self.position;
        let mut bytes = Vec::with_capacity(8 * (children.len() + 1));
        bytes.extend((children.len() as u64).to_le_bytes());
        children.iter().for_each(|child| bytes.extend(child.to_le_bytes()));
        self.put(&bytes)?;
        Ok(place)
    }

    pub(super) fn times_known(&self) -> usize {
        self.times.len()
    }

    fn put(&mut self, bytes: &[u8]) -> Result<(), OgawaError> {
        self.stream.write_all(bytes)?;
        self.position += bytes.len() as u64;
        Ok(())
    }
}
