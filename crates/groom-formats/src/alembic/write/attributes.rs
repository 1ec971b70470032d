//! Attributes as geometry parameters.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::io::{Seek, Write};

use groom::{Attribute, Domain, FloatView, Values, names};
use ogawa::{ArchiveWriter, Compound, DataType, OgawaError, Property, StoredSample};

use super::curves::CurvesWriter;
use super::{guides, spread};
use crate::alembic::schema;
use crate::{Dialect, Format, Warning};

/// What the attributes became.
#[derive(Default)]
pub(super) struct Parameters {
    /// `width` and `uv`, which are the curves' own.
    pub(super) native: Vec<Property>,
    pub(super) arbitrary: Compound,
    /// Attributes that were spread over the points, with the domain they had.
    pub(super) domains: Vec<(String, Domain)>,
}

/// Writes every attribute but the velocities.
pub(super) fn write<W: Write + Seek>(
    curves: &mut CurvesWriter<'_, W>,
    warnings: &mut Vec<Warning>,
) -> Result<Parameters, OgawaError> {
    let mut parameters = Parameters::default();
    let groom = curves.groom;
    let standard = schema::PARAMETERS.iter().filter(|(name, _)| groom.attribute(name).is_some());
    let mut used: BTreeSet<String> = standard.map(|(_, written)| (*written).to_owned()).collect();
    used.insert(schema::GROOM_WIDTH.to_owned());
    let closest = guides::closest(groom);
    if closest.is_some() {
        used.extend([schema::CLOSEST_GUIDES, schema::GUIDE_WEIGHTS, schema::GROOM_ID].map(str::to_owned));
    }
    for (name, attribute) in groom.attributes() {
        match name {
            names::RADIUS => width(curves, attribute, &mut parameters)?,
            names::VELOCITY if attribute.domain == Domain::Vertex => {}
            names::CLOSEST_GUIDE if closest.is_some() => {}
            _ => {
                let standard = schema::PARAMETERS.iter().find(|(other, _)| *other == name);
                let written = match standard {
                    Some((_, written)) => (*written).to_owned(),
                    None => free_name(name, &mut used, warnings),
                };
                parameter(curves, name, &written, attribute, &mut parameters)?;
            }
        }
    }
    if let Some(ids) = closest {
        guides::write(groom, ids, &mut curves.archive, &mut parameters.arbitrary)?;
    }
    Ok(parameters)
}

/// `name`, made fit for Alembic and unlike the others.
fn free_name(name: &str, used: &mut BTreeSet<String>, warnings: &mut Vec<Warning>) -> String {
    let mut plain = name.replace(['/', '\0'], "_");
    if plain.is_empty() {
        plain.push('_');
    }
    let mut written = plain.clone();
    let mut number = 2;
    while !used.insert(written.clone()) {
        written = format!("{plain}_{number}");
        number += 1;
    }
    if written != name {
        let (name, written) = (name.to_owned(), written.clone());
        warnings.push(Warning::AttributeRenamed { format: Format::Alembic, name, written });
    }
    written
}

fn width<W: Write + Seek>(
    curves: &mut CurvesWriter<'_, W>,
    attribute: &Attribute,
    parameters: &mut Parameters,
) -> Result<(), OgawaError> {
    let Some(view) = attribute.float_view() else { return Ok(()) };
    let values = match view {
        FloatView::Constant(value) => Cow::Owned(vec![value]),
        FloatView::Strand(values) | FloatView::Vertex(values) => Cow::Borrowed(values),
    };
    let unreal = curves.dialect == Some(Dialect::Unreal);
    let mut domain = attribute.domain;
    let mut values = if unreal || domain == Domain::Vertex {
        values
    } else {
        parameters.domains.push((names::RADIUS.to_owned(), domain));
        let spread = spread::over_points(curves.groom, domain, &values);
        domain = Domain::Vertex;
        Cow::Owned(spread)
    };
    values.to_mut().iter_mut().for_each(|radius| *radius = curves.space.diameter(*radius));
    let sample = curves.archive.values(&values)?;
    parameters.native.push(geometry(schema::WIDTH, DataType::F32, domain, sample));
    if unreal {
        parameters.arbitrary.push(geometry(schema::GROOM_WIDTH, DataType::F32, domain, sample));
    }
    Ok(())
}

fn parameter<W: Write + Seek>(
    curves: &mut CurvesWriter<'_, W>,
    name: &str,
    written: &str,
    attribute: &Attribute,
    parameters: &mut Parameters,
) -> Result<(), OgawaError> {
    // Unreal's schema has colours per vertex only.
    let to_points =
        name == names::COLOR && curves.dialect == Some(Dialect::Unreal) && attribute.domain != Domain::Vertex;
    let attribute = if to_points {
        parameters.domains.push((name.to_owned(), attribute.domain));
        Cow::Owned(spread::attribute(curves.groom, attribute))
    } else {
        Cow::Borrowed(attribute)
    };
    let (data_type, sample) = match guides::three(written, &attribute.values) {
        Some(ids) => (schema::THREE_GUIDES, curves.archive.values(ids.as_flattened())?),
        None => sample(&mut curves.archive, &attribute.values)?,
    };
    parameters.arbitrary.push(geometry(written, data_type, attribute.domain, sample));
    if name == names::ROOT_UV && attribute.domain == Domain::Strand {
        parameters.native.push(geometry(schema::UV, data_type, attribute.domain, sample));
    }
    Ok(())
}

fn sample<W: Write + Seek>(
    archive: &mut ArchiveWriter<W>,
    values: &Values,
) -> Result<(DataType, StoredSample), OgawaError> {
    Ok(match values {
        Values::Float(values) => (DataType::F32, archive.values(values)?),
        Values::Vec2(values) => (DataType::F32X2, archive.values(bytemuck::cast_slice::<_, f32>(values))?),
        Values::Vec3(values) => (DataType::F32X3, archive.values(bytemuck::cast_slice::<_, f32>(values))?),
        Values::Int(values) => (DataType::I32, archive.values(values)?),
    })
}

pub(super) fn geometry(name: &str, data_type: DataType, domain: Domain, sample: StoredSample) -> Property {
    Property::array(name, data_type, schema::parameter(data_type, domain)).with(sample)
}
