//! Absorption of the cortex from what people know about a head of hair: its colour or pigments.

use glam::Vec3;

use crate::error::ScatteringError;
use crate::range;

/// Absorption per fibre radius of the two pigments of hair at unit concentration, linear Rec. 709.
///
/// Programs disagree on the figures: a concentration means nothing without its pigments.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pigments {
    /// Brown to black.
    pub eumelanin: Vec3,
    /// Yellow to red.
    pub pheomelanin: Vec3,
}

impl Pigments {
    /// d'Eon et al. 2011, "An Energy-Conserving Hair Reflectance Model": what pbrt, Mitsuba and MaterialX use.
    pub const DEON: Pigments =
        Pigments { eumelanin: Vec3::new(0.419, 0.697, 1.37), pheomelanin: Vec3::new(0.187, 0.4, 1.05) };

    /// What Cycles uses (`bsdf_principled_hair_sigma_from_concentration`).
    pub const CYCLES: Pigments =
        Pigments { eumelanin: Vec3::new(0.506, 0.841, 1.653), pheomelanin: Vec3::new(0.343, 0.733, 1.924) };

    /// Absorption per fibre radius at these concentrations, each at least 0 (human hair: eumelanin 0.3
    /// blond, 1.3 brown, 8 black; pheomelanin 0..2).
    ///
    /// # Errors
    /// [`ScatteringError::OutOfRange`] for a concentration that is negative or not finite.
    pub fn absorption(&self, eumelanin: f32, pheomelanin: f32) -> Result<Vec3, ScatteringError> {
        range::not_negative("eumelanin", eumelanin)?;
        range::not_negative("pheomelanin", pheomelanin)?;
        Ok(eumelanin * self.eumelanin + pheomelanin * self.pheomelanin)
    }

    /// Absorption per fibre radius from an amount of melanin and how red it is, both in [0, 1].
    ///
    /// `melanin` is perceptually even: the concentration is `-ln(1 - melanin)`, and that of 0.9999 from
    /// there on, as in MaterialX, Cycles and Tungsten, so that 1 is black and not without bound. `redness`
    /// is the share of pheomelanin.
    ///
    /// # Errors
    /// [`ScatteringError::OutOfRange`] for either outside [0, 1].
    pub fn absorption_from_melanin(&self, melanin: f32, redness: f32) -> Result<Vec3, ScatteringError> {
        range::share("melanin", melanin)?;
        range::share("melanin_redness", redness)?;
        let concentration = -(1.0 - melanin).max(1e-4).ln();
        self.absorption(concentration * (1.0 - redness), concentration * redness)
    }
}

/// The darkest colour there is: beyond it the absorption would be without bound.
const DARKEST: f32 = 1e-6;

/// Absorption per fibre radius that gives *a whole head of hair* under even light the albedo
/// `color` (linear, each in [0, 1]): Chiang et al. 2016, eq. 9.
///
/// The fit counts the light that goes from fibre to fibre; a fibre alone is brighter. `beta_n`, in
/// [0.001, 1], is the roughness around the fibre. Black has no finite absorption: channels below 1e-6 are
/// given that of 1e-6.
///
/// # Errors
/// [`ScatteringError::OutOfRange`] for a channel outside [0, 1] or a `beta_n` outside [0.001, 1]; NaN is
/// outside.
pub fn absorption_from_color(color: Vec3, beta_n: f32) -> Result<Vec3, ScatteringError> {
    let divisor = fit_divisor(beta_n)?;
    let mut sigma_a = [0.0; 3];
    for (sigma, channel) in sigma_a.iter_mut().zip(color.to_array()) {
        range::share("color", channel)?;
        let ratio = channel.max(DARKEST).ln() / divisor;
        *sigma = ratio * ratio;
    }
    Ok(sigma_a.into())
}

/// The colour whose fit gives this absorption: the exact inverse of [`absorption_from_color`].
///
/// # Errors
/// [`ScatteringError::OutOfRange`] for a channel that is negative or not finite, or a `beta_n` outside
/// [0.001, 1].
pub fn color_from_absorption(sigma_a: Vec3, beta_n: f32) -> Result<Vec3, ScatteringError> {
    let divisor = fit_divisor(beta_n)?;
    range::absorption(sigma_a)?;
    Ok(sigma_a.to_array().map(|sigma| (-sigma.sqrt() * divisor).exp()).into())
}

/// What the fit divides the logarithm of the colour by.
fn fit_divisor(beta_n: f32) -> Result<f32, ScatteringError> {
    let b = range::roughness("beta_n", beta_n)?;
    Ok(5.969 + b * (-0.215 + b * (2.532 + b * (-10.73 + b * (5.574 + b * 0.245)))))
}

/// [`Pigments::absorption_from_melanin`] of [`Pigments::DEON`], as MaterialX has it.
///
/// # Errors
/// [`ScatteringError::OutOfRange`] for either argument outside [0, 1].
pub fn absorption_from_melanin(melanin: f32, redness: f32) -> Result<Vec3, ScatteringError> {
    Pigments::DEON.absorption_from_melanin(melanin, redness)
}

/// [`Pigments::absorption`] of [`Pigments::DEON`], as pbrt and Mitsuba have it.
///
/// # Errors
/// [`ScatteringError::OutOfRange`] for a concentration that is negative or not finite.
pub fn absorption_from_pigments(eumelanin: f32, pheomelanin: f32) -> Result<Vec3, ScatteringError> {
    Pigments::DEON.absorption(eumelanin, pheomelanin)
}
