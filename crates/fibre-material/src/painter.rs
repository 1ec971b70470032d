//! What each point of a groom absorbs.

use fibre_scattering::Absorption;
use glam::{Vec2, Vec3};
use groom::{Attribute, Domain, FloatView, Groom, GroomError, Texture, Values, Vec3View, names};

use crate::color::{checked, fit};
use crate::hue;
use crate::variation::{Lot, WhiteColor};
use crate::{HairColor, Material, MaterialError};

/// A material's colour, with what it needs of the groom at hand.
pub(crate) struct Painter<'a> {
    material: &'a Material,
    source: Source<'a>,
}

/// What the colour comes to on this groom.
enum Source<'a> {
    /// Linear colours to be fitted; checked when they are looked up.
    Colors(Vec3View<'a>),
    /// Colours along the strand.
    Ramp(&'a crate::ColorRamp),
    /// A picture, and where each root is in it.
    Texture(Texture<'a>, Domain, &'a [Vec2]),
    /// Concentration and redness.
    Melanin(FloatView<'a>, FloatView<'a>),
    /// Eumelanin and pheomelanin.
    Pigments(f32, f32),
    Absorption(Vec3),
}

/// Where on the groom: strand, vertex, and how far along the strand.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    pub strand: usize,
    pub vertex: usize,
    pub along: f32,
}

impl<'a> Painter<'a> {
    /// For a groom.
    pub fn new(material: &'a Material, groom: &'a Groom) -> Result<Self, MaterialError> {
        let float = |name, fallback| {
            groom.attribute(name).and_then(Attribute::float_view).unwrap_or(FloatView::Constant(fallback))
        };
        let source = match &material.color {
            HairColor::Groom { fallback } => {
                Source::Colors(groom.colors().unwrap_or(Vec3View::Constant(*fallback)))
            }
            HairColor::GroomMelanin { concentration, redness } => {
                Source::Melanin(float(names::MELANIN, *concentration), float(names::REDNESS, *redness))
            }
            HairColor::Texture(texture) => {
                let (domain, uvs) = root_uvs(groom)?;
                Source::Texture(texture.picture.texture(texture.v_axis)?, domain, uvs)
            }
            _ => Self::without_groom(material)?.source,
        };
        Ok(Painter { material, source })
    }

    /// For no groom in particular.
    pub fn without_groom(material: &'a Material) -> Result<Self, MaterialError> {
        let source = match &material.color {
            HairColor::Groom { fallback: color } | HairColor::Color(color) => {
                Source::Colors(Vec3View::Constant(*color))
            }
            HairColor::Ramp(ramp) => Source::Ramp(ramp),
            HairColor::Texture(texture) => Source::Colors(Vec3View::Constant(texture.picture.mean())),
            HairColor::GroomMelanin { concentration, redness }
            | HairColor::Melanin { concentration, redness } => {
                Source::Melanin(FloatView::Constant(*concentration), FloatView::Constant(*redness))
            }
            HairColor::Pigments { eumelanin, pheomelanin } => Source::Pigments(*eumelanin, *pheomelanin),
            HairColor::Absorption(sigma_a) => Source::Absorption(*sigma_a),
        };
        Ok(Painter { material, source })
    }

    /// How finely the absorption may vary.
    pub fn domain(&self) -> Domain {
        let finest = match &self.source {
            Source::Ramp(_) => Domain::Vertex,
            Source::Colors(Vec3View::Vertex(_)) => Domain::Vertex,
            Source::Melanin(a, b) if is_vertex(a) || is_vertex(b) => Domain::Vertex,
            Source::Colors(Vec3View::Strand(_)) | Source::Texture(..) => Domain::Strand,
            Source::Melanin(a, b) if is_strand(a) || is_strand(b) => Domain::Strand,
            _ => Domain::Groom,
        };
        let variation = &self.material.variation;
        let fitted_anew = variation.roughness > 0.0 && self.material.color.is_fitted();
        match finest {
            Domain::Vertex => Domain::Vertex,
            _ if variation.changes_along() => Domain::Vertex,
            Domain::Groom if !variation.changes_absorption() && !fitted_anew => Domain::Groom,
            _ => Domain::Strand,
        }
    }

    /// The absorption of a strand like the mean of all, half way along.
    pub fn mean(&self) -> Result<Absorption, MaterialError> {
        self.at(Place { strand: 0, vertex: 0, along: 0.5 }, &Lot::MEAN)
    }

    /// The absorption at a place of a strand.
    pub fn at(&self, place: Place, lot: &Lot) -> Result<Absorption, MaterialError> {
        let variation = &self.material.variation;
        let beta_n = self.material.parameters.beta_n * lot.roughness;
        let pigments = self.material.pigments.pigments();
        if lot.white {
            let cortex = match variation.white.color {
                WhiteColor::Clear => Vec3::ZERO,
                WhiteColor::Melanin(melanin) => pigments.absorption_from_melanin(melanin, 0.0)?,
                WhiteColor::Color(color) => fit(color, beta_n)?,
            };
            let medulla = if self.material.medulla_as_cortex { cortex } else { Vec3::ZERO };
            return Ok(Absorption::new(cortex, medulla)?);
        }
        let along = variation.along.absorption.as_ref().map_or(1.0, |ramp| ramp.at(place.along));
        let cortex = along * self.cortex(place, lot, beta_n)?;
        let medulla = match self.material.medulla_as_cortex {
            true => cortex,
            false => along * lot.pigment * self.material.medulla.sigma_a,
        };
        Ok(Absorption::new(cortex, medulla)?)
    }

    fn cortex(&self, place: Place, lot: &Lot, beta_n: f32) -> Result<Vec3, MaterialError> {
        let Place { strand, vertex, along } = place;
        let pigments = self.material.pigments.pigments();
        let fitted = |color: Vec3| -> Result<Vec3, MaterialError> {
            let whose = || match &self.source {
                Source::Colors(Vec3View::Constant(_)) => "the colour of the hair".to_owned(),
                _ => format!("the colour of strand {strand}"),
            };
            let color = checked(color, whose)?;
            let turned = if lot.hue == 0.0 { color } else { hue::turned(color, lot.hue) };
            Ok(lot.pigment * fit((turned * lot.value).min(Vec3::ONE), beta_n)?)
        };
        match &self.source {
            Source::Colors(colors) => fitted(colors.get(strand, vertex)),
            Source::Ramp(ramp) => fitted(ramp.at(along)),
            Source::Texture(texture, domain, uvs) => {
                let uv = match domain {
                    Domain::Groom => uvs.first(),
                    Domain::Strand => uvs.get(strand),
                    Domain::Vertex => uvs.get(vertex),
                };
                fitted(uv.map_or(Vec3::NAN, |&uv| texture.at(uv)))
            }
            Source::Melanin(concentration, redness) => {
                let ramp = self.material.variation.along.melanin.as_ref();
                let amount = |view: &FloatView<'_>, what: &str| {
                    let found = view.get(strand, vertex);
                    let what = || format!("{what} of strand {strand}");
                    let good = (0.0..=1.0).contains(&found);
                    if good { Ok(found) } else { Err(MaterialError::value(what(), found, "0..1")) }
                };
                let factor = lot.pigment * ramp.map_or(1.0, |ramp| ramp.at(along));
                let concentration = (amount(concentration, "melanin")? * factor).min(1.0);
                let redness = (amount(redness, "redness")? + lot.redness).clamp(0.0, 1.0);
                Ok(pigments.absorption_from_melanin(concentration, redness)?)
            }
            Source::Pigments(eumelanin, pheomelanin) => {
                for (what, found) in [("eumelanin", *eumelanin), ("pheomelanin", *pheomelanin)] {
                    if !(0.0..=f32::MAX).contains(&found) {
                        return Err(MaterialError::value(what, found, "a finite amount of at least 0"));
                    }
                }
                let (mut eumelanin, mut pheomelanin) = (*eumelanin, *pheomelanin);
                let all = eumelanin + pheomelanin;
                if lot.redness != 0.0 && all > 0.0 {
                    let redness = (pheomelanin / all + lot.redness).clamp(0.0, 1.0);
                    (eumelanin, pheomelanin) = (all * (1.0 - redness), all * redness);
                }
                Ok(lot.pigment * pigments.absorption(eumelanin, pheomelanin)?)
            }
            Source::Absorption(sigma_a) => Ok(lot.pigment * *sigma_a),
        }
    }
}

fn is_vertex(view: &FloatView<'_>) -> bool {
    matches!(view, FloatView::Vertex(_))
}

fn is_strand(view: &FloatView<'_>) -> bool {
    matches!(view, FloatView::Strand(_))
}

/// Where each root is in a picture: one a groom, a strand or a vertex.
fn root_uvs(groom: &Groom) -> Result<(Domain, &[Vec2]), GroomError> {
    let missing = |found| {
        let (name, expected) = (names::ROOT_UV, "one vec2 a strand, to look colours up in a picture");
        GroomError::AttributeMissing { name, found, expected }
    };
    match groom.attribute(names::ROOT_UV) {
        Some(Attribute { domain, values: Values::Vec2(uvs) }) => Ok((*domain, uvs)),
        Some(_) => Err(missing("of another type")),
        None => Err(missing("not there")),
    }
}
