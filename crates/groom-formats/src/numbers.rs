//! Numbers as the shortest text that reads back to the same bits.

use std::io::{self, Write};
use std::ops::{Deref, DerefMut, Range};

use crate::blocks;

/// Text is handed on in pieces of about this many bytes.
const PIECE: usize = 1 << 16;

/// Text being put together in memory.
pub(crate) struct Text {
    bytes: Vec<u8>,
    digits: zmij::Buffer,
}

impl Text {
    pub(crate) fn new() -> Self {
        Text { bytes: Vec::new(), digits: zmij::Buffer::new() }
    }

    pub(crate) fn as_bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Forgets the text and keeps the memory.
    pub(crate) fn clear(&mut self) {
        self.bytes.clear();
    }

    #[inline]
    pub(crate) fn push(&mut self, text: &[u8]) {
        self.bytes.extend_from_slice(text);
    }

    /// A finite number; `1.0` becomes `1`, and `-0.0` stays `-0`.
    #[inline]
    pub(crate) fn float(&mut self, value: f32) {
        push_shortest(&mut self.bytes, self.digits.format_finite(value));
    }

    /// A whole number.
    #[allow(dead_code)] // not every format that writes numbers has some that are whole
    #[inline]
    pub(crate) fn integer(&mut self, mut value: u64) {
        let mut digits = [b'0'; 20];
        let mut start = digits.len();
        loop {
            start -= 1;
            digits[start] = b'0' + (value % 10) as u8;
            value /= 10;
            if value == 0 {
                break;
            }
        }
        self.bytes.extend_from_slice(&digits[start..]);
    }

    /// `values` with `between` between them.
    #[inline]
    pub(crate) fn floats(&mut self, values: &[f32], between: &[u8]) {
        for (i, &value) in values.iter().enumerate() {
            if i > 0 {
                self.push(between);
            }
            self.float(value);
        }
    }
}

/// [`Text`] that is handed to a stream in large pieces.
pub(crate) struct TextOut<'a, W: Write> {
    stream: &'a mut W,
    text: Text,
}

impl<'a, W: Write> TextOut<'a, W> {
    pub(crate) fn new(stream: &'a mut W) -> Self {
        let text = Text { bytes: Vec::with_capacity(PIECE + 1024), digits: zmij::Buffer::new() };
        TextOut { stream, text }
    }

    /// Hands the text on once there is enough of it.
    #[inline]
    pub(crate) fn hand_on(&mut self) -> io::Result<()> {
        if self.text.bytes.len() >= PIECE { self.finish() } else { Ok(()) }
    }

    pub(crate) fn finish(&mut self) -> io::Result<()> {
        self.stream.write_all(&self.text.bytes)?;
        self.text.clear();
        Ok(())
    }

    /// The text of many items, made on all cores: see [`blocks::write`].
    #[allow(dead_code)] // not every format that writes numbers has enough of them
    pub(crate) fn blocks(
        &mut self,
        items: usize,
        push: impl Fn(&mut Text, Range<usize>) + Sync,
    ) -> io::Result<()> {
        self.finish()?;
        blocks::write(self.stream, items, push)
    }
}

impl<W: Write> Deref for TextOut<'_, W> {
    type Target = Text;

    fn deref(&self) -> &Text {
        &self.text
    }
}

impl<W: Write> DerefMut for TextOut<'_, W> {
    fn deref_mut(&mut self) -> &mut Text {
        &mut self.text
    }
}

/// As [`Text::float`], for a single number of twice the size.
pub(crate) fn shortest(value: f64) -> String {
    let mut text = Vec::new();
    push_shortest(&mut text, zmij::Buffer::new().format(value));
    String::from_utf8(text).unwrap_or_default()
}

#[inline]
fn push_shortest(text: &mut Vec<u8>, digits: &str) {
    text.extend_from_slice(digits.strip_suffix(".0").unwrap_or(digits).as_bytes());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text_of(value: f32) -> String {
        let mut text = Text::new();
        text.float(value);
        String::from_utf8(text.as_bytes().to_vec()).unwrap()
    }

    #[test]
    fn shortest_and_back() {
        for (value, text) in [(1.0, "1"), (-0.0, "-0"), (0.1, "0.1"), (-2.5, "-2.5")] {
            assert_eq!(text_of(value), text);
        }
        assert_eq!([shortest(1.0), shortest(0.00254), shortest(1e22)], ["1", "0.00254", "1e+22"]);
        for value in [f32::MIN_POSITIVE, f32::MAX, f32::from_bits(1), 1e-7, 1e16, 123_456_790.0, 10.0, 0.3] {
            assert_eq!(text_of(value).parse::<f32>().unwrap().to_bits(), value.to_bits(), "{value}");
        }
    }

    #[test]
    fn text_before_and_after_blocks_keeps_its_place() {
        let mut bytes = Vec::new();
        let mut out = TextOut::new(&mut bytes);
        out.push(b"[");
        out.blocks(3, |text, range| range.for_each(|item| text.float(item as f32))).unwrap();
        out.push(b"]");
        out.finish().unwrap();
        assert_eq!(bytes, b"[012]");
    }
}
