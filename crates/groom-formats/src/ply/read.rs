//! PLY strands as a groom.

use glam::Vec3;
use groom::{Attribute, Domain, UpAxis, Values};

use super::attributes::{self, Alpha};
use super::columns::{self, Column, Columns};
use super::header::Header;
use super::numbers::Numbers;
use crate::assemble::{self, Parts};
use crate::chains::{self, Chains};
use crate::{Format, FormatError, Loaded, ReadOptions, Warning};

pub(crate) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let header = Header::read(bytes, name)?;
    let mut file = File::default();
    let end = file.read(&header, bytes, name)?;
    if end < bytes.len() {
        let (offset, bytes) = (end as u64, (bytes.len() - end) as u64);
        file.warnings.push(Warning::TrailingBytes { offset, bytes });
    }
    let File { vertices, strands, edges, whole, mut warnings } = file;
    let Some(mut vertices) = vertices else {
        return Err(FormatError::invalid(name, "the header", "no element `vertex`", "one with x, y and z"));
    };
    let alpha =
        if strands.as_ref().is_some_and(|s| s.has("nsegs")) { Alpha::Transparency } else { Alpha::Opacity };
    let Some(positions) = attributes::take_triple(&mut vertices, ["x", "y", "z"], |_| 1.0) else {
        let found = "an element `vertex` without x, y and z";
        return Err(FormatError::invalid(name, "the header", found, "x, y and z, each a float or a double"));
    };
    let (mut strands, rows) = (strands.unwrap_or_default(), vertices.rows);
    let layout = strands_of(name, rows, &mut strands, edges, options)?;
    let mut found: Vec<(String, Attribute)> = Vec::new();
    let mut add = |domain, values: Vec<(String, Values)>| {
        found.extend(values.into_iter().map(|(name, values)| (name, Attribute { domain, values })));
    };
    let (positions, vertices) = layout.ordered(positions, attributes::of(vertices, alpha, name, "vertex")?);
    add(Domain::Vertex, vertices);
    if strands.rows + 1 == layout.offsets.len() {
        add(Domain::Strand, attributes::of(strands, alpha, name, "strand")?);
    } else if strands.rows > 0 {
        let (what, count) = ("element `strand`".to_owned(), strands.rows as u64);
        warnings.push(Warning::NotRead { format: Format::Ply, what, count });
    }
    if let Some(whole) = whole.filter(|whole| whole.rows == 1) {
        add(Domain::Groom, attributes::of(whole, alpha, name, "groom")?);
    }
    let parts = Parts {
        file: name,
        format: Format::Ply,
        up_axis: header.up_axis.unwrap_or(UpAxis::Y),
        offsets: layout.offsets,
        positions,
        attributes: found,
        warnings,
    };
    let options = ReadOptions {
        meters_per_unit: options.meters_per_unit.or(header.meters_per_unit),
        ..options.clone()
    };
    parts.load(&options, |point| format!("point {point}"))
}

/// The elements that mean something here.
#[derive(Default)]
struct File {
    vertices: Option<Columns>,
    strands: Option<Columns>,
    edges: Option<Columns>,
    whole: Option<Columns>,
    warnings: Vec<Warning>,
}

impl File {
    /// Reads every element; the byte after the last.
    fn read(&mut self, header: &Header, bytes: &[u8], name: &str) -> Result<usize, FormatError> {
        let mut numbers = Numbers::new(name, bytes, header.bytes, header.storage);
        for element in &header.elements {
            let place = match element.name.as_str() {
                "vertex" => &mut self.vertices,
                "strand" => &mut self.strands,
                "edge" => &mut self.edges,
                "groom" => &mut self.whole,
                _ => {
                    columns::skip(element, header, &mut numbers, name)?;
                    if element.count > 0 {
                        let (what, count) = (format!("element `{}`", element.name), element.count);
                        self.warnings.push(Warning::NotRead { format: Format::Ply, what, count });
                    }
                    continue;
                }
            };
            if place.is_some() {
                let (place, found) =
                    (format!("line {}", element.line), format!("a second `{}`", element.name));
                return Err(FormatError::invalid(name, place, found, "elements whose names differ"));
            }
            *place = Some(Columns::read(element, header, &mut numbers, name)?);
        }
        numbers.skip_space();
        Ok(bytes.len() - numbers.left())
    }
}

/// Which vertices make which strands.
struct Layout {
    offsets: Vec<u32>,
    /// The vertex of every point; `None` when they come in order.
    indices: Option<Vec<u32>>,
}

impl Layout {
    fn ordered(
        &self,
        positions: Vec<Vec3>,
        attributes: Vec<(String, Values)>,
    ) -> (Vec<Vec3>, Vec<(String, Values)>) {
        let Some(indices) = &self.indices else { return (positions, attributes) };
        let moved = |(name, values)| (name, chains::pick_values(&values, indices));
        (chains::pick(&positions, indices), attributes.into_iter().map(moved).collect())
    }
}

fn strands_of(
    file: &str,
    vertices: usize,
    strands: &mut Columns,
    edges: Option<Columns>,
    options: &ReadOptions,
) -> Result<Layout, FormatError> {
    if let Some((_, segments)) = strands.take("nsegs") {
        return counted(file, vertices, &segments);
    }
    if let Some(points) = options.points_per_strand {
        return regular(file, vertices, points);
    }
    if let Some(edges) = edges.filter(|edges| edges.rows > 0) {
        return joined(file, vertices, edges);
    }
    let found = format!("{vertices} vertices and nothing that says which make a strand");
    let expected = "an `element strand` with nsegs, an `element edge`, or the number of points of every strand \
                    (--points-per-strand; 100 is common)";
    Err(FormatError::invalid(file, "the header", found, expected))
}

/// hairutil's way: the number of segments of every strand.
fn counted(file: &str, vertices: usize, segments: &Column) -> Result<Layout, FormatError> {
    let place = "the element `strand`";
    let counts: Vec<i64> = match segments {
        Column::Byte(values) => values.iter().map(|&value| value.into()).collect(),
        Column::Int(values) => values.iter().map(|&value| value.into()).collect(),
        Column::Float(_) => {
            return Err(FormatError::invalid(file, place, "nsegs that are floats", "a ushort"));
        }
    };
    let mut offsets = Vec::with_capacity(counts.len() + 1);
    offsets.push(0);
    let mut points = 0_usize;
    for (strand, &count) in counts.iter().enumerate() {
        let Ok(count) = usize::try_from(count) else {
            let place = format!("strand {strand}");
            return Err(FormatError::invalid(file, place, format!("{count} segments"), "0 or more"));
        };
        points = points.saturating_add(count + 1);
        offsets.push(assemble::offset(points.min(vertices), Format::Ply, file)?);
    }
    if points != vertices {
        let found = format!("nsegs that stand for {points} points");
        return Err(FormatError::invalid(file, place, found, format!("{vertices}, the number of vertices")));
    }
    Ok(Layout { offsets, indices: None })
}

fn regular(file: &str, vertices: usize, points: u32) -> Result<Layout, FormatError> {
    if points == 0 || !vertices.is_multiple_of(points as usize) {
        let expected = format!("a multiple of {points}, the points of every strand as asked");
        return Err(FormatError::invalid(
            file,
            "the element `vertex`",
            format!("{vertices} vertices"),
            expected,
        ));
    }
    let end = assemble::offset(vertices, Format::Ply, file)?;
    Ok(Layout { offsets: (0..=end).step_by(points as usize).collect(), indices: None })
}

fn joined(file: &str, vertices: usize, mut edges: Columns) -> Result<Layout, FormatError> {
    let rows = edges.rows;
    let mut ends = |name: &str| match edges.take(name).map(|(_, column)| column) {
        Some(Column::Int(values)) => Ok(values),
        Some(Column::Byte(values)) => Ok(values.into_iter().map(i32::from).collect()),
        _ => {
            let found = format!("an element `edge` without an integer `{name}`");
            Err(FormatError::invalid(file, "the header", found, "vertex1 and vertex2, each an int"))
        }
    };
    let (from, to) = (ends("vertex1")?, ends("vertex2")?);
    let mut chains = Chains::with_capacity(rows + 1);
    for (row, (&from, &to)) in from.iter().zip(&to).enumerate() {
        for end in [from, to] {
            if !usize::try_from(end).is_ok_and(|end| end < vertices) {
                let place = format!("row {row} of the element `edge`");
                let expected = format!("0 to {}, a vertex", vertices.saturating_sub(1));
                return Err(FormatError::invalid(file, place, format!("the vertex {end}"), expected));
            }
        }
        chains.segment(from as u32, to as u32);
    }
    // Edges that each name both of their ends use a vertex twice.
    chains.refuse_overuse(2 * vertices, vertices, file)?;
    assemble::offset(chains.len(), Format::Ply, file)?;
    let (offsets, indices) = chains.into_offsets();
    let indices = (!chains::in_order(&indices, vertices)).then_some(indices);
    Ok(Layout { offsets, indices })
}
