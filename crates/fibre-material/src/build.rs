//! From what a material file says to a material.

use std::path::Path;
use std::sync::Arc;

use fibre_scattering::{HairParameters, Medulla, ScatteringError, WaterFilm};
use glam::Vec3;
use groom::{Ramp, VAxis};

use crate::file::{FieldName, MaterialFile, PigmentSet, VDirection};
use crate::import::Imported;
use crate::{
    Along, ColorRamp, ColorTexture, Field, FurControls, HairColor, Material, MaterialError, Picture,
    Variation, White, WhiteColor,
};

/// A fault and the key it is found at; empty for the material as a whole.
pub type KeyFault = (String, String);

/// Offsets of a far field whose `nodes` are not said.
const NODES: u32 = 16;

impl MaterialFile {
    /// The material, with pictures from `load`, which gets paths as they stand in the file.
    ///
    /// `preset` and `file` must have been resolved ([`MaterialFile::resolved`]); they do not count here.
    ///
    /// # Errors
    /// Every fault that could be found, with its key.
    pub fn material(
        &self,
        load: &dyn Fn(&Path) -> Result<Arc<Picture>, MaterialError>,
    ) -> Result<Material, Vec<KeyFault>> {
        let mut build = Build::new(self);
        build.surface();
        let (medulla, medulla_as_cortex) = build.medulla();
        let variation = build.variation();
        let field = build.field();
        let color = build.color(load);
        let (parameters, pigments) = (build.parameters, self.pigments.unwrap_or(build.imported.pigments));
        let material = Material { parameters, color, pigments, medulla, medulla_as_cortex, variation, field };
        if build.faults.is_empty()
            && let Err(error) = material.check()
        {
            build.named(error);
        }
        if build.faults.is_empty() { Ok(material) } else { Err(build.faults) }
    }
}

struct Build<'a> {
    file: &'a MaterialFile,
    /// What the file begins with.
    imported: Imported,
    parameters: HairParameters,
    faults: Vec<KeyFault>,
}

impl<'a> Build<'a> {
    fn new(file: &'a MaterialFile) -> Self {
        let parameters = HairParameters::default();
        let (color, pigments) = (HairColor::default(), PigmentSet::default());
        let imported = Imported { parameters, color, pigments, varied: [0.0; 2] };
        let mut build = Build { file, imported, parameters, faults: Vec::new() };
        let imports = file.imports();
        if let [one, two, ..] = &imports[..] {
            build.fault(two.key(), format!("contradicts `{}`; keep one", one.key()));
        }
        if let Some(import) = imports.first() {
            match import.fibre() {
                Ok(imported) => {
                    // What is absorbed is the colour's to say.
                    build.parameters = HairParameters { sigma_a: Vec3::ZERO, ..imported.parameters };
                    build.imported = imported;
                }
                Err(error) => build.scattering(import.key(), error),
            }
        }
        build
    }

    /// A fault of the model's, below the key `block` if that has one of its name.
    fn scattering(&mut self, block: &str, error: ScatteringError) {
        match error {
            ScatteringError::OutOfRange { name, found, range } if !name.contains(' ') => {
                let key = if block.is_empty() { name.to_owned() } else { format!("{block}.{name}") };
                self.fault(&key, format!("must lie in {range}, found {found}"));
            }
            error => self.fault(block, error),
        }
    }

    fn fault(&mut self, key: &str, message: impl ToString) {
        self.faults.push((key.to_owned(), message.to_string()));
    }

    /// Notes the fault of `result`, if it is one. Variation and fur name the key themselves.
    fn refuse<T>(&mut self, key: &str, result: Result<T, impl ToString>) -> Option<T> {
        match result {
            Ok(value) => Some(value),
            Err(error) => {
                let message = error.to_string();
                let named = message.strip_prefix(key).map(str::trim_start);
                self.fault(key, named.filter(|_| !key.is_empty()).unwrap_or(&message));
                None
            }
        }
    }

    /// Sets a parameter of the model; what the model says of it alone is told at its key.
    fn set(&mut self, key: &str, apply: impl Fn(&mut HairParameters)) {
        let mut alone = HairParameters::default();
        apply(&mut alone);
        if self.refuse(key, alone.check()).is_some() {
            apply(&mut self.parameters);
        }
    }

    fn surface(&mut self) {
        let file = self.file;
        for (key, value, place) in [
            ("beta_m", file.beta_m, (|p| &mut p.beta_m) as fn(&mut HairParameters) -> &mut f32),
            ("beta_n", file.beta_n, |p| &mut p.beta_n),
            ("eta", file.eta, |p| &mut p.eta),
            ("aspect", file.aspect, |p| &mut p.aspect),
        ] {
            if let Some(value) = value {
                self.set(key, |p| *place(p) = value);
            }
        }
        if let Some(alpha) = file.alpha {
            if alpha > -90.0 && alpha < 90.0 {
                self.set("alpha", |p| p.alpha = alpha.to_radians());
            } else {
                self.fault("alpha", format!("is {alpha}, expected above -90, below 90 degrees"));
            }
        }
        if let Some(layers) = file.cuticle_layers {
            self.set("cuticle_layers", |p| p.cuticle_layers = Some(layers));
        }
        let scales = file.roughness_scales.unwrap_or_default();
        if let Some(tt) = scales.tt {
            self.set("roughness_scales.tt", |p| p.roughness_scales.tt = tt);
        }
        if let Some(trt) = scales.trt {
            self.set("roughness_scales.trt", |p| p.roughness_scales.trt = trt);
        }
        let lobes = file.lobes.unwrap_or_default();
        let weights = [lobes.r, lobes.tt, lobes.trt, lobes.residual, lobes.scattered];
        for (lobe, weight) in fibre_scattering::Lobe::ALL.into_iter().zip(weights) {
            if let Some(weight) = weight {
                let key = format!("lobes.{}", lobe.name());
                self.set(&key, |p| p.lobe_weights[lobe.index()] = weight);
            }
        }
        self.film();
    }

    fn film(&mut self) {
        let (wet, film) = (self.file.wet, self.file.film);
        match (wet, film) {
            (Some(false), Some(_)) => self.fault("film", "contradicts `wet: false`; keep one"),
            (Some(true), _) | (None, Some(_)) => {
                let (water, film) = (WaterFilm::default(), film.unwrap_or_default());
                let eta = film.eta.unwrap_or(water.eta);
                let roughness = film.roughness.unwrap_or(water.roughness);
                self.set("film.eta", |p| p.film.get_or_insert(water).eta = eta);
                self.set("film.roughness", |p| p.film.get_or_insert(water).roughness = roughness);
            }
            (Some(false) | None, None) => {}
        }
    }

    /// The core, and whether it absorbs as the cortex does.
    fn medulla(&mut self) -> (Medulla, bool) {
        let file = self.file;
        match (file.medulla, file.fur) {
            (Some(_), Some(_)) => self.fault("medulla", "contradicts `fur`; keep one"),
            (Some(m), None) => {
                let sigma_a = m.sigma_a.map_or(Vec3::ZERO, Vec3::from);
                let (kappa, sigma_s) = (m.kappa.unwrap_or(0.0), m.sigma_s.unwrap_or(0.0));
                let medulla = Medulla { kappa, sigma_s, sigma_a, g: m.g.unwrap_or(0.0) };
                for (key, alone) in [
                    ("medulla.kappa", Medulla { kappa, ..Medulla::NONE }),
                    ("medulla.sigma_s", Medulla { sigma_s, ..Medulla::NONE }),
                    ("medulla.sigma_a", Medulla { sigma_a, ..Medulla::NONE }),
                    ("medulla.g", Medulla { g: medulla.g, ..Medulla::NONE }),
                ] {
                    self.refuse(key, alone.check());
                }
                return (medulla, false);
            }
            (None, Some(fur)) => {
                if fur.cuticle_layers.is_some() && file.cuticle_layers.is_some() {
                    self.fault("fur.cuticle_layers", "is said by `cuticle_layers` too; keep one");
                } else if let Some(layers) = fur.cuticle_layers {
                    self.set("fur.cuticle_layers", |p| p.cuticle_layers = Some(layers));
                }
                let usual = FurControls::default();
                let controls = FurControls {
                    medulla_color: fur.medulla_color.map(Vec3::from),
                    medulla_index: fur.medulla_index.unwrap_or(usual.medulla_index),
                    medulla_scattering: fur.medulla_scattering.unwrap_or(usual.medulla_scattering),
                    cuticle_layers: None,
                };
                match controls.parameters(self.parameters) {
                    Ok((_, medulla)) => return (medulla, controls.medulla_color.is_none()),
                    Err(error) => self.named(error),
                }
            }
            (None, None) => {}
        }
        (Medulla::NONE, false)
    }

    /// A fault whose message begins with its key.
    fn named(&mut self, error: MaterialError) {
        match error {
            MaterialError::Value { what, found, expected } if !what.contains(' ') => {
                self.fault(&what, format!("is {found}, expected {expected}"));
            }
            MaterialError::Scattering(error) => self.scattering("", error),
            error => self.fault("", error),
        }
    }

    fn variation(&mut self) -> Variation {
        let file = self.file.variation.unwrap_or_default();
        let amount = |value: Option<f32>| value.unwrap_or(0.0);
        let color = match (file.white_melanin, file.white_color) {
            (Some(_), Some(_)) => {
                self.fault("variation.white_color", "contradicts `white_melanin`; keep one");
                WhiteColor::Clear
            }
            (Some(melanin), None) => WhiteColor::Melanin(melanin),
            (None, Some(color)) => WhiteColor::Color(color.into()),
            (None, None) => WhiteColor::Clear,
        };
        if color != WhiteColor::Clear && file.white.is_none() {
            self.fault("variation", "says what white hairs look like and not how many: add `white: 0.1`");
        }
        let along = self.file.along.clone().unwrap_or_default();
        let mut ramp = |key: &str, points: Option<Vec<(f32, f32)>>| {
            points.and_then(|points| self.refuse(key, Ramp::new(points)))
        };
        let absorption = ramp("along.absorption", along.absorption);
        let melanin = ramp("along.melanin", along.melanin);
        let [pigment, roughness] = self.imported.varied;
        let variation = Variation {
            seed: file.seed.unwrap_or(0),
            pigment: file.pigment.unwrap_or(pigment),
            redness: amount(file.redness),
            hue: amount(file.hue) / 360.0,
            value: amount(file.value),
            roughness: file.roughness.unwrap_or(roughness),
            white: White { share: amount(file.white), color },
            along: Along { absorption, melanin },
        };
        let degrees = amount(file.hue);
        if (0.0..=180.0).contains(&degrees) {
            if let Err(error) = variation.check() {
                self.named(error);
            }
        } else {
            self.fault("variation.hue", format!("is {degrees}, expected 0..180 degrees"));
        }
        variation
    }

    fn field(&mut self) -> Field {
        match (self.file.field, self.file.nodes) {
            (Some(FieldName::Far), nodes) => {
                let nodes = nodes.unwrap_or(NODES);
                if !(1..=64).contains(&nodes) {
                    self.fault("nodes", format!("is {nodes}, expected 1..=64"));
                }
                Field::Far { nodes }
            }
            (_, Some(_)) => {
                self.fault("nodes", "needs `field: far` beside it");
                Field::Near
            }
            (_, None) => Field::Near,
        }
    }

    fn color(&mut self, load: &dyn Fn(&Path) -> Result<Arc<Picture>, MaterialError>) -> HairColor {
        let file = self.file;
        let ways = file.ways();
        if let [first, second, ..] = ways[..] {
            self.fault(second, format!("the colour is said by `{first}` too; keep one of {}", listed(&ways)));
            return HairColor::default();
        }
        if file.redness.is_some() && file.melanin.is_none() {
            self.fault("redness", "needs `melanin` beside it");
        }
        let base_color = file.fur.and_then(|fur| fur.base_color);
        if let Some(color) = file.color.or(base_color) {
            let key = if file.color.is_some() { "color" } else { "fur.base_color" };
            self.unit_color(key, color);
            HairColor::Color(color.into())
        } else if let Some(absorption) = file.absorption {
            self.set("absorption", |p| p.sigma_a = absorption.into());
            self.parameters.sigma_a = Vec3::ZERO;
            HairColor::Absorption(absorption.into())
        } else if let Some(concentration) = file.melanin {
            let redness = file.redness.unwrap_or(0.0);
            self.unit("melanin", concentration);
            self.unit("redness", redness);
            HairColor::Melanin { concentration, redness }
        } else if file.eumelanin.is_some() || file.pheomelanin.is_some() {
            let (eumelanin, pheomelanin) = (file.eumelanin.unwrap_or(0.0), file.pheomelanin.unwrap_or(0.0));
            for (key, amount) in [("eumelanin", eumelanin), ("pheomelanin", pheomelanin)] {
                if !(0.0..=1e4).contains(&amount) {
                    self.fault(key, format!("is {amount}, expected 0..10000"));
                }
            }
            HairColor::Pigments { eumelanin, pheomelanin }
        } else if let Some(ramp) = &file.color_ramp {
            let points = ramp.iter().map(|&(t, color)| (t, Vec3::from(color))).collect();
            self.refuse("color_ramp", ColorRamp::new(points)).map_or(HairColor::default(), HairColor::Ramp)
        } else if let Some(texture) = &file.texture {
            let v_axis = match texture.v {
                VDirection::Up => VAxis::Up,
                VDirection::Down => VAxis::Down,
            };
            let picture = self.refuse("texture.file", load(&texture.file));
            let file = texture.file.clone();
            picture.map_or(HairColor::default(), |picture| {
                HairColor::Texture(ColorTexture { file, v_axis, picture })
            })
        } else if file.groom.is_some() {
            self.groom_color()
        } else {
            self.imported.color.clone()
        }
    }

    fn groom_color(&mut self) -> HairColor {
        let groom = self.file.groom.unwrap_or_default();
        match (groom.color, groom.melanin) {
            (Some(_), Some(_)) => self.fault("groom.melanin", "contradicts `color`; keep one"),
            (None, None) if groom.redness.is_some() => {
                self.fault("groom.redness", "needs `melanin` beside it");
            }
            (Some(color), None) => {
                self.unit_color("groom.color", color);
                return HairColor::Groom { fallback: color.into() };
            }
            (None, Some(concentration)) => {
                let redness = groom.redness.unwrap_or(0.0);
                self.unit("groom.melanin", concentration);
                self.unit("groom.redness", redness);
                return HairColor::GroomMelanin { concentration, redness };
            }
            (None, None) => {}
        }
        HairColor::default()
    }

    fn unit(&mut self, key: &str, found: f32) {
        if !(0.0..=1.0).contains(&found) {
            self.fault(key, format!("is {found}, expected 0..1"));
        }
    }

    fn unit_color(&mut self, key: &str, found: [f32; 3]) {
        if !found.iter().all(|channel| (0.0..=1.0).contains(channel)) {
            self.fault(key, format!("is {found:?}, expected three numbers in 0..1"));
        }
    }
}

fn listed(keys: &[&str]) -> String {
    keys.iter().map(|key| format!("`{key}`")).collect::<Vec<_>>().join(", ")
}
