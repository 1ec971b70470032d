//! Factors on the passes of a frame.

use std::collections::BTreeMap;
use std::fmt;
use std::str::FromStr;

use glam::{DVec3, Vec3};
use hair_render::{Aov, Frame};

use crate::CompError;

/// Factors above this are a slip.
const MOST: f32 = 1000.0;

/// A factor for every pass, 1 unless said otherwise.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Weights(BTreeMap<Aov, f32>);

impl Weights {
    /// Sets the factor of one pass.
    ///
    /// # Errors
    /// [`CompError::Weight`] when it is not in 0..=1000.
    pub fn set(&mut self, pass: Aov, factor: f32) -> Result<(), CompError> {
        if !(0.0..=MOST).contains(&factor) {
            let (found, reason) =
                (format!("{}={factor}", pass.name()), format!("{factor} is not in 0..={MOST}"));
            return Err(CompError::Weight { found, reason });
        }
        self.0.insert(pass, factor);
        Ok(())
    }

    /// The factor of one pass.
    #[must_use]
    pub fn of(&self, pass: Aov) -> f32 {
        self.0.get(&pass).copied().unwrap_or(1.0)
    }

    /// The passes whose factor is not 1, with it.
    pub fn changed(&self) -> impl Iterator<Item = (Aov, f32)> {
        self.0.iter().map(|(&pass, &factor)| (pass, factor)).filter(|&(_, factor)| factor != 1.0)
    }

    /// Factors by name, as a pipeline has them.
    ///
    /// # Errors
    /// [`CompError::Weight`] for a name that is no pass or a factor out of range.
    pub fn named<'a>(pairs: impl IntoIterator<Item = (&'a str, f32)>) -> Result<Weights, CompError> {
        let mut weights = Weights::default();
        for (name, factor) in pairs {
            let Some(pass) = Aov::from_name(name) else {
                let names = Aov::ALL.map(Aov::name).join(", ");
                let (found, reason) =
                    (format!("{name}={factor}"), format!("no pass is called `{name}`, they are {names}"));
                return Err(CompError::Weight { found, reason });
            };
            weights.set(pass, factor)?;
        }
        Ok(weights)
    }
}

impl FromStr for Weights {
    type Err = CompError;

    /// `TT=0.5,TRT=2`; a pass that is named twice is refused.
    fn from_str(text: &str) -> Result<Self, CompError> {
        let mut pairs: Vec<(&str, f32)> = Vec::new();
        for found in text.split(',').map(str::trim).filter(|part| !part.is_empty()) {
            let fault = |reason: String| CompError::Weight { found: found.to_owned(), reason };
            let Some((name, factor)) = found.split_once('=') else {
                return Err(fault("there is no `=`".into()));
            };
            let (name, factor) = (name.trim(), factor.trim());
            let factor = factor.parse().map_err(|_| fault(format!("`{factor}` is no number")))?;
            if pairs.iter().any(|(other, _)| other.eq_ignore_ascii_case(name)) {
                return Err(fault("the pass is named twice".into()));
            }
            pairs.push((name, factor));
        }
        Weights::named(pairs)
    }
}

impl fmt::Display for Weights {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let pairs: Vec<String> =
            self.0.iter().map(|(pass, factor)| format!("{}={factor}", pass.name())).collect();
        f.write_str(&pairs.join(","))
    }
}

/// The frame with its passes multiplied by `weights` and its beauty changed by as much. Light that is in no pass
/// stays as it is, and so does alpha: with weights of 1 the frame comes back bit for bit.
///
/// # Errors
/// [`CompError::NoSuchPass`] when a pass whose weight is not 1 is not in the frame.
pub fn reweigh(frame: &Frame, weights: &Weights) -> Result<Frame, CompError> {
    let changed: Vec<(Aov, f32)> = weights.changed().collect();
    for &(pass, _) in &changed {
        if frame.pass(pass).is_none() {
            let has: Vec<&str> = frame.passes.iter().map(|(pass, _)| pass.name()).collect();
            let has = if has.is_empty() { "none".to_owned() } else { has.join(", ") };
            return Err(CompError::NoSuchPass { pass: pass.name(), has });
        }
    }
    let mut frame = frame.clone();
    // In f64: what is left when a pass is taken out is a small difference of large numbers.
    let mut beauty: Vec<DVec3> = Vec::new();
    for (pass, pixels) in &mut frame.passes {
        let Some(&(_, factor)) = changed.iter().find(|(other, _)| other == pass) else { continue };
        if beauty.is_empty() {
            beauty = frame.beauty.iter().map(|pixel| pixel.as_dvec3()).collect();
        }
        for (sum, pixel) in beauty.iter_mut().zip(pixels) {
            *sum += pixel.as_dvec3() * (f64::from(factor) - 1.0);
            *pixel *= factor;
        }
    }
    for (pixel, sum) in frame.beauty.iter_mut().zip(beauty) {
        // What rounding leaves below zero where all light was taken out is no light.
        let sum = sum.as_vec3();
        *pixel = Vec3::select(sum.cmplt(Vec3::ZERO) & pixel.cmpge(Vec3::ZERO), Vec3::ZERO, sum);
    }
    Ok(frame)
}
