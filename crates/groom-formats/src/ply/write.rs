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
    let mut warnings = Vec::new();
    let mut plan = Plan::new(groom, &mut warnings);
    let layout = Layout {
        strands: groom.strand_count() as u64,
        points: groom.point_count() as u64,
        up_axis: groom.up_axis,
        meters_per_unit: groom.meters_per_unit,
        vertex: std::mem::take(&mut plan.vertex.properties),
        strand: std::mem::take(&mut plan.strand.properties),
        whole: std::mem::take(&mut plan.whole.properties),
    };
    let mut writer = PlyWriter::begin(stream, name, layout)?;
    let (radii, colors) = (groom.radii(), groom.colors());
    for strand in 0..groom.strand_count() {
        let start = groom.strand_range(strand).start;
        writer.push_with(groom.strand(strand), |index, record| {
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
    let mut whole = Vec::new();
    plan.whole.push(0, &mut whole);
    writer.finish_with(|strand, record| plan.strand.push(strand, record), &whole)?;
    Ok(warnings)
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
    fn new(groom: &'a Groom, warnings: &mut Vec<Warning>) -> Self {
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
        let colors_are_whole = colors_are_bytes(groom);
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
