//! A place in a text, and the smallest things found there.

use crate::read::ReadError;
use crate::read::error::quoted;

/// A text and a place in it.
#[derive(Clone, Copy)]
pub(super) struct Cursor<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) at: usize,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8], at: usize) -> Self {
        Cursor { bytes, at }
    }

    pub(super) fn rest(&self) -> &'a [u8] {
        self.bytes.get(self.at..).unwrap_or_default()
    }

    #[inline]
    pub(super) fn here(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    /// Goes to what comes next, behind space and comments; `;` parts statements and means as little.
    #[inline]
    pub(super) fn skip(&mut self) {
        while let Some(byte) = self.here() {
            match byte {
                b' ' | b'\t' | b'\n' | b'\r' | b';' => self.at += 1,
                b'#' => self.end_line(),
                b'/' if self.rest().starts_with(b"//") => self.end_line(),
                b'/' if self.rest().starts_with(b"/*") => {
                    let end = self.rest().windows(2).position(|pair| pair == b"*/");
                    self.at = end.map_or(self.bytes.len(), |end| self.at + end + 2);
                }
                _ => return,
            }
        }
    }

    fn end_line(&mut self) {
        let end = self.rest().iter().position(|&byte| byte == b'\n');
        self.at = end.map_or(self.bytes.len(), |end| self.at + end);
    }

    /// Goes behind space, then behind `byte` if it is next.
    #[inline]
    pub(super) fn eat(&mut self, byte: u8) -> bool {
        self.skip();
        let found = self.here() == Some(byte);
        self.at += usize::from(found);
        found
    }

    pub(super) fn expect(&mut self, byte: u8, expected: &str) -> Result<(), ReadError> {
        if self.eat(byte) { Ok(()) } else { Err(self.fault(expected)) }
    }

    /// The next word, which may be none: letters, digits, `_`, `:` and anything beyond ASCII.
    pub(super) fn word(&mut self) -> &'a [u8] {
        self.skip();
        let is_part = |byte: &u8| {
            byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b':' | b'|') || !byte.is_ascii()
        };
        let len = self.rest().iter().position(|byte| !is_part(byte)).unwrap_or(self.rest().len());
        let word = &self.rest()[..len];
        self.at += len;
        word
    }

    /// Goes behind the word if it is next.
    pub(super) fn eat_word(&mut self, word: &[u8]) -> bool {
        let mut ahead = *self;
        let found = ahead.word() == word;
        if found {
            *self = ahead;
        }
        found
    }

    /// What is here is not what was expected.
    pub(super) fn fault(&self, expected: &str) -> ReadError {
        ReadError::text(self.bytes, self.at, quoted(self.rest()), expected)
    }

    pub(super) fn fault_at(&self, at: usize, expected: &str) -> ReadError {
        Cursor::new(self.bytes, at).fault(expected)
    }

    /// What is between quotes, one or three of a kind, as it is written.
    pub(super) fn string(&mut self) -> Result<&'a [u8], ReadError> {
        self.skip();
        let start = self.at;
        let quote = match self.here() {
            Some(quote @ (b'"' | b'\'')) => quote,
            _ => return Err(self.fault("a text in quotes")),
        };
        let long = self.rest().starts_with(&[quote; 3]);
        self.at += if long { 3 } else { 1 };
        let from = self.at;
        while let Some(byte) = self.here() {
            if byte == b'\\' {
                self.at += 2;
            } else if byte == quote && (!long || self.rest().starts_with(&[quote; 3])) {
                let text = &self.bytes[from..self.at];
                self.at += if long { 3 } else { 1 };
                return Ok(text);
            } else if byte == b'\n' && !long {
                break;
            } else {
                self.at += 1;
            }
        }
        Err(self.fault_at(start, "a text that ends with its quote"))
    }

    /// What is between `@` and `@`, or `@@@` and `@@@`.
    pub(super) fn asset(&mut self) -> Result<&'a [u8], ReadError> {
        let start = self.at;
        let mark: &[u8] = if self.rest().starts_with(b"@@@") { b"@@@" } else { b"@" };
        self.at += mark.len();
        let from = self.at;
        while let Some(byte) = self.here() {
            if self.rest().starts_with(b"\\@@@") {
                self.at += 4;
            } else if self.rest().starts_with(mark) {
                let text = &self.bytes[from..self.at];
                self.at += mark.len();
                return Ok(text);
            } else if byte == b'\n' {
                break;
            } else {
                self.at += 1;
            }
        }
        Err(self.fault_at(start, "an asset path that ends with @"))
    }

    /// What is between `<` and `>`.
    pub(super) fn path(&mut self) -> Result<&'a [u8], ReadError> {
        let start = self.at;
        self.expect(b'<', "a path in < >")?;
        let len = self.rest().iter().position(|&byte| byte == b'>' || byte == b'\n');
        match len {
            Some(len) if self.rest()[len] == b'>' => {
                let text = &self.rest()[..len];
                self.at += len + 1;
                Ok(text)
            }
            _ => Err(self.fault_at(start, "a path that ends with >")),
        }
    }
}

/// The text that is written between quotes.
pub(super) fn unescaped(written: &[u8]) -> String {
    if !written.contains(&b'\\') {
        return String::from_utf8_lossy(written).into_owned();
    }
    let mut out = Vec::with_capacity(written.len());
    let mut rest = written;
    while let Some((&byte, after)) = rest.split_first() {
        rest = after;
        if byte != b'\\' {
            out.push(byte);
            continue;
        }
        let Some((&code, after)) = rest.split_first() else { break };
        rest = after;
        match code {
            b'n' => out.push(b'\n'),
            b't' => out.push(b'\t'),
            b'r' => out.push(b'\r'),
            b'a' => out.push(7),
            b'b' => out.push(8),
            b'f' => out.push(12),
            b'v' => out.push(11),
            b'x' => {
                let digits = rest.iter().take(2).take_while(|byte| byte.is_ascii_hexdigit()).count();
                out.push(number(&rest[..digits], 16));
                rest = &rest[digits..];
            }
            b'0'..=b'7' => {
                let digits = rest.iter().take(2).take_while(|byte| (b'0'..=b'7').contains(byte)).count();
                out.push(number(&written[written.len() - rest.len() - 1..][..=digits], 8));
                rest = &rest[digits..];
            }
            other => out.push(other),
        }
    }
    String::from_utf8_lossy(&out).into_owned()
}

fn number(digits: &[u8], base: u32) -> u8 {
    let digits = digits.iter().filter_map(|&digit| char::from(digit).to_digit(base));
    digits.fold(0, |value, digit| value * base + digit) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escapes_are_undone() {
        for (written, meant) in [
            (r"a\nb", "a\nb"),
            (r#"\"\\"#, "\"\\"),
            (r"\x41\101\0", "AA\0"),
            ("plain", "plain"),
            (r"end\", "end"),
        ] {
            assert_eq!(unescaped(written.as_bytes()), meant, "{written}");
        }
    }
}
