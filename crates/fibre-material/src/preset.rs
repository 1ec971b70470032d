//! Materials by name.

use crate::MaterialError;
use crate::file::MaterialFile;

/// A material that comes with the program, in the words of a material file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Preset {
    /// What it is called.
    pub name: &'static str,
    /// What it says, as one line of YAML without the braces.
    pub keys: &'static str,
    /// Where the figures are from.
    pub source: &'static str,
}

const fn preset(name: &'static str, keys: &'static str, source: &'static str) -> Preset {
    Preset { name, keys, source }
}

/// Every preset, named after what it is.
///
/// The two fur sets state roughness as Gaussian deviations in degrees: along, b for TT and 3/2 b for TRT, and for
/// R root 2 b cos(phi/2), whose variance over all azimuths is b^2 too; around, b, root 2 b and root 3 b for R,
/// TT and TRT, 2 b^2 in the mean. Ours are those of the same variances: `beta_m` by Chiang et al. 2016, eq. 7,
/// with scales of 1 and 3/2, `beta_n` by eq. 8, whose logistic of scale s root(pi/8) has the variance
/// s^2 pi^3/24. A test works them out again. Absorption and scattering are per fibre radius and the layers
/// count as in 2017, as here; the tilt is taken to open to the tip, as scales do.
#[rustfmt::skip]
const PRESETS: &[Preset] = &[
    preset("default", "", "the groom's own colour; roughness, tilt and index as pbrt-v4 has them"),
    preset("thesis-hair", "color: [0.856, 0.212813, 0.046948], beta_m: 0.25, beta_n: 0.3, alpha: 2, eta: 1.55", "PBR Hair Shader Extended (2019), its default parameters"),
    preset("thesis-fur", "color: [0.856, 0.212813, 0.046948], beta_m: 0.25, beta_n: 0.3, alpha: 2, eta: 1.55, fur: {medulla_index: 0.5, medulla_scattering: 0.065}", "PBR Fur Shader (2019): the hair shader's defaults, the middle of its rows of pictures"),
    preset("human-white", "melanin: 0", "no pigment"),
    preset("human-light-blond", "eumelanin: 0.1, pheomelanin: 0", "a third of pbrt's blond"),
    preset("human-blond", "eumelanin: 0.3, pheomelanin: 0", "pbrt-v4, hair material: eumelanin 0.3 is blond"),
    preset("human-golden-blond", "eumelanin: 0.15, pheomelanin: 0.3", "as much absorption in green as pbrt's blond, half of it by pheomelanin"),
    preset("human-red", "melanin: 0.5, redness: 1", "3Delight manual: red and brown around melanin 0.5; all of it pheomelanin"),
    preset("human-brown", "eumelanin: 1.3, pheomelanin: 0", "pbrt-v4, hair material: its default, brown"),
    preset("human-black", "eumelanin: 8, pheomelanin: 0", "pbrt-v4, hair material: eumelanin 8 is black"),
    preset("human-brown-greying", "eumelanin: 1.3, pheomelanin: 0, variation: {white: 0.2, pigment: 0.2}", "human-brown, every fifth hair white"),
    preset("human-blond-wet", "eumelanin: 0.3, pheomelanin: 0, wet: true", "human-blond under a film of water, index 1.33"),
    preset("human-brown-wet", "eumelanin: 1.3, pheomelanin: 0, wet: true", "human-brown under a film of water, index 1.33"),
    preset("fur-kappa-0.86", "absorption: [0.39, 0.39, 0.39], beta_m: 0.187754, beta_n: 0.466053, roughness_scales: {tt: 1, trt: 1.5}, alpha: 2.64, eta: 1.49, cuticle_layers: 0.68, medulla: {kappa: 0.86, sigma_s: 3.15, sigma_a: [0.21, 0.21, 0.21], g: 0.79}", "Yan et al. 2017's model, the defaults of one public port of it: a fit to measured fur, animal not named"),
    preset("fur-kappa-0.88", "absorption: [0.64, 0.64, 0.64], beta_m: 0.223807, beta_n: 0.274434, roughness_scales: {tt: 1, trt: 1.5}, alpha: 5.48, eta: 1.55, cuticle_layers: 0.47, medulla: {kappa: 0.88, sigma_s: 1.69, sigma_a: [0.17, 0.17, 0.17], g: 0.44}", "Yan et al. 2017's model, the defaults of another public port of it: a fit to measured fur, animal not named"),
    preset("arnold-default", "arnold: {}", "Arnold standard_hair, its defaults"),
    preset("cycles-default", "cycles: {}", "Blender Principled Hair BSDF, model Chiang, its defaults"),
    preset("cycles-melanin-default", "cycles: {parametrization: melanin}", "Blender Principled Hair BSDF, model Chiang, by melanin"),
    preset("materialx-default", "melanin: 0.25, redness: 0.5, beta_m: 0.1, beta_n: 0.2, alpha: 0, eta: 1.55", "MaterialX 1.39: chiang_hair_roughness and deon_hair_absorption_from_melanin, their defaults, in chiang_hair_bsdf"),
    preset("mitsuba-default", "mitsuba: {}", "Mitsuba 3 hair, its defaults"),
    preset("pbrt-default", "pbrt: {}", "pbrt-v4 hair, its defaults"),
    preset("renderman-default", "renderman: {}", "RenderMan PxrMarschnerHair, its defaults"),
];

impl Preset {
    /// All presets.
    #[must_use]
    pub fn all() -> &'static [Preset] {
        PRESETS
    }

    /// The preset called `name`.
    ///
    /// # Errors
    /// [`MaterialError::Preset`] with the name that may have been meant.
    pub fn named(name: &str) -> Result<&'static Preset, MaterialError> {
        PRESETS.iter().find(|preset| preset.name == name).ok_or_else(|| {
            let names = || PRESETS.iter().map(|preset| preset.name);
            let hint = match strict_yaml::nearest(name, names()) {
                Some(meant) => format!("did you mean `{meant}`?"),
                None => format!("expected one of {}", names().collect::<Vec<_>>().join(", ")),
            };
            MaterialError::Preset { name: name.to_owned(), hint }
        })
    }

    /// The preset as a file would say it.
    ///
    /// # Errors
    /// None: every preset is read by a test.
    pub fn file(&self) -> Result<MaterialFile, MaterialError> {
        strict_yaml::parse(&format!("{{{}}}", self.keys)).map_err(|fault| {
            let (file, key) = (self.name.into(), String::new());
            let place = fault.place.map(|place| (place.line, place.column));
            MaterialError::File(vec![strict_yaml::Fault { file, place, key, message: fault.message }])
        })
    }
}
