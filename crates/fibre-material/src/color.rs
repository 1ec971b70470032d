//! Where the absorption of the cortex comes from.

use std::path::PathBuf;
use std::sync::Arc;

use fibre_scattering::ScatteringError;
use glam::Vec3;
use groom::VAxis;

use crate::{MaterialError, Picture};

/// Where the absorption of the fibres comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum HairColor {
    /// The groom's `color` attribute through Chiang's fit, per groom, strand or vertex; the colour
    /// given here where the groom has none.
    Groom {
        /// Linear Rec. 709, used when the groom has no `color`.
        fallback: Vec3,
    },
    /// The groom's `melanin` and `redness` attributes, per groom, strand or vertex; the amounts given
    /// here for whichever of them the groom has not.
    GroomMelanin {
        /// Used when the groom has no `melanin`, 0..1.
        concentration: f32,
        /// Used when the groom has no `redness`, 0..1.
        redness: f32,
    },
    /// One colour, linear Rec. 709 in 0..1, through Chiang's fit: the albedo of a thick assembly.
    Color(Vec3),
    /// Colours along the strand, root (0) to tip (1), straight in between, through Chiang's fit.
    Ramp(ColorRamp),
    /// The colour a picture has at the strand's `root_uv`, through Chiang's fit.
    Texture(ColorTexture),
    /// Melanin concentration (0..1) and redness (0..1).
    Melanin {
        /// How much pigment, 0 (white) .. 1 (black).
        concentration: f32,
        /// Share of pheomelanin, 0 .. 1.
        redness: f32,
    },
    /// Concentrations of the two pigments, at least 0: d'Eon et al. 2011, pbrt.
    Pigments {
        /// Brown to black: about 0.3 blond, 1.3 brown, 8 black.
        eumelanin: f32,
        /// Yellow to red.
        pheomelanin: f32,
    },
    /// Absorption per fibre radius, at least 0, as it is in `HairParameters::sigma_a`.
    Absorption(Vec3),
}

impl Default for HairColor {
    /// The groom's own colour; a light brown where it has none.
    fn default() -> Self {
        HairColor::Groom { fallback: Vec3::new(0.42, 0.24, 0.12) }
    }
}

impl HairColor {
    /// Whether it is a colour that Chiang's fit turns into absorption, and not pigment or absorption itself.
    #[must_use]
    pub fn is_fitted(&self) -> bool {
        use HairColor::{Color, Groom, Ramp, Texture};
        matches!(self, Groom { .. } | Color(_) | Ramp(_) | Texture(_))
    }
}

/// A picture to look colours up in.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorTexture {
    /// Where it came from, for messages.
    pub file: PathBuf,
    /// Where v = 0 is.
    pub v_axis: VAxis,
    /// Its pixels.
    pub picture: Arc<Picture>,
}

/// Colours along a strand: straight between its points, level before the first and after the last.
#[derive(Clone, Debug, PartialEq)]
pub struct ColorRamp {
    points: Vec<(f32, Vec3)>,
}

impl ColorRamp {
    /// The ramp through `points`: how far along the strand (0 root, 1 tip) and the colour there.
    ///
    /// # Errors
    /// [`MaterialError::Value`] unless there is a point, the places lie in 0..=1 and rise, and the colours'
    /// channels lie in 0..1.
    pub fn new(points: Vec<(f32, Vec3)>) -> Result<ColorRamp, MaterialError> {
        let rises = points.windows(2).all(|pair| pair[0].0 < pair[1].0);
        if points.is_empty() || !rises || !points.iter().all(|(t, _)| (0.0..=1.0).contains(t)) {
            let places: Vec<f32> = points.iter().map(|point| point.0).collect();
            let expected = "places along the strand that rise from 0 (root) to 1 (tip)";
            return Err(MaterialError::value("color_ramp", format!("{places:?}"), expected));
        }
        for (t, color) in &points {
            checked(*color, || format!("color_ramp at {t}"))?;
        }
        Ok(ColorRamp { points })
    }

    /// The colour at `t`.
    #[must_use]
    pub fn at(&self, t: f32) -> Vec3 {
        let after = self.points.partition_point(|point| point.0 <= t);
        match (after.checked_sub(1).and_then(|i| self.points.get(i)), self.points.get(after)) {
            (Some(&(from, low)), Some(&(to, high))) => {
                let part = (t - from) / (to - from);
                low * (1.0 - part) + high * part
            }
            (Some(&(_, color)), None) | (None, Some(&(_, color))) => color,
            (None, None) => Vec3::ONE, // no ramp is empty
        }
    }
}

/// A colour, if it is one.
pub(crate) fn checked(color: Vec3, what: impl FnOnce() -> String) -> Result<Vec3, MaterialError> {
    if color.to_array().iter().all(|channel| (0.0..=1.0).contains(channel)) {
        Ok(color)
    } else {
        Err(MaterialError::value(what(), color, "a colour of channels in 0..1"))
    }
}

/// Chiang et al. 2016, eq. 9.
pub(crate) fn fit(color: Vec3, beta_n: f32) -> Result<Vec3, ScatteringError> {
    fibre_scattering::absorption_from_color(color, beta_n)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ramps_run_straight_between_their_points() {
        let ramp = ColorRamp::new(vec![(0.25, Vec3::ZERO), (0.75, Vec3::ONE)]).unwrap();
        for (t, grey) in [(0.0, 0.0), (0.25, 0.0), (0.5, 0.5), (0.75, 1.0), (1.0, 1.0)] {
            assert_eq!(ramp.at(t), Vec3::splat(grey));
        }
        for points in [
            vec![],
            vec![(0.5, Vec3::ZERO), (0.5, Vec3::ONE)],
            vec![(-0.1, Vec3::ONE)],
            vec![(f32::NAN, Vec3::ONE)],
            vec![(0.0, Vec3::splat(1.01))],
        ] {
            assert!(ColorRamp::new(points.clone()).is_err(), "{points:?}");
        }
    }
}
