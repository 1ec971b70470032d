//! Bytes read from front to back, little endian, with every fault named by its place.

use std::fmt::Display;
use std::io::{self, Write};

use glam::Vec3;

use crate::FormatError;

/// The bytes of a file and how far they are read.
#[derive(Clone)]
pub(crate) struct Bytes<'a> {
    file: &'a str,
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Bytes<'a> {
    pub(crate) fn new(file: &'a str, bytes: &'a [u8]) -> Self {
        Bytes { file, bytes, at: 0 }
    }

    /// Offset of the next byte.
    pub(crate) fn at(&self) -> usize {
        self.at
    }

    /// How many bytes are left.
    pub(crate) fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// The next `length` bytes, which hold `what`.
    pub(crate) fn take(&mut self, length: u64, what: impl Display) -> Result<&'a [u8], FormatError> {
        let found = self.left();
        let taken =
            usize::try_from(length).ok().and_then(|l| self.bytes.get(self.at..self.at.checked_add(l)?));
        let Some(taken) = taken else {
            let found = format!("{found} bytes before the end of the file");
            return Err(self.fault(self.at, found, format!("{length} bytes: {what}")));
        };
        self.at += taken.len();
        Ok(taken)
    }

    fn word(&mut self, what: impl Display) -> Result<[u8; 4], FormatError> {
        let bytes = self.take(4, what)?;
        Ok(std::array::from_fn(|i| bytes[i]))
    }

    pub(crate) fn u32(&mut self, what: impl Display) -> Result<u32, FormatError> {
        self.word(what).map(u32::from_le_bytes)
    }

    pub(crate) fn f32(&mut self, what: impl Display) -> Result<f32, FormatError> {
        self.word(what).map(f32::from_le_bytes)
    }

    /// A count of things that take at least `each` bytes and that must all still come.
    ///
    /// A count that would fit with its bytes the other way round is told as such.
    pub(crate) fn count(&mut self, what: impl Display, each: u64) -> Result<u32, FormatError> {
        let at = self.at;
        let count = self.u32(&what)?;
        let most = (self.left() as u64).checked_div(each).unwrap_or(u64::MAX);
        if u64::from(count) <= most {
            return Ok(count);
        }
        let found = if count > i32::MAX as u32 { format!("{}", count as i32) } else { count.to_string() };
        let mut expected = format!("0 to {most}, for which there are bytes");
        if (1..=most).contains(&u64::from(count.swap_bytes())) {
            expected +=
                &format!(" ({}, were the file big endian; only little endian is read)", count.swap_bytes());
        }
        Err(self.fault(at, format!("{what} {found}"), expected))
    }

    pub(crate) fn fault(
        &self,
        at: usize,
        found: impl Into<String>,
        expected: impl Into<String>,
    ) -> FormatError {
        FormatError::invalid(self.file, format!("byte {at}"), found, expected)
    }
}

/// The little-endian floats in `bytes`, from the front; what does not fill one is left.
pub(crate) fn floats(bytes: &[u8]) -> impl ExactSizeIterator<Item = f32> + '_ {
    bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
}

/// Positions out of records of `stride` bytes that start with three floats; `stride` is 12 or more.
pub(crate) fn points(bytes: &[u8], stride: usize) -> impl ExactSizeIterator<Item = Vec3> + '_ {
    bytes.chunks_exact(stride).map(|record| vec3_at(record, 0))
}

/// The three floats at `at`; zeros where there are no bytes.
pub(crate) fn vec3_at(record: &[u8], at: usize) -> Vec3 {
    let mut values = floats(record.get(at..).unwrap_or_default());
    let mut next = || values.next().unwrap_or_default();
    Vec3::new(next(), next(), next())
}

/// Writes positions as little-endian floats.
#[cfg(any(feature = "data", feature = "ply"))]
pub(crate) fn write_points(stream: &mut impl Write, points: &[Vec3]) -> io::Result<()> {
    if cfg!(target_endian = "little") {
        return stream.write_all(bytemuck::cast_slice(points));
    }
    for value in points.iter().flat_map(Vec3::to_array) {
        stream.write_all(&value.to_le_bytes())?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_name_the_byte() {
        let mut bytes = Bytes::new("a.bin", &[1, 0, 0, 0, 2, 0]);
        assert_eq!(bytes.u32("a number").unwrap(), 1);
        let told = bytes.u32("a number").unwrap_err().to_string();
        assert_eq!(
            told,
            "a.bin: byte 4: found 2 bytes before the end of the file, expected 4 bytes: a number"
        );
        assert_eq!(bytes.at(), 4);
        assert!(bytes.take(u64::MAX, "much").is_err());
    }

    #[test]
    fn counts_are_held_against_the_bytes() {
        let file = |count: u32| [count.to_le_bytes(), [0; 4], [0; 4]].concat();
        assert_eq!(Bytes::new("a", &file(2)).count("strands", 4).unwrap(), 2);
        let told = |count: u32| Bytes::new("a", &file(count)).count("strands", 4).unwrap_err().to_string();
        assert_eq!(told(3), "a: byte 0: found strands 3, expected 0 to 2, for which there are bytes");
        assert!(told(u32::MAX).contains("found strands -1,"));
        assert!(told(1 << 24).contains("(1, were the file big endian"));
    }
}
