//! PLY strands written as they come.

use std::io::Write;

use glam::Vec3;
use groom::UpAxis;

use crate::bytes::write_points;
use crate::{Format, FormatError};

/// The most segments hairutil's `ushort` can count.
const MOST: u64 = u16::MAX as u64;

/// What a file holds beside positions.
#[derive(Clone, Debug)]
pub(crate) struct Layout {
    pub(crate) strands: u64,
    pub(crate) points: u64,
    pub(crate) up_axis: UpAxis,
    pub(crate) meters_per_unit: f64,
    /// Types and names of further properties of a vertex.
    pub(crate) vertex: Vec<(&'static str, String)>,
    /// As `vertex`, of a strand.
    pub(crate) strand: Vec<(&'static str, String)>,
    /// As `vertex`, of the whole groom.
    pub(crate) whole: Vec<(&'static str, String)>,
}

impl Layout {
    fn header(&self) -> String {
        let axis = match self.up_axis {
            UpAxis::Y => "y",
            UpAxis::Z => "z",
        };
        let mut text = format!(
            "ply\nformat binary_little_endian 1.0\ncomment Written by groomkit {}\ncomment up_axis {axis}\n\
             comment meters_per_unit {}\nelement vertex {}\n",
            env!("CARGO_PKG_VERSION"),
            self.meters_per_unit,
            self.points
        );
        let mut properties = |head: &str, list: &[(&str, String)]| {
            text += head;
            list.iter().for_each(|(kind, name)| text += &format!("property {kind} {name}\n"));
        };
        properties("property float x\nproperty float y\nproperty float z\n", &self.vertex);
        properties(&format!("element strand {}\nproperty ushort nsegs\n", self.strands), &self.strand);
        if !self.whole.is_empty() {
            properties("element groom 1\n", &self.whole);
        }
        text + "end_header\n"
    }
}

/// Writes strands as they come; their number and that of their points must be known before.
///
/// The number of segments of every strand comes at the end of the file: two bytes a strand are kept in memory.
pub(crate) struct PlyWriter<'a, W: Write> {
    stream: &'a mut W,
    file: &'a str,
    layout: Layout,
    points: u64,
    /// Segments of the strands that came.
    segments: Vec<u16>,
    record: Vec<u8>,
}

impl<'a, W: Write> PlyWriter<'a, W> {
    /// Starts a file; `file` stands for it in messages. The stream should be buffered.
    pub(crate) fn begin(stream: &'a mut W, file: &'a str, layout: Layout) -> Result<Self, FormatError> {
        stream.write_all(layout.header().as_bytes()).map_err(|e| FormatError::io(file, e))?;
        Ok(PlyWriter { stream, file, layout, points: 0, segments: Vec::new(), record: Vec::new() })
    }

    /// The next strand; `rest` appends what the layout has behind the position of a point, little endian.
    pub(crate) fn push_with(
        &mut self,
        points: &[Vec3],
        mut rest: impl FnMut(usize, &mut Vec<u8>),
    ) -> Result<(), FormatError> {
        let segments = points.len().saturating_sub(1) as u64;
        let Ok(count) = u16::try_from(segments) else {
            return Err(FormatError::TooLarge {
                file: self.file.to_owned(),
                format: Format::Ply,
                what: "segments of a strand",
                found: segments,
                limit: MOST,
            });
        };
        self.segments.push(count);
        self.points += points.len() as u64;
        let written = if self.layout.vertex.is_empty() {
            write_points(self.stream, points)
        } else {
            self.record.clear();
            for (index, point) in points.iter().enumerate() {
                self.record.extend_from_slice(&le_bytes(*point));
                rest(index, &mut self.record);
            }
            self.stream.write_all(&self.record)
        };
        written.map_err(|e| FormatError::io(self.file, e))
    }

    /// Ends the file; `rest` appends what the layout has behind `nsegs` of a strand, `whole` is the groom's row.
    pub(crate) fn finish_with(
        mut self,
        mut rest: impl FnMut(usize, &mut Vec<u8>),
        whole: &[u8],
    ) -> Result<(), FormatError> {
        if (self.segments.len() as u64, self.points) != (self.layout.strands, self.layout.points) {
            let found = format!("{} strands of {} points", self.segments.len(), self.points);
            let expected = format!("{} of {}, as promised", self.layout.strands, self.layout.points);
            return Err(FormatError::invalid(self.file, "the header", found, expected));
        }
        let fault = |e| FormatError::io(self.file, e);
        for (strand, count) in self.segments.iter().enumerate() {
            self.record.clear();
            self.record.extend(count.to_le_bytes());
            rest(strand, &mut self.record);
            self.stream.write_all(&self.record).map_err(fault)?;
        }
        self.stream.write_all(whole).map_err(fault)
    }
}

fn le_bytes(point: Vec3) -> [u8; 12] {
    let [x, y, z] = point.to_array().map(f32::to_le_bytes);
    std::array::from_fn(|i| [x, y, z][i / 4][i % 4])
}
