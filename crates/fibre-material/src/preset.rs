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

/// Every preset, named after what it is. The fur sets' roughnesses are explained at [`Preset::all`].
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
