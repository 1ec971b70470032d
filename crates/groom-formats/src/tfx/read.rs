//! TressFX strands as a groom.

use glam::{Vec2, Vec3};
use groom::{Attribute, Domain, UpAxis, Values, names};

use super::header::{Header, Place};
use crate::assemble::{self, Parts, per_strand, per_vertex};
use crate::bytes::{self, Bytes};
use crate::{Format, FormatError, Loaded, ReadOptions};

pub(crate) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let header = Header::read(&mut Bytes::new(name, bytes))?;
    let file = File { name, bytes, header };
    let positions = file.positions()?;
    let stride = 4 * header.width;
    let vertices = u64::from(header.strands) * u64::from(header.vertices_per_strand);
    // The bytes of the positions are there, so the points can be counted.
    assemble::offset(vertices as usize, Format::Tfx, name)?;
    let offsets = (0..=header.strands).map(|strand| strand * header.vertices_per_strand).collect();
    let parts = Parts {
        file: name,
        format: Format::Tfx,
        up_axis: UpAxis::Y,
        offsets,
        positions: bytes::points(positions, stride).collect(),
        attributes: file.attributes(positions)?,
        warnings: Vec::new(),
    };
    let start = header.positions.offset as usize;
    parts.load(options, |point| format!("byte {} (point {point})", start + stride * point))
}

struct File<'a> {
    name: &'a str,
    bytes: &'a [u8],
    header: Header,
}

impl<'a> File<'a> {
    fn positions(&self) -> Result<&'a [u8], FormatError> {
        let Header { positions, width, .. } = self.header;
        if !positions.is_there() {
            let expected = format!("the offset of the positions, {} or more", self.header.bytes);
            return Err(self.fault(positions, expected));
        }
        self.array(positions, self.vertices(), 4 * width, "positions")
    }

    fn attributes(&self, positions: &[u8]) -> Result<Vec<(String, Attribute)>, FormatError> {
        let header = self.header;
        let mut found = Vec::new();
        let mut add = |name: &str, attribute| found.push((name.to_owned(), attribute));
        if header.width == 4 {
            let masses: Vec<f32> = positions.chunks_exact(16).map(|p| bytes::vec3_at(p, 12).x).collect();
            let pinned = masses.iter().map(|&mass| i32::from(mass == 0.0)).collect();
            add("pinned", per_vertex(Values::Int(pinned)));
            if masses.iter().any(|&mass| mass != 0.0 && mass != 1.0) {
                add("inverse_mass", per_vertex(Values::Float(masses)));
            }
        }
        for (name, value) in [
            ("both_ends_immovable", i32::from(header.both_ends_immovable)),
            ("follow_strands", header.follow_strands as i32),
        ] {
            if value != 0 {
                add(name, Attribute { domain: Domain::Groom, values: Values::Int(vec![value]) });
            }
        }
        let strands = u64::from(header.strands);
        if let Some(bytes) = self.optional(header.strand_uvs, strands, 8, "texture coordinates of strands")? {
            add(names::ROOT_UV, per_strand(Values::Vec2(pairs(bytes))));
        }
        if let Some(bytes) = self.optional(header.vertex_uvs, self.vertices(), 8, "texture coordinates")? {
            add("uv", per_vertex(Values::Vec2(pairs(bytes))));
        }
        if let Some(bytes) = self.optional(header.thickness, strands, 4, "thickness of strands")? {
            add("thickness", per_strand(Values::Float(bytes::floats(bytes).collect())));
        }
        if let Some(bytes) = self.optional(header.colors, self.vertices(), 16, "colours")? {
            let colors: Vec<Vec3> = bytes::points(bytes, 16).collect();
            let clear = bytes.chunks_exact(16).map(|color| 1.0 - bytes::vec3_at(color, 12).x);
            add(names::COLOR, per_vertex(Values::Vec3(colors)));
            add(names::TRANSPARENCY, per_vertex(Values::Float(clear.collect())));
        }
        if let Some(bytes) = self.optional(header.guides, strands, 4, "guides of strands")? {
            let guides = bytes::floats(bytes).map(|word| word.to_bits() as i32).collect();
            add("guide_index", per_strand(Values::Int(guides)));
        }
        Ok(found)
    }

    fn vertices(&self) -> u64 {
        u64::from(self.header.strands) * u64::from(self.header.vertices_per_strand)
    }

    fn optional(
        &self,
        place: Place,
        count: u64,
        each: usize,
        what: &str,
    ) -> Result<Option<&'a [u8]>, FormatError> {
        if place.is_there() { self.array(place, count, each, what).map(Some) } else { Ok(None) }
    }

    /// `count` values of `each` bytes, all of them in the file and after the header.
    fn array(&self, place: Place, count: u64, each: usize, what: &str) -> Result<&'a [u8], FormatError> {
        let length = count.saturating_mul(each as u64);
        let start = place.offset as usize;
        let end = usize::try_from(length).ok().and_then(|length| start.checked_add(length));
        let found = end.and_then(|end| self.bytes.get(start..end)).filter(|_| start >= self.header.bytes);
        found.ok_or_else(|| {
            let expected = format!(
                "an offset from {} on, after which there are {length} bytes of {what} in a file of {}",
                self.header.bytes,
                self.bytes.len()
            );
            self.fault(place, expected)
        })
    }

    fn fault(&self, place: Place, expected: String) -> FormatError {
        let found = format!("the offset {}", place.offset);
        FormatError::invalid(self.name, format!("byte {}", place.field), found, expected)
    }
}

fn pairs(bytes: &[u8]) -> Vec<Vec2> {
    bytes.chunks_exact(8).map(|pair| bytes::vec3_at(pair, 0).truncate()).collect()
}
