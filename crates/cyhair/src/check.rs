//! What a file must fulfil beyond its layout, and what is odd about it.

use crate::{Field, HairError, Header, Layout, Warning};

/// Refuses headers that cannot be true, before anything else is read.
///
/// With the file's length known this bounds every allocation by it.
pub(crate) fn header(header: &Header, file_bytes: Option<u64>) -> Result<Layout, HairError> {
    if header.hair_count == 0 {
        return Err(HairError::NoStrands);
    }
    let layout = header.layout();
    if let Some(len) = file_bytes {
        fits(&layout, len)?;
    }
    if !header.has(Field::Segments) {
        point_count(header, u64::from(header.hair_count) * (u64::from(header.default_segments) + 1))?;
    }
    Ok(layout)
}

/// Refuses a layout that does not fit in a file of `len` bytes.
fn fits(layout: &Layout, len: u64) -> Result<(), HairError> {
    for (field, span) in layout.spans() {
        let found = len.saturating_sub(span.offset);
        if found < span.bytes {
            return Err(HairError::Truncated { field, offset: span.offset, expected: span.bytes, found });
        }
    }
    Ok(())
}

/// Refuses a point count other than the `expected` sum of segments + 1.
pub(crate) fn point_count(header: &Header, expected: u64) -> Result<(), HairError> {
    let found = u64::from(header.point_count);
    if expected == found {
        return Ok(());
    }
    let field = if header.has(Field::Segments) { Field::Segments } else { Field::DefaultSegments };
    Err(HairError::PointCount { field, offset: field.header_offset(), expected, found })
}

/// Whether every value is finite; the loop has no branch, so that it runs at memory speed.
pub(crate) fn all_finite(values: &[f32]) -> bool {
    const INFINITE: u32 = 0x7f80_0000;
    let blocks = values.chunks(4096);
    blocks
        .map(|block| block.iter().fold(false, |bad, v| bad | (v.to_bits() & INFINITE == INFINITE)))
        .all(|bad| !bad)
}

/// Refuses points, the first being point `first` of the file, with a coordinate that is not finite.
pub(crate) fn points(values: &[[f32; 3]], first: u64, array_offset: u64) -> Result<(), HairError> {
    let flat: &[f32] = bytemuck::cast_slice(values);
    if all_finite(flat) {
        return Ok(());
    }
    match flat.iter().position(|v| !v.is_finite()) {
        None => Ok(()),
        Some(at) => Err(non_finite_point(first * 3 + at as u64, flat[at], array_offset)),
    }
}

/// The error for coordinate `index`, counted through the whole points array.
pub(crate) fn non_finite_point(index: u64, found: f32, array_offset: u64) -> HairError {
    let offset = array_offset + index * 4;
    HairError::NonFinitePoint { offset, point: index / 3, component: (index % 3) as u8, found }
}

/// What is odd about the header alone.
pub(crate) fn header_warnings(header: &Header) -> Vec<Warning> {
    let mut warnings = Vec::new();
    let bits = header.arrays & !crate::KNOWN_ARRAYS;
    if bits != 0 {
        warnings.push(Warning::UnknownArrays { bits });
    }
    if !header.has(Field::Points) {
        warnings.push(Warning::MissingPoints);
    }
    let mut default = |array, field, values: &[f32]| {
        if let Some(&found) = values.iter().find(|v| !v.is_finite()).filter(|_| !header.has(array)) {
            warnings.push(Warning::NonFiniteDefault { field, found });
        }
    };
    default(Field::Thickness, Field::DefaultThickness, &[header.default_thickness]);
    default(Field::Transparency, Field::DefaultTransparency, &[header.default_transparency]);
    default(Field::Colors, Field::DefaultColor, &header.default_color);
    warnings
}

/// Collects what is odd about the arrays, piece by piece and in file order.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Oddities {
    one_point: Tally,
    no_length: Tally,
    not_finite: [Tally; 5],
}

/// How many of something there are, and where the first is.
#[derive(Clone, Copy, Debug, Default)]
struct Tally {
    count: u64,
    first: u64,
}

impl Tally {
    fn add(&mut self, place: u64) {
        if self.count == 0 {
            self.first = place;
        }
        self.count += 1;
    }
}

impl Oddities {
    /// Notes that strand `strand` has a single point.
    pub(crate) fn one_point_strand(&mut self, strand: u64) {
        self.one_point.add(strand);
    }

    /// Notes `count` strands with a single point, from the first strand on.
    pub(crate) fn only_one_point_strands(&mut self, count: u64) {
        self.one_point = Tally { count, first: 0 };
    }

    /// Notes the segments without length of one strand, whose first point is `first` of the file.
    pub(crate) fn strand(&mut self, first: u64, points: &[[f32; 3]]) {
        for (i, pair) in points.windows(2).enumerate() {
            if pair[0] == pair[1] {
                self.no_length.add(first + i as u64 + 1);
            }
        }
    }

    /// Notes values that are not finite; the first of them is value `first` of the array, in floats.
    pub(crate) fn values(&mut self, field: Field, first: u64, values: &[f32]) {
        if all_finite(values) {
            return;
        }
        let slot = field.bit().trailing_zeros() as usize;
        for (i, _) in values.iter().enumerate().filter(|(_, v)| !v.is_finite()) {
            self.not_finite[slot].add(first + i as u64);
        }
    }

    /// The warnings this makes.
    pub(crate) fn warnings(&self, layout: &Layout) -> Vec<Warning> {
        let mut warnings = Vec::new();
        if self.one_point.count > 0 {
            let Tally { count, first: first_strand } = self.one_point;
            warnings.push(Warning::OnePointStrands { count, first_strand });
        }
        if self.no_length.count > 0 {
            let Tally { count, first: first_point } = self.no_length;
            warnings.push(Warning::ZeroLengthSegments { count, first_point });
        }
        for (tally, field) in self.not_finite.iter().zip(Field::ARRAYS) {
            if let Some(span) = layout.span(field).filter(|_| tally.count > 0) {
                let offset = span.offset + 4 * tally.first;
                warnings.push(Warning::NonFiniteValues { field, offset, count: tally.count });
            }
        }
        warnings
    }
}

/// Whether two neighbours among all points coincide, strands not considered.
pub(crate) fn neighbours_coincide(points: &[[f32; 3]]) -> bool {
    let same = |a: &[f32; 3], b: &[f32; 3]| (a[0] == b[0]) & (a[1] == b[1]) & (a[2] == b[2]);
    points.iter().zip(points.iter().skip(1)).fold(false, |any, (a, b)| any | same(a, b))
}
