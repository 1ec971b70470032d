//! A groom as PLY strands.

use std::collections::BTreeSet;
use std::io::Write;

use groom::{Attribute, Domain, Groom, Values, names};

use super::names::{byte, colors_are_bytes, properties, renamed};
use super::stream::{Layout, PlyWriter};
use crate::{Format, FormatError, Warning, WriteOptions};

pub(crate) fn write(
    groom: &Groom,
    stream: &mut impl Write,
    name: &str,
    _options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    if groom.strand_count() == 0 {
        return Err(FormatError::Empty { file: name.to_owned(), format: Format::Ply, points: 1 });
    }
    let (strands, points) = (groom.strand_count() as u64, groom.point_count() as u64);
    let mut sink = PlySink::begin(stream, name, (strands, points), groom, colors_are_bytes(groom))?;
    sink.push(groom)?;
    let rows = Plan::new(groom, sink.colors_are_whole, &mut Vec::new()).strand;
    sink.finish_with(|strand, record| rows.push(strand, record))
}

/// A file written from blocks of strands that have the same attributes on the same domains.
pub(crate) struct PlySink<'a, W: Write> {
    writer: PlyWriter<'a, W>,
    colors_are_whole: bool,
    /// The row of the whole groom.
    whole: Vec<u8>,
    warnings: Vec<Warning>,
}

impl<'a, W: Write> PlySink<'a, W> {
    /// Starts a file of `counts` strands and points; `like` has the attributes of all blocks, and
    /// `colors_are_whole` says whether 8 bits hold every colour of every block.
    pub(crate) fn begin(
        stream: &'a mut W,
        name: &'a str,
        counts: (u64, u64),
        like: &Groom,
        colors_are_whole: bool,
    ) -> Result<Self, FormatError> {
        let mut warnings = Vec::new();
        let plan = Plan::new(like, colors_are_whole, &mut warnings);
        let mut whole = Vec::new();
        if !plan.whole.values.is_empty() {
            plan.whole.push(0, &mut whole);
        }
        let layout = Layout {
            strands: counts.0,
            points: counts.1,
            up_axis: like.up_axis,
            meters_per_unit: like.meters_per_unit,
            vertex: plan.vertex.properties,
            strand: plan.strand.properties,
            whole: plan.whole.properties,
        };
        let writer = PlyWriter::begin(stream, name, layout)?;
        Ok(PlySink { writer, colors_are_whole, whole, warnings })
    }

    /// Writes the vertices of some strands.
    pub(crate) fn push(&mut self, block: &Groom) -> Result<(), FormatError> {
        let plan = Plan::new(block, self.colors_are_whole, &mut Vec::new());
        let (radii, colors) = (block.radii(), block.colors());
        for strand in 0..block.strand_count() {
            let start = block.strand_range(strand).start;
            self.writer.push_with(block.strand(strand), |index, record| {
                let vertex = start + index;
                if plan.radius {
                    record.extend_from_slice(&(2.0 * radii.get(strand, vertex)).min(f32::MAX).to_le_bytes());
                }
                if let Some(colors) = colors {
                    record.extend(colors.get(strand, vertex).to_array().map(byte));
                }
                plan.vertex.push(vertex, record);
            })?;
        }
        Ok(())
    }

    /// Writes the strands, whose rows `strand` appends, and the whole groom; tells what was renamed.
    pub(crate) fn finish_with(
        self,
        strand: impl FnMut(usize, &mut Vec<u8>),
    ) -> Result<Vec<Warning>, FormatError> {
        self.writer.finish_with(strand, &self.whole)?;
        Ok(self.warnings)
    }
}

/// Which attributes become which properties.
struct Plan<'a> {
    /// Whether `thickness` is written.
    radius: bool,
    vertex: Rows<'a>,
    strand: Rows<'a>,
    whole: Rows<'a>,
}

/// The attributes of one element, in the order of its properties.
#[derive(Default)]
struct Rows<'a> {
    properties: Vec<(&'static str, String)>,
    values: Vec<&'a Values>,
}

impl<'a> Plan<'a> {
    fn new(groom: &'a Groom, colors_are_whole: bool, warnings: &mut Vec<Warning>) -> Self {
        let radius = groom.attribute(names::RADIUS);
        let mut plan = Plan {
            radius: radius.is_some(),
            vertex: Rows::default(),
            strand: Rows::default(),
            whole: Rows::default(),
        };
        let first = &mut plan.vertex.properties;
        if plan.radius {
            first.push(("float", "thickness".to_owned()));
        }
        if groom.colors().is_some() {
            first.extend(["red", "green", "blue"].map(|name| ("uchar", name.to_owned())));
        }
        let mut used = BTreeSet::new();
        for (name, attribute) in groom.attributes() {
            let at_vertices = attribute.domain == Domain::Vertex;
            let is_held = match name {
                names::RADIUS => at_vertices,
                names::COLOR => at_vertices && colors_are_whole,
                _ => false,
            };
            if !is_held {
                let written = properties(name, &attribute.values, &mut used);
                warnings.extend(renamed(name, &written));
                plan.add(attribute, written);
            }
        }
        plan
    }

    fn add(&mut self, attribute: &'a Attribute, written: Vec<String>) {
        let rows = match attribute.domain {
            Domain::Groom => &mut self.whole,
            Domain::Strand => &mut self.strand,
            Domain::Vertex => &mut self.vertex,
        };
        let kind = if matches!(attribute.values, Values::Int(_)) { "int" } else { "float" };
        rows.properties.extend(written.into_iter().map(|name| (kind, name)));
        rows.values.push(&attribute.values);
    }
}

impl Rows<'_> {
    fn push(&self, row: usize, record: &mut Vec<u8>) {
        let mut put = |words: &[[u8; 4]]| words.iter().for_each(|word| record.extend_from_slice(word));
        for values in &self.values {
            match values {
                Values::Float(v) => put(&[v[row].to_le_bytes()]),
                Values::Vec2(v) => put(&v[row].to_array().map(f32::to_le_bytes)),
                Values::Vec3(v) => put(&v[row].to_array().map(f32::to_le_bytes)),
                Values::Int(v) => put(&[v[row].to_le_bytes()]),
            }
        }
    }
}
