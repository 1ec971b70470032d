//! A groom as a HAIR file, straight from its arrays.

use std::io::Write;

use cyhair::{ArrayWriter, Field, HairError, Header};
use glam::Vec3;
use groom::{Attribute, FloatView, Groom, UpAxis, Vec3View, names};

use super::hair_fault;
use crate::{Format, FormatError, HairExtras, Warning, WriteOptions, unstored};

/// The largest number of segments the array of a HAIR file can hold.
const MOST_SEGMENTS: u64 = u16::MAX as u64;

/// Values that are doubled or spread go to the file in blocks of this many.
const BLOCK: usize = 1 << 14;

pub(crate) fn write(
    groom: &Groom,
    stream: &mut impl Write,
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    if groom.strand_count() == 0 {
        return Err(FormatError::Empty { file: name.to_owned(), format: Format::Hair, points: 1 });
    }
    let (header, segments_array) = header_of(groom, name, options.hair.as_ref())?;
    write_arrays(groom, stream, header, segments_array).map_err(|source| hair_fault(name, source))?;
    Ok(unstored::warnings(groom, Format::Hair, UpAxis::Z))
}

/// Writes straight from the groom's arrays; what the file has otherwise goes by in blocks.
fn write_arrays(
    groom: &Groom,
    stream: &mut impl Write,
    header: Header,
    segments_array: bool,
) -> Result<(), HairError> {
    let mut file = ArrayWriter::new(stream, header)?;
    if segments_array {
        in_blocks(segments(groom).map(|count| count as u16), |block| file.segments(block))?;
    }
    file.points(bytemuck::cast_slice(groom.positions()))?;
    let double = |radius: f32| 2.0 * radius;
    match groom.radii() {
        FloatView::Constant(_) => {}
        FloatView::Vertex(radii) => {
            in_blocks(radii.iter().copied().map(double), |block| file.thickness(block))?;
        }
        FloatView::Strand(radii) => {
            in_blocks(spread(groom, radii).map(double), |block| file.thickness(block))?;
        }
    }
    match transparency(groom) {
        FloatView::Constant(_) => {}
        FloatView::Vertex(values) => file.transparency(values)?,
        FloatView::Strand(values) => {
            in_blocks(spread(groom, values), |block| file.transparency(block))?;
        }
    }
    match groom.colors() {
        None | Some(Vec3View::Constant(_)) => {}
        Some(Vec3View::Vertex(colors)) => file.colors(bytemuck::cast_slice(colors))?,
        Some(Vec3View::Strand(colors)) => {
            in_blocks(spread(groom, colors), |block| file.colors(bytemuck::cast_slice(block)))?;
        }
    }
    file.finish().map(drop)
}

pub(super) fn transparency(groom: &Groom) -> FloatView<'_> {
    let view = groom.attribute(names::TRANSPARENCY).and_then(Attribute::float_view);
    view.unwrap_or(FloatView::Constant(0.0))
}

/// The header, and whether there is an array of segments.
fn header_of(groom: &Groom, name: &str, extras: Option<&HairExtras>) -> Result<(Header, bool), FormatError> {
    let mut header = plain_header(extras);
    let segments_array = set_segments(&mut header, groom, name, extras)?;
    set_arrays(&mut header, groom);
    let limited = |what, found: usize| {
        u32::try_from(found).map_err(|_| FormatError::TooLarge {
            file: name.to_owned(),
            format: Format::Hair,
            what,
            found: found as u64,
            limit: u32::MAX.into(),
        })
    };
    header.hair_count = limited("strands", groom.strand_count())?;
    header.point_count = limited("points", groom.point_count())?;
    Ok((header, segments_array))
}

/// Announces the arrays that the attributes of `groom` make, and takes constants for defaults.
pub(super) fn set_arrays(header: &mut Header, groom: &Groom) {
    header.arrays |= Field::Points.bit();
    match groom.radii() {
        FloatView::Constant(radius) => header.default_thickness = 2.0 * radius,
        _ => header.arrays |= Field::Thickness.bit(),
    }
    match transparency(groom) {
        FloatView::Constant(value) => header.default_transparency = value,
        _ => header.arrays |= Field::Transparency.bit(),
    }
    match groom.colors() {
        None => header.default_color = Header::default().default_color,
        Some(Vec3View::Constant(color)) => header.default_color = color.to_array(),
        Some(_) => header.arrays |= Field::Colors.bit(),
    }
}

/// A header without counts and arrays.
pub(super) fn plain_header(extras: Option<&HairExtras>) -> Header {
    let mut header = Header { arrays: 0, ..Header::default() };
    match extras {
        Some(extras) => {
            header.info = extras.info;
            header.default_segments = extras.default_segments;
            header.default_thickness = extras.default_thickness;
            header.default_transparency = extras.default_transparency;
            header.default_color = extras.default_color;
        }
        None => header.set_info_text(concat!("Written by groomkit ", env!("CARGO_PKG_VERSION"))),
    }
    header
}

/// Strands that are all alike need no array; one that was there is kept while it fits. Tells whether there
/// is one.
fn set_segments(
    header: &mut Header,
    groom: &Groom,
    name: &str,
    extras: Option<&HairExtras>,
) -> Result<bool, FormatError> {
    let most = segments(groom).max().unwrap_or(0);
    let alike = segments(groom).all(|count| count == most);
    let wants_array = extras.is_some_and(|extras| extras.segments_array);
    if alike && (!wants_array || u64::from(most) > MOST_SEGMENTS) {
        header.default_segments = most;
        return Ok(false);
    }
    if u64::from(most) > MOST_SEGMENTS {
        return Err(FormatError::TooLarge {
            file: name.to_owned(),
            format: Format::Hair,
            what: "segments of a strand",
            found: most.into(),
            limit: MOST_SEGMENTS,
        });
    }
    header.arrays |= Field::Segments.bit();
    Ok(true)
}

fn segments(groom: &Groom) -> impl Iterator<Item = u32> {
    groom.offsets().windows(2).map(|pair| pair[1] - pair[0] - 1)
}

/// Every strand's value once for each of its points.
fn spread<T: Copy>(groom: &Groom, values: &[T]) -> impl Iterator<Item = T> {
    let lengths = groom.strands().map(<[Vec3]>::len);
    lengths.zip(values).flat_map(|(length, &value)| std::iter::repeat_n(value, length))
}

/// Hands values that lie nowhere to `put`, a block at a time.
fn in_blocks<T>(
    mut values: impl Iterator<Item = T>,
    mut put: impl FnMut(&[T]) -> Result<(), HairError>,
) -> Result<(), HairError> {
    let mut block = Vec::with_capacity(BLOCK);
    loop {
        block.clear();
        block.extend(values.by_ref().take(BLOCK));
        if block.is_empty() {
            return Ok(());
        }
        put(&block)?;
    }
}
