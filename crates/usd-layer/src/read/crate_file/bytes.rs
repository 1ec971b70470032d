//! Little-endian numbers at places that are checked.

use crate::read::ReadError;

/// The bytes of a crate and a place in them.
#[derive(Clone, Copy)]
pub(super) struct Bytes<'a> {
    pub(super) all: &'a [u8],
    pub(super) at: u64,
}

impl<'a> Bytes<'a> {
    pub(super) fn new(all: &'a [u8], at: u64) -> Self {
        Bytes { all, at }
    }

    /// Bytes from here to the end of the file.
    pub(super) fn left(self) -> u64 {
        (self.all.len() as u64).saturating_sub(self.at)
    }

    /// The next `len` bytes of `what`.
    pub(super) fn take(&mut self, len: u64, what: &str) -> Result<&'a [u8], ReadError> {
        let end = self.at.checked_add(len).filter(|&end| end <= self.all.len() as u64);
        let found = end.and_then(|end| self.all.get(self.at as usize..end as usize));
        let Some(found) = found else {
            let found = format!("{} bytes to the end of the file", self.left());
            return Err(ReadError::byte(self.at, found, format!("{len} bytes of {what}")));
        };
        self.at += len;
        Ok(found)
    }

    fn array<const N: usize>(&mut self, what: &str) -> Result<[u8; N], ReadError> {
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.take(N as u64, what)?);
        Ok(bytes)
    }

    pub(super) fn u8(&mut self, what: &str) -> Result<u8, ReadError> {
        Ok(self.array::<1>(what)?[0])
    }

    pub(super) fn u32(&mut self, what: &str) -> Result<u32, ReadError> {
        self.array(what).map(u32::from_le_bytes)
    }

    pub(super) fn i32(&mut self, what: &str) -> Result<i32, ReadError> {
        self.array(what).map(i32::from_le_bytes)
    }

    pub(super) fn u64(&mut self, what: &str) -> Result<u64, ReadError> {
        self.array(what).map(u64::from_le_bytes)
    }

    pub(super) fn f64(&mut self, what: &str) -> Result<f64, ReadError> {
        self.array(what).map(f64::from_le_bytes)
    }

    /// A count of things of at least `size` bytes each, all of which must be there.
    pub(super) fn count(&mut self, size: u64, what: &str) -> Result<usize, ReadError> {
        let at = self.at;
        let count = self.u64(what)?;
        if count.checked_mul(size).is_none_or(|bytes| bytes > self.left()) {
            let expected = format!("no more than the file has room for, {}", self.left() / size.max(1));
            return Err(ReadError::byte(at, format!("{count} {what}"), expected));
        }
        Ok(count as usize)
    }

    /// Follows a relative jump: a place to read from, while this one goes on behind the jump.
    pub(super) fn jump(&mut self, what: &str) -> Result<Bytes<'a>, ReadError> {
        let from = self.at;
        let offset = self.u64(what)? as i64;
        match from.checked_add_signed(offset).filter(|&to| to <= self.all.len() as u64) {
            Some(to) => Ok(Bytes::new(self.all, to)),
            None => Err(ReadError::byte(from, format!("a jump of {offset} bytes"), "one inside the file")),
        }
    }
}
