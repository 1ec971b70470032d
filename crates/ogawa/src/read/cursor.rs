//! Numbers and texts one after another, and where they stand in the file.

use crate::OgawaError;

/// A piece of the file being read from its front.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    /// Where `bytes` begin in the file.
    offset: u64,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8], offset: u64) -> Self {
        Cursor { bytes, offset }
    }

    pub(super) fn is_empty(&self) -> bool {
        self.bytes.is_empty()
    }

    pub(super) fn offset(&self) -> u64 {
        self.offset
    }

    pub(super) fn take(&mut self, len: u64, what: &'static str) -> Result<&'a [u8], OgawaError> {
        let split = usize::try_from(len).ok().and_then(|len| self.bytes.split_at_checked(len));
        let Some((taken, rest)) = split else {
            let left = self.bytes.len();
            return Err(OgawaError::invalid(
                self.offset,
                what,
                format!("{left} bytes"),
                format!("{len} bytes"),
            ));
        };
        self.bytes = rest;
        self.offset += len;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self, what: &'static str) -> Result<[u8; N], OgawaError> {
        let mut array = [0; N];
        array.copy_from_slice(self.take(N as u64, what)?);
        Ok(array)
    }

    pub(super) fn u8(&mut self, what: &'static str) -> Result<u8, OgawaError> {
        Ok(u8::from_le_bytes(self.array(what)?))
    }

    pub(super) fn u32(&mut self, what: &'static str) -> Result<u32, OgawaError> {
        Ok(u32::from_le_bytes(self.array(what)?))
    }

    pub(super) fn f64(&mut self, what: &'static str) -> Result<f64, OgawaError> {
        Ok(f64::from_le_bytes(self.array(what)?))
    }

    /// A count in 1, 2 or 4 bytes, as the header's hint 0, 1 or 2 says.
    pub(super) fn hinted(&mut self, hint: u32, what: &'static str) -> Result<u32, OgawaError> {
        match hint {
            0 => Ok(self.u8(what)?.into()),
            1 => Ok(u16::from_le_bytes(self.array(what)?).into()),
            2 => self.u32(what),
            _ => Err(OgawaError::invalid(self.offset, what, format!("size hint {hint}"), "0, 1 or 2")),
        }
    }

    pub(super) fn text(&mut self, len: u64, what: &'static str) -> Result<&'a str, OgawaError> {
        let offset = self.offset;
        let bytes = self.take(len, what)?;
        std::str::from_utf8(bytes).map_err(|e| {
            let at = offset + e.valid_up_to() as u64;
            OgawaError::invalid(at, what, "bytes that are no UTF-8", "UTF-8 text")
        })
    }
}
