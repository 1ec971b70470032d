//! The numbers that follow a PLY header, one after another in any storage.

use super::header::{Storage, Type};
use crate::FormatError;

/// The numbers of a file and how far they are read.
pub(crate) struct Numbers<'a> {
    file: &'a str,
    bytes: &'a [u8],
    at: usize,
    storage: Storage,
}

impl<'a> Numbers<'a> {
    /// From byte `at` on.
    pub(crate) fn new(file: &'a str, bytes: &'a [u8], at: usize, storage: Storage) -> Self {
        Numbers { file, bytes, at, storage }
    }

    pub(crate) fn left(&self) -> usize {
        self.bytes.len() - self.at
    }

    /// Where the next number is, in words.
    pub(crate) fn place(&self) -> String {
        match self.storage {
            Storage::Ascii => {
                let before = &self.bytes[..self.at];
                format!("line {}", 1 + before.iter().filter(|&&byte| byte == b'\n').count())
            }
            _ => format!("byte {}", self.at),
        }
    }

    #[inline]
    pub(crate) fn float(&mut self, kind: Type) -> Result<f32, FormatError> {
        match (self.storage, kind) {
            (Storage::Ascii, _) => self.parsed("a number"),
            (_, Type::F32) => Ok(f32::from_bits(u32::from_ne_bytes(self.word()?))),
            (_, Type::F64) => Ok(f64::from_bits(u64::from_ne_bytes(self.word()?)) as f32),
            _ => self.integer(kind).map(|value| value as f32),
        }
    }

    /// An integer; a float must be a whole number.
    #[inline]
    pub(crate) fn integer(&mut self, kind: Type) -> Result<i64, FormatError> {
        match (self.storage, kind) {
            (Storage::Ascii, _) => {
                let start = self.at;
                let value = self.parsed::<i64>("a whole number")?;
                let fits = match kind {
                    Type::I8 => i8::try_from(value).is_ok(),
                    Type::U8 => u8::try_from(value).is_ok(),
                    Type::I16 => i16::try_from(value).is_ok(),
                    Type::U16 => u16::try_from(value).is_ok(),
                    Type::I32 => i32::try_from(value).is_ok(),
                    Type::U32 => u32::try_from(value).is_ok(),
                    Type::F32 | Type::F64 => true,
                };
                if fits {
                    return Ok(value);
                }
                self.at = start;
                self.skip_space();
                Err(self.fault(value.to_string(), format!("a number that fits {} bytes", kind.bytes())))
            }
            (_, Type::I8) => Ok(i8::from_ne_bytes(self.word()?).into()),
            (_, Type::U8) => Ok(u8::from_ne_bytes(self.word()?).into()),
            (_, Type::I16) => Ok(i16::from_ne_bytes(self.word()?).into()),
            (_, Type::U16) => Ok(u16::from_ne_bytes(self.word()?).into()),
            (_, Type::I32) => Ok(i32::from_ne_bytes(self.word()?).into()),
            (_, Type::U32) => Ok(u32::from_ne_bytes(self.word()?).into()),
            (_, Type::F32 | Type::F64) => {
                let start = self.at;
                let value = self.float(kind)?;
                if value.fract() == 0.0 {
                    return Ok(value as i64);
                }
                self.at = start;
                Err(self.fault(value.to_string(), "a whole number"))
            }
        }
    }

    /// The length of a list.
    pub(crate) fn length(&mut self, kind: Type) -> Result<u64, FormatError> {
        let start = self.at;
        let found = self.integer(kind)?;
        u64::try_from(found).map_err(|_| {
            self.at = start;
            self.skip_space();
            self.fault(format!("a list of {found}"), "0 or more")
        })
    }

    /// Leaves out `count` numbers.
    pub(crate) fn skip(&mut self, kind: Type, count: u64) -> Result<(), FormatError> {
        if self.storage == Storage::Ascii {
            return (0..count).try_for_each(|_| self.next_word("a number").map(drop));
        }
        let length = count.saturating_mul(kind.bytes() as u64);
        match usize::try_from(length).ok().filter(|&length| length <= self.left()) {
            Some(length) => {
                self.at += length;
                Ok(())
            }
            None => Err(self.ended(length)),
        }
    }

    /// Leaves out white space behind the last number, which is nobody's.
    pub(crate) fn skip_space(&mut self) {
        if self.storage == Storage::Ascii {
            let rest = &self.bytes[self.at..];
            self.at += rest.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        }
    }

    fn parsed<T: std::str::FromStr>(&mut self, expected: &str) -> Result<T, FormatError> {
        let word = self.next_word(expected)?;
        let value = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        value.ok_or_else(|| {
            self.at -= word.len();
            let cut = String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned();
            self.fault(format!("`{}`", cut.escape_debug()), expected)
        })
    }

    fn next_word(&mut self, expected: &str) -> Result<&'a [u8], FormatError> {
        self.skip_space();
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        if length == 0 {
            return Err(self.fault("the end of the file", expected));
        }
        self.at += length;
        Ok(&rest[..length])
    }

    /// The next bytes in this machine's order.
    #[inline]
    fn word<const N: usize>(&mut self) -> Result<[u8; N], FormatError> {
        let Some(bytes) = self.bytes.get(self.at..self.at + N) else { return Err(self.ended(N as u64)) };
        self.at += N;
        let mut word: [u8; N] = std::array::from_fn(|i| bytes[i]);
        if (self.storage == Storage::Big) == cfg!(target_endian = "little") {
            word.reverse();
        }
        Ok(word)
    }

    fn ended(&self, wanted: u64) -> FormatError {
        self.fault(
            format!("{} bytes before the end of the file", self.left()),
            format!("{wanted} bytes more"),
        )
    }

    fn fault(&self, found: impl Into<String>, expected: impl Into<String>) -> FormatError {
        FormatError::invalid(self.file, self.place(), found, expected)
    }
}
