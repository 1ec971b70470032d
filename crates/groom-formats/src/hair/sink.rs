//! A HAIR file written a block of strands at a time.

use std::io::{Seek, Write};

use cyhair::{Field, HairWriter, Header, Strand};
use groom::{FloatView, Groom, UpAxis, Vec3View};

use super::hair_fault;
use super::write::{plain_header, set_arrays, transparency};
use crate::stream::{Counts, Sink};
use crate::{Format, FormatError, HairExtras, Warning, unstored};

pub(crate) struct HairSink<'a, W> {
    writer: HairWriter<W>,
    header: Header,
    name: &'a str,
    warnings: Vec<Warning>,
    scratch: Scratch,
}

/// Values of one strand that the groom holds otherwise.
#[derive(Default)]
struct Scratch {
    thickness: Vec<f32>,
    transparency: Vec<f32>,
    colors: Vec<[f32; 3]>,
}

impl<'a, W: Write + Seek> HairSink<'a, W> {
    /// Begins a file for strands with the attributes of `like`.
    pub(crate) fn begin(
        stream: W,
        name: &'a str,
        counts: Counts,
        extras: &HairExtras,
        like: &Groom,
    ) -> Result<Self, FormatError> {
        let mut header = plain_header(Some(extras));
        set_arrays(&mut header, like);
        if extras.segments_array {
            header.arrays |= Field::Segments.bit();
        }
        header.hair_count = counts.strands;
        header.point_count = counts.points;
        let writer = HairWriter::counting(stream, header).map_err(|source| hair_fault(name, source))?;
        let warnings = unstored::warnings(like, Format::Hair, UpAxis::Z);
        Ok(HairSink { writer, header, name, warnings, scratch: Scratch::default() })
    }
}

impl<W: Write + Seek> Sink for HairSink<'_, W> {
    fn push(&mut self, block: &Groom) -> Result<(), FormatError> {
        let (radii, transparency, colors) = (block.radii(), transparency(block), block.colors());
        let Scratch { thickness: twice, transparency: clear, colors: tints } = &mut self.scratch;
        let has = |field| self.header.has(field);
        for strand in 0..block.strand_count() {
            let range = block.strand_range(strand);
            let count = range.len();
            match radii {
                FloatView::Vertex(radii) => refill(twice, radii[range.clone()].iter().map(|r| 2.0 * r)),
                other => refill(twice, std::iter::repeat_n(2.0 * other.get(strand, 0), count)),
            }
            let clear = match transparency {
                FloatView::Vertex(values) => &values[range.clone()],
                other => {
                    refill(clear, std::iter::repeat_n(other.get(strand, 0), count));
                    &clear[..]
                }
            };
            let tints = match colors {
                Some(Vec3View::Vertex(colors)) => bytemuck::cast_slice(&colors[range]),
                Some(other) => {
                    refill(tints, std::iter::repeat_n(other.get(strand, 0).to_array(), count));
                    &tints[..]
                }
                None => &[],
            };
            let strand = Strand {
                points: Some(bytemuck::cast_slice(block.strand(strand))),
                thickness: has(Field::Thickness).then_some(twice),
                transparency: has(Field::Transparency).then_some(clear),
                colors: has(Field::Colors).then_some(tints),
            };
            self.writer.push(strand).map_err(|source| hair_fault(self.name, source))?;
        }
        Ok(())
    }

    fn finish(self: Box<Self>) -> Result<Vec<Warning>, FormatError> {
        self.writer.finish().map_err(|source| hair_fault(self.name, source))?;
        Ok(self.warnings)
    }
}

fn refill<T>(buffer: &mut Vec<T>, values: impl Iterator<Item = T>) {
    buffer.clear();
    buffer.extend(values);
}
