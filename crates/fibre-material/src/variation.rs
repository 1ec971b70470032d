//! What differs from strand to strand, and along each of them.

use glam::Vec3;
use groom::Ramp;

use crate::MaterialError;

/// How strands differ. Every amount is 0, none, unless it is given.
///
/// A strand's lot depends on `seed`, the strand's id ([`groom::Groom::strand_id`]) and what it is for, and on
/// nothing else: it survives thinning out and reordering. Factors are Cycles' `1 + 2 (random - 0.5) amount`,
/// whose mean is 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Variation {
    /// Everything random follows from it.
    pub seed: u64,
    /// Amount of the factor on the pigment, 0..1: on the concentration for melanin (Cycles' Random Color;
    /// a product over 1 counts as 1, as there, so that the mean is kept while concentration times
    /// 1 + amount stays at or below 1), on the absorption for everything else. The medulla's absorption goes
    /// with it.
    pub pigment: f32,
    /// How far redness moves up or down, 0..1, for melanin and pigments; below 0 counts as 0, over 1 as 1.
    pub redness: f32,
    /// How far the hue turns to either side, 0..0.5 of a circle; for colours.
    pub hue: f32,
    /// Amount of the factor on a colour's value, 0..1; a channel that comes out over 1 counts as 1.
    pub value: f32,
    /// Amount of the factor on both roughnesses, 0..0.99 (Cycles' Random Roughness).
    pub roughness: f32,
    /// Hairs without pigment among the others.
    pub white: White,
    /// What changes from root to tip.
    pub along: Along,
}

/// White hairs: each strand is one with the probability `share`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct White {
    /// How many of all strands, 0..1.
    pub share: f32,
    /// What they look like.
    pub color: WhiteColor,
}

/// What a white hair looks like.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum WhiteColor {
    /// No absorption at all, in cortex and medulla.
    #[default]
    Clear,
    /// This much melanin, 0..1, none of it red; the medulla has none.
    Melanin(f32),
    /// This colour, through Chiang's fit; the medulla has no absorption.
    Color(Vec3),
}

/// Factors from root to tip; white hairs keep out of them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Along {
    /// On the absorption of cortex and medulla.
    pub absorption: Option<Ramp>,
    /// On the concentration of melanin; a product over 1 counts as 1. For melanin only.
    pub melanin: Option<Ramp>,
}

/// What fell to one strand.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Lot {
    pub pigment: f32,
    pub redness: f32,
    pub hue: f32,
    pub value: f32,
    pub roughness: f32,
    pub white: bool,
}

impl Lot {
    /// A strand like the mean of all.
    pub const MEAN: Lot =
        Lot { pigment: 1.0, redness: 0.0, hue: 0.0, value: 1.0, roughness: 1.0, white: false };
}

impl Variation {
    /// What falls to the strand `id`.
    pub(crate) fn lot(&self, id: u32) -> Lot {
        // From -1 to 1.
        let random = |purpose| 2.0 * groom::random(self.seed, id, purpose) - 1.0;
        let moved = |amount: f32, purpose| if amount > 0.0 { amount * random(purpose) } else { 0.0 };
        Lot {
            pigment: 1.0 + moved(self.pigment, "pigment"),
            redness: moved(self.redness, "redness"),
            hue: moved(self.hue, "hue"),
            value: 1.0 + moved(self.value, "value"),
            roughness: 1.0 + moved(self.roughness, "roughness"),
            white: self.white.share > 0.0 && groom::random(self.seed, id, "white hair") < self.white.share,
        }
    }

    /// Whether strands absorb differently, roughness left aside.
    pub(crate) fn changes_absorption(&self) -> bool {
        [self.pigment, self.redness, self.hue, self.value, self.white.share]
            .iter()
            .any(|&amount| amount > 0.0)
    }

    /// Whether anything changes from root to tip.
    pub(crate) fn changes_along(&self) -> bool {
        self.along.absorption.is_some() || self.along.melanin.is_some()
    }

    /// Checks every range stated on the fields.
    ///
    /// # Errors
    /// [`MaterialError::Value`] names the first value out of range; NaN is out of every range.
    pub fn check(&self) -> Result<(), MaterialError> {
        let amounts = [
            ("variation.pigment", self.pigment, 1.0, "0..1"),
            ("variation.redness", self.redness, 1.0, "0..1"),
            ("variation.hue", self.hue, 0.5, "0..0.5 of a circle, 0..180 degrees"),
            ("variation.value", self.value, 1.0, "0..1"),
            ("variation.roughness", self.roughness, 0.99, "0..0.99"),
            ("variation.white", self.white.share, 1.0, "0..1"),
        ];
        for (what, found, most, expected) in amounts {
            if !(0.0..=most).contains(&found) {
                return Err(MaterialError::value(what, found, expected));
            }
        }
        match self.white.color {
            WhiteColor::Clear => Ok(()),
            WhiteColor::Melanin(melanin) if (0.0..=1.0).contains(&melanin) => Ok(()),
            WhiteColor::Melanin(melanin) => {
                Err(MaterialError::value("variation.white_melanin", melanin, "0..1"))
            }
            WhiteColor::Color(color) => {
                crate::color::checked(color, || "variation.white_color".into()).map(drop)
            }
        }
    }
}
