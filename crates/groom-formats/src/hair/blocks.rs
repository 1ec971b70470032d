//! A HAIR file as grooms of some of its strands, in memory that does not grow with them.

use std::io::{Read, Seek};

use cyhair::{Field, HairFile, HairReader, Header};
use groom::Groom;

use super::hair_fault;
use super::read::{extras_of, groom_of, refuse_pointless};
use crate::{FormatError, HairExtras, ReadOptions, Warning};

/// Strands are gathered up to this many points: about a megabyte.
const POINTS: usize = 1 << 15;

/// Reads a HAIR file a block of strands at a time; all blocks have the same attributes.
pub(crate) struct Blocks<'a, R> {
    reader: HairReader<R>,
    name: &'a str,
    options: &'a ReadOptions,
}

impl<'a, R: Read + Seek> Blocks<'a, R> {
    pub(crate) fn new(file: R, name: &'a str, options: &'a ReadOptions) -> Result<Self, FormatError> {
        let reader = HairReader::new(file).map_err(|source| hair_fault(name, source))?;
        refuse_pointless(reader.header(), name)?;
        Ok(Blocks { reader, name, options })
    }

    pub(crate) fn header(&self) -> &Header {
        self.reader.header()
    }

    pub(crate) fn extras(&self) -> HairExtras {
        extras_of(self.reader.header())
    }

    /// The next strands, whole ones and at least one; `None` after the last.
    pub(crate) fn next(&mut self) -> Result<Option<Groom>, FormatError> {
        let header = *self.reader.header();
        let announced = |field| header.has(field);
        let mut segments = announced(Field::Segments).then(Vec::new);
        let mut points = Vec::new();
        let mut thickness = announced(Field::Thickness).then(Vec::new);
        let mut transparency = announced(Field::Transparency).then(Vec::new);
        let mut colors = announced(Field::Colors).then(Vec::new);
        let mut strands = 0;
        while points.len() < POINTS {
            let strand = self.reader.next_strand().map_err(|source| hair_fault(self.name, source))?;
            let Some(strand) = strand else { break };
            let of_strand = strand.points.unwrap_or_default();
            strands += 1;
            points.extend_from_slice(of_strand);
            if let Some(segments) = &mut segments {
                // The number came from a u16, and a strand has a point more than segments.
                segments.push((of_strand.len() - 1) as u16);
            }
            extend(&mut thickness, strand.thickness);
            extend(&mut transparency, strand.transparency);
            extend(&mut colors, strand.colors);
        }
        if strands == 0 {
            return Ok(None);
        }
        let header = Header { hair_count: strands, point_count: points.len() as u32, ..header };
        let file = HairFile { header, segments, points: Some(points), thickness, transparency, colors };
        groom_of(file, self.name, self.options).map(Some)
    }

    /// What is odd about what was read so far.
    pub(crate) fn warnings(&self) -> Vec<Warning> {
        self.reader.warnings().into_iter().map(Warning::Hair).collect()
    }
}

fn extend<T: Copy>(array: &mut Option<Vec<T>>, more: Option<&[T]>) {
    if let Some(array) = array {
        array.extend_from_slice(more.unwrap_or_default());
    }
}
