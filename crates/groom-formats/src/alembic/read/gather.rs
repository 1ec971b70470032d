//! Attributes that our writer spread over the points.

use glam::{Vec2, Vec3};
use groom::{Attribute, Domain, Values};
use ogawa::OgawaError;

use super::curves::Curves;
use super::params::Attributes;
use super::values::Samples;
use crate::alembic::schema;

/// Takes them back to what they were, where they still are alike.
pub(super) fn gather(
    curves: &Curves<'_>,
    samples: &Samples,
    found: &mut Attributes,
) -> Result<(), OgawaError> {
    let user = curves.geometry.find(schema::USER)?.map(|p| p.compound()).transpose()?;
    let Some(domains) = user.map(|user| user.find(schema::DOMAINS)).transpose()?.flatten() else {
        return Ok(());
    };
    if domains.sample_count() == 0 {
        return Ok(());
    }
    let texts = samples.held(&domains)?.texts()?;
    let lens: Vec<u32> = curves.polylines.strand_lens().collect();
    for (name, domain) in texts.iter().flat_map(|text| text.split(',')).filter_map(|s| s.split_once('=')) {
        let Some(attribute) = found.get_mut(name).filter(|a| a.domain == Domain::Vertex) else { continue };
        let all = [curves.positions.len() as u32];
        let (domain, lens) = match domain {
            "strand" => (Domain::Strand, &lens[..]),
            "groom" => (Domain::Groom, &all[..]),
            _ => continue,
        };
        let gathered = match &attribute.values {
            Values::Float(v) => firsts(v, lens, |v| [v.to_bits(), 0, 0]).map(Values::Float),
            Values::Vec2(v) => firsts(v, lens, |v: Vec2| [v.x.to_bits(), v.y.to_bits(), 0]).map(Values::Vec2),
            Values::Vec3(v) => firsts(v, lens, |v: Vec3| v.to_array().map(f32::to_bits)).map(Values::Vec3),
            Values::Int(v) => firsts(v, lens, |v| [v as u32, 0, 0]).map(Values::Int),
        };
        if let Some(values) = gathered {
            *attribute = Attribute { domain, values };
        }
    }
    Ok(())
}

/// The first value of each run, if all of the run are the same to the bit.
fn firsts<T: Copy>(values: &[T], lens: &[u32], bits: impl Fn(T) -> [u32; 3]) -> Option<Vec<T>> {
    let mut rest = values;
    lens.iter()
        .map(|&len| {
            let (run, after) = rest.split_at_checked(len as usize)?;
            rest = after;
            let first = *run.first()?;
            run.iter().all(|&value| bits(value) == bits(first)).then_some(first)
        })
        .collect()
}
