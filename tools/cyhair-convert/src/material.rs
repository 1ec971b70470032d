//! From the options to the numbers a file's material holds.

use anyhow::Result;
use fibre_material::{Field, HairColor, Material, Variation};
use fibre_scattering::{HairParameters, Medulla, color_from_absorption};
use glam::Vec3;
use groom::{Groom, Vec3View};
use groom_formats::Look;

use crate::args::{MaterialOptions, Source};

/// What a strand without colour is taken for: brown, as the renderer takes it.
const BROWN: Vec3 = Vec3::new(0.25, 0.15, 0.08);

/// The material that was asked for, if any.
pub(crate) fn look(options: &MaterialOptions, groom: &Groom) -> Result<Option<Look>> {
    let Some(mut material) = material(options)? else { return Ok(None) };
    if let HairColor::Groom { fallback } = material.color {
        material.color = HairColor::Color(mean_color(groom).unwrap_or(fallback));
    }
    // Refuses what is out of bounds, in the words of the model.
    let hair = HairParameters { film: None, ..material.constant()?.hair };
    let (color, melanin) = match material.color {
        HairColor::Color(color) => (color, None),
        HairColor::Melanin { concentration, redness } => {
            (color_from_absorption(hair.sigma_a, hair.beta_n)?, Some([concentration, redness]))
        }
        _ => (color_from_absorption(hair.sigma_a, hair.beta_n)?, None),
    };
    Ok(Some(Look {
        color: color.to_array(),
        absorption: hair.sigma_a.to_array(),
        beta_m: hair.beta_m,
        beta_n: hair.beta_n,
        roughness: hair.lobe_spreads(),
        alpha: hair.alpha,
        eta: hair.eta,
        melanin,
    }))
}

/// What the material says that no format holds, in words; nothing where it says nothing of that kind.
pub(crate) fn left_out(options: &MaterialOptions) -> Result<Option<String>> {
    let Some(Material { parameters, medulla, variation, field, .. }) = material(options)? else {
        return Ok(None);
    };
    let usual = HairParameters::default();
    let said: Vec<&str> = [
        ("its film of water", parameters.film.is_some()),
        ("its cuticle layers", parameters.cuticle_layers.is_some()),
        ("its elliptical cross-section", parameters.aspect != usual.aspect),
        ("its lobe weights", parameters.lobe_weights != usual.lobe_weights),
        ("its medulla", medulla != Medulla::NONE),
        ("what differs from strand to strand and along them", variation != Variation::default()),
        ("its far field", field != Field::Near),
    ]
    .into_iter()
    .filter_map(|(what, is_said)| is_said.then_some(what))
    .collect();
    Ok((!said.is_empty()).then(|| format!("left out of the material: {}", said.join(", "))))
}

/// The material that was asked for, with what the options say over it.
fn material(options: &MaterialOptions) -> Result<Option<Material>> {
    let Some(source) = &options.material else { return Ok(None) };
    let of = |color| Material { color, ..Material::default() };
    let mut material = match source {
        Source::Groom => of(HairColor::Groom { fallback: BROWN }),
        Source::Color(color) => of(HairColor::Color((*color).into())),
        Source::Melanin([concentration, redness]) => {
            of(HairColor::Melanin { concentration: *concentration, redness: *redness })
        }
        Source::Absorption(sigma_a) => of(HairColor::Absorption((*sigma_a).into())),
        Source::File(path) => Material::open(path)?,
        Source::Preset(name) => Material::preset(name)?,
    };
    let parameters = &mut material.parameters;
    for (value, option) in [
        (&mut parameters.beta_m, options.beta_m),
        (&mut parameters.beta_n, options.beta_n),
        (&mut parameters.alpha, options.alpha.map(f32::to_radians)),
        (&mut parameters.eta, options.eta),
    ] {
        *value = option.unwrap_or(*value);
    }
    Ok(Some(material))
}

/// The mean colour of the strands, each counted by its points.
fn mean_color(groom: &Groom) -> Option<Vec3> {
    let mean = |values: &[Vec3], weight: &dyn Fn(usize) -> f64| {
        let all: f64 = (0..values.len()).map(weight).sum();
        let sum: glam::DVec3 = values.iter().enumerate().map(|(i, v)| v.as_dvec3() * weight(i)).sum();
        (sum / all.max(1.0)).as_vec3()
    };
    Some(match groom.colors()? {
        Vec3View::Constant(color) => color,
        Vec3View::Strand(colors) => mean(colors, &|strand| groom.strand_range(strand).len() as f64),
        Vec3View::Vertex(colors) => mean(colors, &|_| 1.0),
    })
}
