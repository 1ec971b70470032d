//! Lines of text as points and the ends of strands.

use glam::Vec3;

use crate::parse_number::parse_f32;
use crate::{Format, FormatError, Warning};

/// Numbers on a line that have a meaning.
const MEANINGS: usize = 8;

/// No line of numbers is longer; a file without line ends must not fill the memory.
pub(super) const LINE_LIMIT: usize = 1 << 16;

/// What some lines of a file say.
#[derive(Default)]
pub(super) struct Lines<'a> {
    file: &'a str,
    /// Lines taken so far.
    line: u64,
    /// Numbers on every line, once one was read.
    pub(super) columns: Option<usize>,
    /// How many points had come at the blank lines, each number once.
    pub(super) ends: Vec<u32>,
    pub(super) positions: Vec<Vec3>,
    pub(super) radii: Vec<f32>,
    pub(super) colors: Vec<Vec3>,
    pub(super) transparencies: Vec<f32>,
    pub(super) warnings: Vec<Warning>,
}

impl<'a> Lines<'a> {
    pub(super) fn new(file: &'a str, columns: Option<usize>) -> Self {
        Lines { file, columns, ..Lines::default() }
    }

    /// Takes lines; the last need not have an end.
    pub(super) fn take(&mut self, text: &[u8]) -> Result<(), FormatError> {
        let mut rest = text;
        while !rest.is_empty() {
            let end = rest.iter().position(|&byte| byte == b'\n').map_or(rest.len(), |at| at + 1);
            let (line, after) = rest.split_at(end);
            self.line += 1;
            self.take_line(line)?;
            rest = after;
        }
        Ok(())
    }

    /// Takes what the next lines of the file, read apart from these, said.
    pub(super) fn append(
        &mut self,
        next: Lines<'_>,
        outcome: Result<(), FormatError>,
    ) -> Result<(), FormatError> {
        if let Err(mut error) = outcome {
            if let FormatError::Text { line, .. } = &mut error {
                *line += self.line;
            }
            return Err(error);
        }
        let before = self.positions.len() as u32;
        self.positions.extend_from_slice(&next.positions);
        self.refuse_too_many()?;
        for end in next.ends {
            self.end_strand(before + end);
        }
        self.line += next.line;
        self.radii.extend_from_slice(&next.radii);
        self.colors.extend_from_slice(&next.colors);
        self.transparencies.extend_from_slice(&next.transparencies);
        Ok(())
    }

    /// Takes memory for the whole file at once, if `bytes` bytes made these points and the others are like them.
    pub(super) fn make_room(&mut self, bytes: usize, known_len: Option<u64>) {
        let Some(times) = known_len.map(|len| len as f64 / bytes.max(1) as f64).filter(|&times| times > 1.0)
        else {
            return;
        };
        // A little more, or the last of them would double the room.
        let more = ((times * 1.02 - 1.0) * self.positions.len() as f64) as usize;
        // Where this fails, the arrays grow as they fill.
        let _ = self.positions.try_reserve_exact(more);
        let room = |empty: bool| if empty { 0 } else { more };
        let _ = self.radii.try_reserve_exact(room(self.radii.is_empty()));
        let _ = self.colors.try_reserve_exact(room(self.colors.is_empty()));
        let _ = self.transparencies.try_reserve_exact(room(self.transparencies.is_empty()));
    }

    /// Ends the last strand. Tells whether there is any.
    pub(super) fn finish(&mut self) -> Result<(), FormatError> {
        self.end_strand(self.positions.len() as u32);
        if self.positions.is_empty() {
            return self.fault(1, "no point".into(), "a strand: lines of x y z radius");
        }
        Ok(())
    }

    fn take_line(&mut self, line: &[u8]) -> Result<(), FormatError> {
        if line.len() >= LINE_LIMIT {
            return self.fault(1, "a line of over 65,000 bytes".into(), "numbers and line ends");
        }
        let line = without_end(line);
        let mut values = [0.0; MEANINGS];
        let mut count = 0;
        let mut rest = 0;
        while let Some((start, end)) = next_word(line, rest) {
            let value = self.number(&line[start..end], start)?;
            if count < MEANINGS {
                values[count] = value;
            }
            count += 1;
            rest = end;
        }
        if count == 0 {
            // refuse_too_many and the length of what is taken at once keep this below 2^32.
            self.end_strand(self.positions.len() as u32);
            return Ok(());
        }
        self.take_point(&values, count)
    }

    #[inline]
    fn number(&self, word: &[u8], start: usize) -> Result<f32, FormatError> {
        match parse_f32(word) {
            Some(value) if value.is_finite() => Ok(value),
            Some(_) => self.fault(start + 1, quoted(word), "a finite number that fits 32 bits"),
            None => self.fault(start + 1, quoted(word), "a number"),
        }
    }

    fn take_point(&mut self, values: &[f32; MEANINGS], count: usize) -> Result<(), FormatError> {
        let columns = match self.columns {
            Some(columns) => columns,
            None => self.settle_columns(count)?,
        };
        if count != columns {
            return self.fault(1, format!("{count} numbers"), "as many numbers as on the first line");
        }
        let [x, y, z, radius, r, g, b, transparency] = *values;
        self.positions.push(Vec3::new(x, y, z));
        if columns >= 4 {
            if radius < 0.0 {
                return self.fault(1, format!("a radius of {radius}"), "0 or more");
            }
            self.radii.push(radius);
        }
        if columns >= 7 {
            self.colors.push(Vec3::new(r, g, b));
        }
        if columns >= 8 {
            self.transparencies.push(transparency);
        }
        Ok(())
    }

    /// Decides from the first line what the columns mean.
    fn settle_columns(&mut self, count: usize) -> Result<usize, FormatError> {
        let used = match count {
            0..=2 => {
                let found = format!("{count} {}", if count == 1 { "number" } else { "numbers" });
                return self.fault(1, found, "x y z radius, at least");
            }
            3 => 3,
            4..=6 => 4,
            7 => 7,
            _ => 8,
        };
        if used == 3 {
            self.warnings.push(Warning::NoRadius { radius: groom::DEFAULT_RADIUS });
        }
        if count > used {
            self.warnings.push(Warning::ExtraColumns { line: self.line, found: count, used });
        }
        self.columns = Some(count);
        Ok(count)
    }

    fn end_strand(&mut self, points: u32) {
        if self.ends.last() != Some(&points) {
            self.ends.push(points);
        }
    }

    fn refuse_too_many(&self) -> Result<(), FormatError> {
        let found = self.positions.len() as u64;
        if found <= u32::MAX.into() {
            return Ok(());
        }
        let (file, format, limit) = (self.file.to_owned(), Format::Text, u32::MAX.into());
        Err(FormatError::TooLarge { file, format, what: "points", found, limit })
    }

    fn fault<T>(&self, column: usize, found: String, expected: &'static str) -> Result<T, FormatError> {
        let (file, line) = (self.file.to_owned(), self.line.max(1));
        Err(FormatError::Text { file, line, column, found, expected })
    }
}

/// The line without `\n` or `\r\n`. A `\r` elsewhere is part of a word, and refused there: lines that
/// end with it alone would be read as one long line.
fn without_end(line: &[u8]) -> &[u8] {
    let line = line.strip_suffix(b"\n").unwrap_or(line);
    line.strip_suffix(b"\r").unwrap_or(line)
}

/// Start and end of the next run of bytes that are neither space nor tab.
#[inline]
fn next_word(line: &[u8], from: usize) -> Option<(usize, usize)> {
    let is_gap = |byte: &u8| matches!(byte, b' ' | b'\t');
    let start = from + line[from..].iter().position(|byte| !is_gap(byte))?;
    let length = line[start..].iter().position(is_gap);
    Some((start, length.map_or(line.len(), |length| start + length)))
}

/// A word for a message, cut when it is long; what cannot be seen is spelt out.
fn quoted(word: &[u8]) -> String {
    let cut = &word[..word.len().min(40)];
    format!(
        "`{}`{}",
        String::from_utf8_lossy(cut).escape_debug(),
        if cut.len() < word.len() { "..." } else { "" }
    )
}
