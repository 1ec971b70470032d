//! The lines of an OBJ file and the words on them.

/// The lines of a text, those that end in `\` joined with the next.
pub(crate) struct Lines<'a> {
    rest: &'a [u8],
    /// Number of the line that comes next, from 1.
    next: u64,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(text: &'a [u8]) -> Self {
        Lines { rest: text, next: 1 }
    }
}

impl<'a> Iterator for Lines<'a> {
    /// The number of the line and its bytes.
    type Item = (u64, &'a [u8]);

    fn next(&mut self) -> Option<Self::Item> {
        if self.rest.is_empty() {
            return None;
        }
        let (number, mut length) = (self.next, 0);
        loop {
            let rest = &self.rest[length..];
            let end = rest.iter().position(|&byte| byte == b'\n');
            length += end.map_or(rest.len(), |end| end + 1);
            self.next += 1;
            let line = &self.rest[..length];
            let line = line.strip_suffix(b"\n").unwrap_or(line);
            let goes_on = line.strip_suffix(b"\r").unwrap_or(line).ends_with(b"\\");
            if !goes_on || length == self.rest.len() {
                break;
            }
        }
        let (line, rest) = self.rest.split_at(length);
        self.rest = rest;
        Some((number, line))
    }
}

/// The words of a line; what joins lines parts words.
pub(crate) fn words(line: &[u8]) -> impl Iterator<Item = &[u8]> {
    let parts = line.split(|byte| byte.is_ascii_whitespace() || *byte == b'\\');
    parts.filter(|word| !word.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_go_on_are_one() {
        let text = b"v 1 2 3\r\nl 1 \\\n2\\\r\n 3\n\nl 4 5\\";
        let lines: Vec<_> =
            Lines::new(text).map(|(number, line)| (number, words(line).collect::<Vec<_>>())).collect();
        let word = |text: &'static str| {
            text.split(' ').filter(|w| !w.is_empty()).map(str::as_bytes).collect::<Vec<_>>()
        };
        let expected = [(1, word("v 1 2 3")), (2, word("l 1 2 3")), (5, word("")), (6, word("l 4 5"))];
        assert_eq!(lines, expected);
    }
}
