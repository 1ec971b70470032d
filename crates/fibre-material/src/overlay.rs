//! One material file laid over another.

use crate::file::{FieldName, MaterialFile};

/// Takes each of the fields from `base` where `over` has none.
macro_rules! fill {
    ($over:expr, $base:expr; $($field:ident),+) => {
        $( if $over.$field.is_none() { $over.$field = $base.$field; } )+
    };
}

/// Lays parts over parts, field by field, where both are there.
macro_rules! fill_part {
    ($over:expr, $base:expr; $($part:ident { $($field:ident),+ }),+ $(,)?) => {
        $( match (&mut $over.$part, $base.$part) {
            (Some(over), Some(base)) => { fill!(over, base; $($field),+); }
            (over @ None, base) => *over = base,
            (Some(_), None) => {}
        } )+
    };
}

impl MaterialFile {
    /// The ways of giving the colour that are used here, by key.
    pub(crate) fn ways(&self) -> Vec<&'static str> {
        let pigments = self.eumelanin.is_some() || self.pheomelanin.is_some();
        let base_color = self.fur.is_some_and(|fur| fur.base_color.is_some());
        let ways = [
            ("color", self.color.is_some()),
            ("absorption", self.absorption.is_some()),
            ("melanin", self.melanin.is_some()),
            ("eumelanin", pigments),
            ("groom", self.groom.is_some()),
            ("texture", self.texture.is_some()),
            ("color_ramp", self.color_ramp.is_some()),
            ("fur.base_color", base_color),
        ];
        ways.into_iter().filter_map(|(way, used)| used.then_some(way)).collect()
    }

    /// This over `base`: what is said here counts, the rest is the base's. A colour, a film, a core of fur,
    /// layers, white hairs or a field that are said here in another way than there take its place.
    #[must_use]
    pub fn over(mut self, mut base: MaterialFile) -> MaterialFile {
        if !self.ways().is_empty() {
            let same = self.ways() == base.ways();
            (base.color, base.absorption, base.groom, base.texture, base.color_ramp) =
                (None, None, None, None, None);
            if !same {
                (base.melanin, base.redness, base.eumelanin, base.pheomelanin) = (None, None, None, None);
            }
            if let Some(fur) = &mut base.fur {
                fur.base_color = None;
            }
        }
        if self.medulla.is_some() {
            base.fur = None;
        }
        if self.fur.is_some() {
            base.medulla = None;
        }
        if self.wet == Some(false) {
            base.film = None;
        }
        if self.film.is_some() && self.wet.is_none() {
            base.wet = None;
        }
        if self.cuticle_layers.is_some()
            && let Some(fur) = &mut base.fur
        {
            fur.cuticle_layers = None;
        }
        if self.fur.is_some_and(|fur| fur.cuticle_layers.is_some()) {
            base.cuticle_layers = None;
        }
        if self.variation.is_some_and(|v| v.white_melanin.is_some() || v.white_color.is_some())
            && let Some(variation) = &mut base.variation
        {
            (variation.white_melanin, variation.white_color) = (None, None);
        }
        if self.field == Some(FieldName::Near) {
            base.nodes = None;
        }
        fill!(self, base;
            color, absorption, melanin, redness, eumelanin, pheomelanin, pigments, groom, texture, color_ramp,
            beta_m, beta_n, alpha, eta, wet, cuticle_layers, aspect, field, nodes,
            cycles, materialx, pbrt, mitsuba, arnold, renderman);
        fill_part!(self, base;
            roughness_scales { tt, trt },
            lobes { r, tt, trt, residual, scattered },
            film { eta, roughness },
            medulla { kappa, sigma_s, sigma_a, g },
            fur { base_color, medulla_color, medulla_index, medulla_scattering, cuticle_layers },
            variation { seed, pigment, redness, hue, value, roughness, white, white_melanin, white_color },
            along { absorption, melanin },
        );
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn over(over: &str, base: &str) -> MaterialFile {
        let read = |text| strict_yaml::parse::<MaterialFile>(text).unwrap();
        read(over).over(read(base))
    }

    #[test]
    fn what_is_said_counts_and_the_rest_stays() {
        let both =
            over("beta_m: 0.2\nfilm: {eta: 1.4}\n", "beta_m: 0.5\nbeta_n: 0.6\nfilm: {roughness: 0.2}\n");
        assert_eq!((both.beta_m, both.beta_n), (Some(0.2), Some(0.6)));
        let film = both.film.unwrap();
        assert_eq!((film.eta, film.roughness), (Some(1.4), Some(0.2)));
        assert_eq!(over("", "eta: 1.4"), over("eta: 1.4", ""));
    }

    #[test]
    fn another_colour_takes_the_place_of_the_first() {
        let both = over("color: [1, 1, 1]", "melanin: 0.5\nredness: 0.3");
        assert_eq!((both.ways(), both.redness), (vec!["color"], None));
        let both = over("redness: 0.1", "melanin: 0.5\nredness: 0.3");
        assert_eq!((both.melanin, both.redness), (Some(0.5), Some(0.1)));
        let both = over("pheomelanin: 1", "eumelanin: 0.5");
        assert_eq!((both.eumelanin, both.pheomelanin), (Some(0.5), Some(1.0)));
        let both = over("color: [1, 1, 1]", "fur: {base_color: [0, 0, 0], medulla_index: 1}");
        assert_eq!(both.ways(), ["color"]);
        assert_eq!(both.fur.unwrap().medulla_index, Some(1.0));
        assert!(over("medulla: {kappa: 0.5}", "fur: {medulla_index: 1}").fur.is_none());
    }

    /// What a file begins with cannot be taken back other than by saying it anew.
    #[test]
    fn nothing_said_anew_contradicts_what_it_takes_the_place_of() {
        for (new, old) in [
            ("film: {eta: 1.4}", "wet: false"),
            ("wet: false", "film: {eta: 1.4}"),
            ("cuticle_layers: 2", "fur: {cuticle_layers: 1}"),
            ("fur: {cuticle_layers: 1}", "cuticle_layers: 2"),
            ("variation: {white_melanin: 0.1}", "variation: {white: 0.2, white_color: [0.9, 0.9, 0.8]}"),
            ("variation: {white_color: [0.9, 0.9, 0.8]}", "variation: {white: 0.2, white_melanin: 0.1}"),
            ("field: near", "field: far\nnodes: 8"),
            ("medulla: {kappa: 0.5}", "fur: {medulla_index: 1}"),
            ("groom: {melanin: 0.5}", "groom: {color: [1, 1, 1]}"),
        ] {
            let material = over(new, old).material(&crate::Picture::unread);
            assert!(material.is_ok(), "{new} over {old}: {material:?}");
        }
    }
}
