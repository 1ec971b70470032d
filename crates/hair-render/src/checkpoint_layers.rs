//! The channels of a checkpoint's file.
//!
//! `R`, `G`, `B`, `A` are the picture so far. The sums are further layers, of 32 bits a sample: `sum.0.R` and
//! `sum.1.R` of the beauty's two halves, `sum.TT.R` of a pass, each with what `sum.0.low.R` adds to it; `sum.covered`
//! and `sum.spp` are whole numbers.

use exr::meta::attribute::SampleType;

use crate::Aov;

/// Changes whenever the layers mean something else.
pub(crate) const VERSION: i32 = 1;

const COLORS: [&str; 3] = ["R", "G", "B"];

/// What a channel holds. A colour is red 0, green 1, blue 2; the part of a sum is high 0, low 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Layer {
    Beauty { color: usize },
    Alpha,
    Half { half: usize, color: usize, part: usize },
    Pass { pass: usize, color: usize, part: usize },
    Covered,
    Spp,
}

/// All channels of a checkpoint that keeps these passes.
pub(crate) fn layers(aovs: &[Aov]) -> Vec<(String, Layer)> {
    let mut layers = vec![
        ("A".to_owned(), Layer::Alpha),
        ("sum.covered".to_owned(), Layer::Covered),
        ("sum.spp".to_owned(), Layer::Spp),
    ];
    for (color, name) in COLORS.into_iter().enumerate() {
        layers.push((name.to_owned(), Layer::Beauty { color }));
        for (part, low) in ["", "low."].into_iter().enumerate() {
            for half in 0..2 {
                layers.push((format!("sum.{half}.{low}{name}"), Layer::Half { half, color, part }));
            }
            for (pass, aov) in aovs.iter().enumerate() {
                layers.push((format!("sum.{}.{low}{name}", aov.name()), Layer::Pass { pass, color, part }));
            }
        }
    }
    layers
}

impl Layer {
    /// How its samples are stored.
    pub fn kind(self) -> SampleType {
        if matches!(self, Layer::Covered | Layer::Spp) { SampleType::U32 } else { SampleType::F32 }
    }
}
