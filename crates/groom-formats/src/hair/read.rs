//! A HAIR file as a groom.

use std::io::Read;

use cyhair::{Field, HairError, HairFile, Header};
use glam::Vec3;
use groom::{Attribute, Domain, Groom, GroomError, UpAxis, Values, names};

use crate::{Format, FormatError, HairExtras, Loaded, ReadOptions, Warning};

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
    let extras = extras_of(&file.header);
    let groom = groom_of(file, name, options)?;
    let warnings = warnings.into_iter().map(Warning::Hair).collect();
    Ok(Loaded { warnings, repairs, hair: Some(extras), ..Loaded::still(groom) })
}

/// `cyhair`'s errors of the system are told as such, so that a closed pipe is seen for one.
pub(super) fn hair_fault(name: &str, source: HairError) -> FormatError {
    match source {
        HairError::Io { source, .. } => FormatError::io(name, source),
        source => FormatError::Hair { file: name.to_owned(), source },
    }
}

pub(super) fn extras_of(header: &Header) -> HairExtras {
    HairExtras {
        info: header.info,
        segments_array: header.has(Field::Segments),
        default_segments: header.default_segments,
        default_thickness: header.default_thickness,
        default_transparency: header.default_transparency,
        default_color: header.default_color,
    }
}

/// Without points a header may promise 2^32 strands that no byte of the file stands for.
pub(super) fn refuse_pointless(header: &Header, name: &str) -> Result<(), FormatError> {
    if header.has(Field::Points) {
        return Ok(());
    }
    let what = "has no points array, so there are no strands to read";
    Err(FormatError::Unsupported { file: name.to_owned(), format: Format::Hair, what })
}

/// The groom of a file whose header agrees with its arrays.
pub(super) fn groom_of(file: HairFile, name: &str, options: &ReadOptions) -> Result<Groom, FormatError> {
    refuse_pointless(&file.header, name)?;
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
    groom.up_axis = options.up_axis.unwrap_or(UpAxis::Z);
    groom.meters_per_unit = options.meters_per_unit.unwrap_or(1.0);
    Ok(groom)
}
