//! HAIR files as grooms: the bytes are `cyhair`'s, their meaning is given here.
//!
//! Thickness is a diameter and becomes a radius; a default becomes a constant attribute, an array one
//! per vertex. Numbers are kept as they are: the file has no unit and no up axis, and z is taken for
//! up, as in Yuksel's models. Halving and doubling are exact, so a file read and written comes out with
//! the same bytes (but for thickness below 2^-125, whose last bit halving loses, and what `cyhair`
//! warns of).

use std::io::{Read, Write};

use cyhair::{HairError, HairFile, Header};
use glam::Vec3;
use groom::{Attribute, Domain, FloatView, Groom, GroomError, UpAxis, Values, Vec3View, names};

use crate::{Format, FormatError, HairExtras, Loaded, ReadOptions, Warning, WriteOptions, unstored};

/// The largest number of segments the array of a HAIR file can hold.
const MOST_SEGMENTS: u64 = u16::MAX as u64;

pub(crate) fn read(stream: impl Read, name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let fault = |source| hair_fault(name, source);
    let mut repairs = Vec::new();
    let (file, warnings) = if options.repair {
        let repaired = HairFile::read_and_repair(stream).map_err(fault)?;
        repairs.extend(repaired.repairs.iter().map(ToString::to_string));
        (repaired.file, Vec::new())
    } else {
        let loaded = HairFile::read(stream, options.known_len).map_err(fault)?;
        (loaded.file, loaded.warnings)
    };
    let extras = extras_of(&file);
    let mut groom = groom_of(file, name)?;
    groom.up_axis = options.up_axis.unwrap_or(UpAxis::Z);
    groom.meters_per_unit = options.meters_per_unit.unwrap_or(1.0);
    let warnings = warnings.into_iter().map(Warning::Hair).collect();
    Ok(Loaded { warnings, repairs, hair: Some(extras), ..Loaded::still(groom) })
}

/// `cyhair`'s errors of the system are told as such, so that a closed pipe is seen for one.
fn hair_fault(name: &str, source: HairError) -> FormatError {
    match source {
        HairError::Io { source, .. } => FormatError::io(name, source),
        source => FormatError::Hair { file: name.to_owned(), source },
    }
}

fn extras_of(file: &HairFile) -> HairExtras {
    let header = &file.header;
    HairExtras {
        info: header.info,
        segments_array: file.segments.is_some(),
        default_segments: header.default_segments,
        default_thickness: header.default_thickness,
        default_transparency: header.default_transparency,
        default_color: header.default_color,
    }
}

fn groom_of(file: HairFile, name: &str) -> Result<Groom, FormatError> {
    // First: without points a header may promise 2^32 strands that no byte of the file stands for.
    if file.points.is_none() {
        let what = "has no points array, so there are no strands to read";
        return Err(FormatError::Unsupported { file: name.to_owned(), format: Format::Hair, what });
    }
    let mut offsets = Vec::with_capacity(file.strand_count() + 1);
    offsets.push(0);
    // cyhair has checked that the ranges end at the point count, which is a u32.
    offsets.extend(file.strand_ranges().map(|range| range.end as u32));
    let HairFile { header, points, thickness, transparency, colors, .. } = file;
    let points = points.unwrap_or_default();
    let fault = |source: GroomError| FormatError::groom(name, source);
    // The same bytes under another name: nothing is copied.
    let mut groom = Groom::new(offsets, bytemuck::cast_vec::<[f32; 3], Vec3>(points)).map_err(fault)?;
    let radius = thickness.map(|mut values| {
        values.iter_mut().for_each(|value| *value *= 0.5);
        values
    });
    let floats = |array: Option<Vec<f32>>, constant| match array {
        Some(values) => Attribute { domain: Domain::Vertex, values: Values::Float(values) },
        None => Attribute::constant_float(constant),
    };
    groom.set_attribute(names::RADIUS, floats(radius, header.default_thickness * 0.5)).map_err(fault)?;
    let transparency = floats(transparency, header.default_transparency);
    groom.set_attribute(names::TRANSPARENCY, transparency).map_err(fault)?;
    let color = match colors {
        Some(values) => {
            let values = Values::Vec3(bytemuck::cast_vec::<[f32; 3], Vec3>(values));
            Attribute { domain: Domain::Vertex, values }
        }
        None => Attribute::constant_vec3(header.default_color.into()),
    };
    groom.set_attribute(names::COLOR, color).map_err(fault)?;
    Ok(groom)
}

pub(crate) fn write(
    groom: &Groom,
    stream: &mut impl Write,
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    if groom.strand_count() == 0 {
        return Err(FormatError::Empty { file: name.to_owned(), format: Format::Hair, points: 1 });
    }
    let file = file_of(groom, name, options.hair.as_ref())?;
    file.write(stream).map_err(|source| hair_fault(name, source))?;
    Ok(unstored::warnings(groom, Format::Hair, UpAxis::Z))
}

fn file_of(groom: &Groom, name: &str, extras: Option<&HairExtras>) -> Result<HairFile, FormatError> {
    let mut file = HairFile { header: header_of(extras), ..HairFile::default() };
    set_segments(&mut file, groom, name, extras)?;
    file.points = Some(bytemuck::cast_slice(groom.positions()).to_vec());
    match per_vertex(groom, groom.radii()) {
        Ok(mut values) => {
            values.iter_mut().for_each(|value| *value *= 2.0);
            file.thickness = Some(values);
        }
        Err(constant) => file.header.default_thickness = 2.0 * constant,
    }
    let transparency = groom.attribute(names::TRANSPARENCY).and_then(Attribute::float_view);
    match per_vertex(groom, transparency.unwrap_or(FloatView::Constant(0.0))) {
        Ok(values) => file.transparency = Some(values),
        Err(constant) => file.header.default_transparency = constant,
    }
    match groom.colors() {
        None => file.header.default_color = Header::default().default_color,
        Some(Vec3View::Constant(color)) => file.header.default_color = color.to_array(),
        Some(Vec3View::Vertex(colors)) => file.colors = Some(bytemuck::cast_slice(colors).to_vec()),
        Some(Vec3View::Strand(colors)) => {
            let expanded = spread(groom, colors).map(|color| color.to_array());
            file.colors = Some(expanded.collect());
        }
    }
    file.sync_header();
    // Arrays tell this only when there are segments among them.
    file.header.hair_count = groom.strand_count() as u32;
    Ok(file)
}

fn header_of(extras: Option<&HairExtras>) -> Header {
    let mut header = Header::default();
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

/// Strands that are all alike need no array; one that was there is kept while it fits.
fn set_segments(
    file: &mut HairFile,
    groom: &Groom,
    name: &str,
    extras: Option<&HairExtras>,
) -> Result<(), FormatError> {
    let counts = || groom.offsets().windows(2).map(|pair| pair[1] - pair[0] - 1);
    let most = counts().max().unwrap_or(0);
    let alike = counts().all(|count| count == most);
    let wants_array = extras.is_some_and(|extras| extras.segments_array);
    if alike && (!wants_array || u64::from(most) > MOST_SEGMENTS) {
        file.header.default_segments = most;
        return Ok(());
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
    file.segments = Some(counts().map(|count| count as u16).collect());
    Ok(())
}

/// One value a point, or the constant they all are.
fn per_vertex(groom: &Groom, view: FloatView<'_>) -> Result<Vec<f32>, f32> {
    match view {
        FloatView::Constant(value) => Err(value),
        FloatView::Vertex(values) => Ok(values.to_vec()),
        FloatView::Strand(values) => Ok(spread(groom, values).collect()),
    }
}

/// Every strand's value once for each of its points.
fn spread<T: Copy>(groom: &Groom, values: &[T]) -> impl Iterator<Item = T> {
    let lengths = groom.strands().map(<[Vec3]>::len);
    lengths.zip(values).flat_map(|(length, &value)| std::iter::repeat_n(value, length))
}
