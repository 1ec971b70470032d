//! Text as a groom.

use std::io::{BufRead, BufReader, Read};

use glam::Vec3;
use groom::{Attribute, Domain, Groom, UpAxis, Values, names};

use crate::{Format, FormatError, Loaded, ReadOptions, Warning};

/// Numbers on a line that have a meaning.
const MEANINGS: usize = 8;

/// No line of numbers is longer; a file without line ends must not fill the memory.
const LINE_LIMIT: u64 = 1 << 16;

/// Some editors put it before the first line.
const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// Reads a groom from text in the layout that the module `text` states; `name` stands for the file in messages.
///
/// # Errors
/// [`FormatError::Text`] with line and column, [`FormatError::Io`], [`FormatError::TooLarge`].
pub fn read(stream: impl Read, name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let mut stream = BufReader::with_capacity(1 << 18, stream);
    let mut parser = Parser { file: name, ..Parser::default() };
    let mut line = Vec::new();
    loop {
        line.clear();
        let read = stream.by_ref().take(LINE_LIMIT).read_until(b'\n', &mut line);
        if read.map_err(|e| FormatError::io(name, e))? == 0 {
            break;
        }
        parser.line += 1;
        let start =
            if parser.line == 1 && line.starts_with(BYTE_ORDER_MARK) { BYTE_ORDER_MARK.len() } else { 0 };
        parser.take_line(&line[start..])?;
    }
    parser.finish(options)
}

#[derive(Default)]
struct Parser<'a> {
    file: &'a str,
    line: u64,
    /// Numbers on every line, once one was read.
    columns: Option<usize>,
    offsets: Vec<u32>,
    positions: Vec<Vec3>,
    radii: Vec<f32>,
    colors: Vec<Vec3>,
    transparencies: Vec<f32>,
    warnings: Vec<Warning>,
}

impl Parser<'_> {
    fn take_line(&mut self, line: &[u8]) -> Result<(), FormatError> {
        if line.len() as u64 >= LINE_LIMIT {
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
            self.end_strand();
            return Ok(());
        }
        self.take_point(&values, count)
    }

    fn number(&self, word: &[u8], start: usize) -> Result<f32, FormatError> {
        let value = std::str::from_utf8(word).ok().and_then(|word| word.parse::<f32>().ok());
        match value {
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
        if self.offsets.is_empty() {
            self.offsets.push(0);
        }
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
        if self.positions.len() > u32::MAX as usize {
            return Err(self.too_large());
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

    fn end_strand(&mut self) {
        // take_point refuses more points than u32 can count.
        let end = self.positions.len() as u32;
        if self.offsets.last().is_some_and(|&last| last < end) {
            self.offsets.push(end);
        }
    }

    fn finish(mut self, options: &ReadOptions) -> Result<Loaded, FormatError> {
        self.end_strand();
        if self.positions.is_empty() {
            return self.fault(1, "no point".into(), "a strand: lines of x y z radius");
        }
        let fault = |source| FormatError::groom(self.file, source);
        let mut groom = Groom::new(self.offsets, self.positions).map_err(fault)?;
        groom.up_axis = options.up_axis.unwrap_or(UpAxis::Z);
        groom.meters_per_unit = options.meters_per_unit.unwrap_or(1.0);
        let per_vertex = |values| Attribute { domain: Domain::Vertex, values };
        let radius = if self.radii.is_empty() {
            Attribute::constant_float(groom::DEFAULT_RADIUS)
        } else {
            per_vertex(Values::Float(self.radii))
        };
        groom.set_attribute(names::RADIUS, radius).map_err(fault)?;
        if !self.colors.is_empty() {
            groom.set_attribute(names::COLOR, per_vertex(Values::Vec3(self.colors))).map_err(fault)?;
        }
        if !self.transparencies.is_empty() {
            let values = per_vertex(Values::Float(self.transparencies));
            groom.set_attribute(names::TRANSPARENCY, values).map_err(fault)?;
        }
        let repairs = if options.repair { groom.repair() } else { Vec::new() };
        let repairs = repairs.iter().map(ToString::to_string).collect();
        Ok(Loaded { warnings: self.warnings, repairs, ..Loaded::still(groom) })
    }

    fn fault<T>(&self, column: usize, found: String, expected: &'static str) -> Result<T, FormatError> {
        let (file, line) = (self.file.to_owned(), self.line.max(1));
        Err(FormatError::Text { file, line, column, found, expected })
    }

    fn too_large(&self) -> FormatError {
        FormatError::TooLarge {
            file: self.file.to_owned(),
            format: Format::Text,
            what: "points",
            found: self.positions.len() as u64,
            limit: u32::MAX.into(),
        }
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
