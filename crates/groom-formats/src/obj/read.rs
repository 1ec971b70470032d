//! Wavefront OBJ lines as a groom.

use std::collections::BTreeMap;

use glam::Vec3;
use groom::{UpAxis, Values, names};

use super::lines::{Lines, words};
use crate::assemble::{self, Parts, per_vertex};
use crate::chains::{self, Chains};
use crate::{Format, FormatError, Loaded, ReadOptions, Warning};

/// Statements without a meaning for strands, left out in silence.
const SILENT: [&[u8]; 12] =
    [b"vt", b"vn", b"vp", b"g", b"o", b"s", b"mg", b"usemtl", b"mtllib", b"usemap", b"maplib", b"lod"];

/// No file has more kinds of statements; a broken one must not make a list of its own.
const MOST_KINDS: usize = 20;

pub(crate) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let mut parser = Parser::new(name, bytes);
    for (number, line) in Lines::new(bytes) {
        parser.line = number;
        parser.take(line)?;
    }
    parser.finish(options)
}

struct Parser<'a> {
    file: &'a str,
    line: u64,
    /// Bytes of the file.
    bytes: usize,
    /// Vertices in the whole file: a line may name one that comes later.
    vertices: usize,
    positions: Vec<Vec3>,
    /// As many as positions, once there was one.
    colors: Vec<Vec3>,
    chains: Chains,
    up_axis: UpAxis,
    meters_per_unit: Option<f64>,
    /// What was not read, and how often.
    others: BTreeMap<String, u64>,
}

impl<'a> Parser<'a> {
    /// Counts first, so that no array is larger than it must be.
    fn new(file: &'a str, bytes: &[u8]) -> Self {
        let (mut vertices, mut points) = (0, 0);
        for (_, line) in Lines::new(bytes) {
            let mut words = words(line);
            match words.next() {
                Some(b"v") => vertices += 1,
                Some(b"l") => points += words.count(),
                _ => {}
            }
        }
        Parser {
            file,
            line: 0,
            bytes: bytes.len(),
            vertices,
            positions: Vec::with_capacity(vertices),
            colors: Vec::new(),
            chains: Chains::with_capacity(points),
            up_axis: UpAxis::Y,
            meters_per_unit: None,
            others: BTreeMap::new(),
        }
    }

    fn take(&mut self, line: &[u8]) -> Result<(), FormatError> {
        let mut words = words(line);
        match words.next() {
            None => {}
            Some(b"v") => self.vertex(words)?,
            Some(b"l") => self.strand(words)?,
            Some(b"#") => self.comment(words),
            Some(word) if word.starts_with(b"#") || SILENT.contains(&word) => {}
            Some(word) => {
                let cut = &word[..word.len().min(20)];
                let kind = match word {
                    b"f" | b"fo" => "faces".to_owned(),
                    b"p" => "points (`p`)".to_owned(),
                    _ => format!("statements `{}`", String::from_utf8_lossy(cut).escape_debug()),
                };
                let kind = if self.others.len() < MOST_KINDS || self.others.contains_key(&kind) {
                    kind
                } else {
                    "other statements".to_owned()
                };
                *self.others.entry(kind).or_default() += 1;
            }
        }
        Ok(())
    }

    fn vertex<'w>(&mut self, words: impl Iterator<Item = &'w [u8]>) -> Result<(), FormatError> {
        let mut values = [0.0; 7];
        let mut count = 0;
        for word in words {
            let value = std::str::from_utf8(word).ok().and_then(|word| word.parse::<f32>().ok());
            let Some(value) = value else { return Err(self.fault(quoted(word), "a number")) };
            if let Some(place) = values.get_mut(count) {
                *place = value;
            }
            count += 1;
        }
        let [x, y, z, a, b, c, d] = values;
        let color = match count {
            3 | 4 => None,
            6 => Some(Vec3::new(a, b, c)),
            // A weight stands between.
            7 => Some(Vec3::new(b, c, d)),
            _ => return Err(self.fault(format!("a vertex of {count} numbers"), "x y z [w] or x y z r g b")),
        };
        if let Some(color) = color {
            if self.colors.is_empty() {
                self.colors.reserve_exact(self.vertices);
            }
            self.colors.resize(self.positions.len(), Vec3::ONE);
            self.colors.push(color);
        }
        self.positions.push(Vec3::new(x, y, z));
        Ok(())
    }

    fn strand<'w>(&mut self, words: impl Iterator<Item = &'w [u8]>) -> Result<(), FormatError> {
        let (mut first, mut count) = ([0; 2], 0);
        for word in words {
            let vertex = self.index(word)?;
            match first.get_mut(count) {
                Some(place) => *place = vertex,
                None => {
                    if count == 2 {
                        self.chains.begin();
                        first.iter().for_each(|&vertex| self.chains.point(vertex));
                    }
                    self.chains.point(vertex);
                }
            }
            count += 1;
        }
        match count {
            0 | 1 => Err(self.fault("a line of less than two vertices", "two or more")),
            2 => {
                self.chains.segment(first[0], first[1]);
                Ok(())
            }
            _ => Ok(()),
        }
    }

    /// The vertex a word of a line stands for, from 0.
    fn index(&self, word: &[u8]) -> Result<u32, FormatError> {
        let vertex = word.split(|&byte| byte == b'/').next().unwrap_or_default();
        let number = std::str::from_utf8(vertex).ok().and_then(|vertex| vertex.parse::<i64>().ok());
        let Some(number) = number else {
            return Err(self.fault(quoted(word), "the number of a vertex"));
        };
        let index = if number < 0 { self.positions.len() as i64 + number } else { number - 1 };
        match u32::try_from(index) {
            Ok(index) if (index as usize) < self.vertices => Ok(index),
            _ => {
                let (before, all) = (self.positions.len(), self.vertices);
                let expected = format!("1 to {all}, a vertex of the file, or -1 to -{before}, counted back");
                Err(self.fault(format!("the vertex {number}"), expected))
            }
        }
    }

    fn comment<'w>(&mut self, mut words: impl Iterator<Item = &'w [u8]>) {
        match (words.next(), words.next(), words.next()) {
            (Some(b"up_axis"), Some(b"z"), None) => self.up_axis = UpAxis::Z,
            (Some(b"meters_per_unit"), Some(unit), None) => {
                let unit = std::str::from_utf8(unit).ok().and_then(|unit| unit.parse().ok());
                self.meters_per_unit = unit.filter(|unit: &f64| unit.is_normal() && *unit > 0.0);
            }
            _ => {}
        }
    }

    fn finish(mut self, options: &ReadOptions) -> Result<Loaded, FormatError> {
        let format = Format::Obj;
        let not_read = |(what, count)| Warning::NotRead { format, what, count };
        let warnings: Vec<Warning> = std::mem::take(&mut self.others).into_iter().map(not_read).collect();
        if self.chains.len() == 0 {
            let found = format!("{} vertices and no line", self.vertices);
            let expected = "at least one `l`, a strand";
            return Err(FormatError::invalid(self.file, "the whole file", found, expected));
        }
        // Three times the file, less the vertices, for points, their indices and where strands start.
        let each = if self.colors.is_empty() { 12 } else { 24 };
        let most = (3 * self.bytes).saturating_sub(each * self.vertices) / (each + 8);
        self.chains.refuse_overuse(most.max(self.vertices), self.vertices, self.file)?;
        assemble::offset(self.chains.len(), format, self.file)?;
        if !self.colors.is_empty() {
            self.colors.resize(self.vertices, Vec3::ONE);
        }
        let (offsets, indices) = self.chains.into_offsets();
        let (mut positions, mut colors) = (self.positions, self.colors);
        if !chains::in_order(&indices, self.vertices) {
            positions = chains::pick(&positions, &indices);
            if !colors.is_empty() {
                colors = chains::pick(&colors, &indices);
            }
        }
        let mut attributes = Vec::new();
        if !colors.is_empty() {
            attributes.push((names::COLOR.to_owned(), per_vertex(Values::Vec3(colors))));
        }
        let (file, up_axis) = (self.file, self.up_axis);
        let parts = Parts { file, format, up_axis, offsets, positions, attributes, warnings };
        let meters_per_unit = options.meters_per_unit.or(self.meters_per_unit);
        let options = ReadOptions { meters_per_unit, ..options.clone() };
        parts
            .load(&options, |point| format!("vertex {}", indices.get(point).map_or(0, |&i| u64::from(i) + 1)))
    }

    fn fault(&self, found: impl Into<String>, expected: impl Into<String>) -> FormatError {
        FormatError::invalid(self.file, format!("line {}", self.line), found, expected)
    }
}

/// A word for a message, cut when it is long; what cannot be seen is spelt out.
fn quoted(word: &[u8]) -> String {
    let cut = &word[..word.len().min(40)];
    let more = if cut.len() < word.len() { "..." } else { "" };
    format!("`{}`{more}", String::from_utf8_lossy(cut).escape_debug())
}
