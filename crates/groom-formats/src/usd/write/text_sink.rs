//! A stage as text. Arrays are streamed; samples wait in a temporary file until their attribute is written, because
//! a text has all samples of an attribute together.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};

use usd_layer::write::WriteError;

use crate::numbers::{Text, TextOut, shortest};
use crate::usd::write::array::{Array, Place, Row, Rows, Shape};
use crate::usd::write::curves::Curves;
use crate::usd::write::half;
use crate::usd::write::sink::{Content, Declaration, Head, Single, Sink};

/// Writes `.usda`.
pub(super) struct TextSink<'a, 's, W: Write> {
    out: TextOut<'s, W>,
    curves: &'a Curves<'a>,
    depth: usize,
    /// Whether the open prim has a line already.
    begun: bool,
    spool: Option<File>,
}

/// An array in the temporary file.
#[derive(Debug)]
pub(super) struct Spooled {
    offset: u64,
    len: usize,
    shape: Shape,
}

impl<'a, 's, W: Write> TextSink<'a, 's, W> {
    pub fn new(stream: &'s mut W, curves: &'a Curves<'a>) -> Self {
        TextSink { out: TextOut::new(stream), curves, depth: 0, begun: true, spool: None }
    }

    pub fn finish(mut self) -> io::Result<()> {
        self.out.finish()
    }

    fn indent(&mut self) {
        for _ in 0..self.depth {
            self.out.push(b"    ");
        }
    }

    fn words(&mut self, words: &[&str]) {
        for word in words {
            self.out.push(word.as_bytes());
        }
    }

    fn single(&mut self, value: Single<'_>) {
        match value {
            Single::Token(word) | Single::Text(word) => self.words(&["\"", word, "\""]),
            Single::Float(value) => value.text(&mut self.out),
            Single::Double(value) => self.words(&[&shortest(value)]),
            Single::Float2(value) => value.text(&mut self.out),
            Single::Float3(value) => value.text(&mut self.out),
            Single::Double3(value) => self.words(&[&doubles(&value)]),
            Single::Matrix4(value) => self.words(&[&matrix(&value)]),
            Single::Tokens(words) => self.list(words, |word| format!("\"{word}\"")),
            Single::Float3s(values) => self.list(values, |value| floats(value)),
            Single::Half3s(values) => self.list(values, |value| floats(&value.map(half::to_f32))),
            Single::Quaternions(values) => self.list(values, |value| floats(value)),
            Single::Matrix4s(values) => self.list(values, matrix),
        }
    }

    fn list<T>(&mut self, values: &[T], text: impl Fn(&T) -> String) {
        let texts: Vec<String> = values.iter().map(text).collect();
        self.words(&["[", &texts.join(", "), "]"]);
    }

    fn moving(&mut self, samples: &[(f64, Single<'_>)]) {
        self.out.push(b"{\n");
        for &(time, value) in samples {
            self.indent();
            self.words(&["    ", &shortest(time), ": "]);
            self.single(value);
            self.out.push(b",\n");
        }
        self.indent();
        self.out.push(b"}");
    }

    fn array(&mut self, array: &Array<'_>) -> io::Result<()> {
        self.out.push(b"[");
        match array.rows {
            Rows::Floats(values) => self.rows(array, values)?,
            Rows::Float2s(values) => self.rows(array, values)?,
            Rows::Float3s(values) => self.rows(array, values)?,
            Rows::Ints(values) => self.rows(array, values)?,
        }
        self.out.push(b"]");
        Ok(())
    }

    fn rows<T: TextRow>(&mut self, array: &Array<'_>, values: &[T]) -> io::Result<()> {
        self.out.blocks(array.items(), |text, items| {
            array.each(values, items, |place, value| {
                match place {
                    Place::First => {}
                    Place::Line => text.push(b",\n            "),
                    Place::Next => text.push(b", "),
                }
                value.text(text);
            });
        })
    }

    fn samples(&mut self, samples: &[(f64, Spooled)]) -> io::Result<()> {
        self.out.push(b"{\n");
        for (time, spooled) in samples {
            let values = self.back(spooled)?;
            self.indent();
            self.words(&["    ", &shortest(*time), ": "]);
            let rows = Rows::Float3s(&values);
            self.array(&Array { curves: self.curves, rows, shape: spooled.shape })?;
            self.out.push(b",\n");
        }
        self.indent();
        self.out.push(b"}");
        Ok(())
    }

    fn back(&mut self, spooled: &Spooled) -> io::Result<Vec<[f32; 3]>> {
        let mut values = vec![[0.0; 3]; spooled.len];
        if let Some(file) = &mut self.spool {
            file.seek(SeekFrom::Start(spooled.offset))?;
            file.read_exact(bytemuck::cast_slice_mut(&mut values))?;
        }
        Ok(values)
    }
}

impl<W: Write> Sink for TextSink<'_, '_, W> {
    type Stored = Spooled;

    /// Only arrays of three floats change over time.
    fn store(&mut self, array: &Array<'_>) -> Result<Spooled, WriteError> {
        let Rows::Float3s(values) = array.rows else {
            return Err(io::Error::from(io::ErrorKind::InvalidInput).into());
        };
        let file = match &mut self.spool {
            Some(file) => file,
            none => none.insert(tempfile::tempfile()?),
        };
        let offset = file.seek(SeekFrom::End(0))?;
        file.write_all(bytemuck::cast_slice(values))?;
        Ok(Spooled { offset, len: values.len(), shape: array.shape })
    }

    fn layer(&mut self, metadata: &[(&str, Single<'_>)]) -> Result<(), WriteError> {
        self.words(&["#usda 1.0\n(\n"]);
        for &(name, value) in metadata {
            self.words(&["    ", name, " = "]);
            self.single(value);
            self.out.push(b"\n");
        }
        self.words(&[")\n"]);
        Ok(())
    }

    fn begin(&mut self, prim: &Head<'_>) -> Result<(), WriteError> {
        if self.begun {
            self.out.push(b"\n");
        }
        self.indent();
        self.words(&["def ", prim.type_name, " \"", prim.name, "\""]);
        if prim.is_component || !prim.apis.is_empty() {
            self.out.push(b" (\n");
            if !prim.apis.is_empty() {
                self.indent();
                self.words(&["    prepend apiSchemas = [\"", &prim.apis.join("\", \""), "\"]\n"]);
            }
            if prim.is_component {
                self.indent();
                self.words(&["    kind = \"component\"\n"]);
            }
            self.indent();
            self.out.push(b")");
        }
        self.out.push(b"\n");
        self.indent();
        self.out.push(b"{\n");
        self.depth += 1;
        self.begun = false;
        Ok(())
    }

    fn attribute(
        &mut self,
        attribute: Declaration<'_>,
        content: Content<'_, Spooled>,
    ) -> Result<(), WriteError> {
        self.begun = true;
        self.indent();
        let Declaration { name, type_name, uniform, interpolation, element_size } = attribute;
        self.words(&[if uniform { "uniform " } else { "" }, type_name, " ", name]);
        match content {
            Content::Nothing => {}
            Content::Single(value) => {
                self.out.push(b" = ");
                self.single(value);
            }
            Content::Array(array) => {
                self.out.push(b" = ");
                self.array(array)?;
            }
            Content::Samples(samples) => {
                self.out.push(b".timeSamples = ");
                self.samples(samples)?;
            }
            Content::Moving(samples) => {
                self.out.push(b".timeSamples = ");
                self.moving(samples);
            }
            Content::Connection(source) => self.words(&[".connect = <", source, ">"]),
        }
        if interpolation.is_some() || element_size.is_some() {
            self.out.push(b" (\n");
            if let Some(size) = element_size {
                self.indent();
                self.words(&["    elementSize = ", &size.to_string(), "\n"]);
            }
            if let Some(interpolation) = interpolation {
                self.indent();
                self.words(&["    interpolation = \"", interpolation, "\"\n"]);
            }
            self.indent();
            self.out.push(b")");
        }
        self.out.push(b"\n");
        self.out.hand_on()?;
        Ok(())
    }

    fn relationship(&mut self, name: &str, target: &str) -> Result<(), WriteError> {
        self.begun = true;
        self.indent();
        self.words(&["rel ", name, " = <", target, ">\n"]);
        Ok(())
    }

    fn end(&mut self) -> Result<(), WriteError> {
        self.depth = self.depth.saturating_sub(1);
        self.begun = true;
        self.indent();
        self.out.push(b"}\n");
        Ok(())
    }
}

/// `(0.5, -1)`.
fn doubles(values: &[f64]) -> String {
    let numbers: Vec<String> = values.iter().map(|&value| shortest(value)).collect();
    format!("({})", numbers.join(", "))
}

fn floats(values: &[f32]) -> String {
    let numbers: Vec<String> = values.iter().map(|value| value.to_string()).collect();
    format!("({})", numbers.join(", "))
}

fn matrix(values: &[f64; 16]) -> String {
    let rows: Vec<String> = values.chunks(4).map(doubles).collect();
    format!("( {} )", rows.join(", "))
}

/// A value as text.
trait TextRow: Row {
    fn text(self, text: &mut Text);
}

impl TextRow for f32 {
    /// Attributes nobody checked may hold what is no number; USD has words for that.
    #[inline]
    fn text(self, text: &mut Text) {
        if self.is_finite() {
            text.float(self);
        } else if self.is_nan() {
            text.push(b"nan");
        } else {
            text.push(if self > 0.0 { b"inf" } else { b"-inf" });
        }
    }
}

impl TextRow for i32 {
    fn text(self, text: &mut Text) {
        text.push(self.to_string().as_bytes());
    }
}

impl<const N: usize> TextRow for [f32; N] {
    #[inline]
    fn text(self, text: &mut Text) {
        text.push(b"(");
        for (place, value) in self.into_iter().enumerate() {
            if place > 0 {
                text.push(b", ");
            }
            value.text(text);
        }
        text.push(b")");
    }
}
