//! From the options to the numbers a file's material holds.

use anyhow::Result;
use fibre_scattering::{
    HairBcsdf, HairParameters, absorption_from_color, absorption_from_melanin, color_from_absorption,
};
use glam::Vec3;
use groom::{Groom, Vec3View};
use groom_formats::Look;

use crate::args::{Material, Source};

/// What a strand without colour is taken for: brown, as the renderer takes it.
const BROWN: Vec3 = Vec3::new(0.25, 0.15, 0.08);

/// The material that was asked for, if any.
pub(crate) fn look(options: &Material, groom: &Groom) -> Result<Option<Look>> {
    let Some(source) = options.material else { return Ok(None) };
    let (beta_m, beta_n) = (options.beta_m, options.beta_n);
    let sigma_a = match source {
        Source::Groom => absorption_from_color(mean_color(groom), beta_n)?,
        Source::Color(color) => absorption_from_color(color.into(), beta_n)?,
        Source::Melanin([concentration, redness]) => absorption_from_melanin(concentration, redness)?,
        Source::Absorption(sigma_a) => sigma_a.into(),
    };
    let alpha = options.alpha.to_radians();
    let parameters =
        HairParameters { beta_m, beta_n, alpha, eta: options.eta, sigma_a, ..HairParameters::default() };
    // Refuses what is out of bounds, in the words of the model.
    HairBcsdf::new(&parameters)?;
    let (color, melanin) = match source {
        Source::Groom => (mean_color(groom), None),
        Source::Color(color) => (color.into(), None),
        Source::Melanin(melanin) => (color_from_absorption(sigma_a, beta_n)?, Some(melanin)),
        Source::Absorption(_) => (color_from_absorption(sigma_a, beta_n)?, None),
    };
    Ok(Some(Look {
        color: color.to_array(),
        absorption: sigma_a.to_array(),
        beta_m,
        beta_n,
        roughness: parameters.lobe_spreads(),
        alpha,
        eta: options.eta,
        melanin,
    }))
}

/// The mean colour of the strands, each counted by its points.
fn mean_color(groom: &Groom) -> Vec3 {
    let mean = |values: &[Vec3], weight: &dyn Fn(usize) -> f64| {
        let all: f64 = (0..values.len()).map(weight).sum();
        let sum: glam::DVec3 = values.iter().enumerate().map(|(i, v)| v.as_dvec3() * weight(i)).sum();
        (sum / all.max(1.0)).as_vec3().clamp(Vec3::ZERO, Vec3::ONE)
    };
    match groom.colors() {
        Some(Vec3View::Constant(color)) => color,
        Some(Vec3View::Strand(colors)) => mean(colors, &|strand| groom.strand_range(strand).len() as f64),
        Some(Vec3View::Vertex(colors)) => mean(colors, &|_| 1.0),
        None => BROWN,
    }
}
