//! The hair material that goes with the strands.

use std::path::PathBuf;

use clap::Args;

/// The parameters of Chiang et al. 2016, for formats that hold materials.
#[derive(Clone, Debug, Args)]
#[command(next_help_heading = "Material (USD, pbrt)")]
pub(crate) struct MaterialOptions {
    /// Write a hair material, its colour from: `groom` (the strands' mean colour), `color:R,G,B`,
    /// `melanin:CONCENTRATION,REDNESS` (0 to 1 each) or `absorption:R,G,B` (per fibre radius); or all of it from
    /// `file:PATH` (a material file) or `preset:NAME`, as hair-render has them
    #[arg(long, value_name = "SOURCE", value_parser = source)]
    pub(crate) material: Option<Source>,

    /// Roughness along the fibre, 0.001 to 1 [default: the material's, or 0.3]
    #[arg(long, value_name = "BETA", requires = "material")]
    pub(crate) beta_m: Option<f32>,

    /// Roughness around the fibre, 0.001 to 1 [default: the material's, or 0.3]
    #[arg(long, value_name = "BETA", requires = "material")]
    pub(crate) beta_n: Option<f32>,

    /// Tilt of the cuticle's scales in degrees, over 0 towards the root [default: the material's, or 2]
    #[arg(long, value_name = "DEGREES", requires = "material", allow_hyphen_values = true)]
    pub(crate) alpha: Option<f32>,

    /// Index of refraction, 1.0001 to 3 [default: the material's, or 1.55]
    #[arg(long, value_name = "ETA", requires = "material")]
    pub(crate) eta: Option<f32>,
}

/// Where the colour of the material comes from.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Source {
    /// The mean colour of the strands.
    Groom,
    /// A colour under white light, linear Rec. 709.
    Color([f32; 3]),
    /// Concentration and redness.
    Melanin([f32; 2]),
    /// Absorption per fibre radius.
    Absorption([f32; 3]),
    /// A material file, with more than the colour.
    File(PathBuf),
    /// A preset, with more than the colour.
    Preset(String),
}

fn source(text: &str) -> Result<Source, String> {
    let (kind, values) = text.split_once(':').unwrap_or((text, ""));
    match kind {
        "groom" if values.is_empty() => Ok(Source::Groom),
        "color" => numbers(values, 1.0).map(Source::Color),
        "melanin" => numbers(values, 1.0).map(Source::Melanin),
        "absorption" => numbers(values, f32::MAX).map(Source::Absorption),
        "file" if !values.is_empty() => Ok(Source::File(values.into())),
        "preset" if !values.is_empty() => Ok(Source::Preset(values.into())),
        _ => {
            Err("expected groom, color:R,G,B, melanin:CONCENTRATION,REDNESS, absorption:R,G,B, file:PATH or \
                  preset:NAME"
                .into())
        }
    }
}

/// `N` numbers from 0 to `most`, separated by commas.
fn numbers<const N: usize>(text: &str, most: f32) -> Result<[f32; N], String> {
    let numbers: Option<Vec<f32>> = text.split(',').map(|word| word.trim().parse().ok()).collect();
    let good = |numbers: &Vec<f32>| numbers.iter().all(|v| (0.0..=most).contains(v));
    let bound = if most < f32::MAX { format!("from 0 to {most}") } else { "not below 0".to_owned() };
    numbers
        .filter(good)
        .and_then(|numbers| numbers.try_into().ok())
        .ok_or_else(|| format!("expected {N} numbers {bound}, separated by commas"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sources_are_read_or_refused() {
        assert_eq!(source("groom"), Ok(Source::Groom));
        assert_eq!(source("color:1,0.5,0"), Ok(Source::Color([1.0, 0.5, 0.0])));
        assert_eq!(source("melanin:0.6, 0.1"), Ok(Source::Melanin([0.6, 0.1])));
        assert_eq!(source("absorption:3,7,20"), Ok(Source::Absorption([3.0, 7.0, 20.0])));
        assert_eq!(source("file:a:b.yaml"), Ok(Source::File("a:b.yaml".into())));
        assert_eq!(source("preset:human-red"), Ok(Source::Preset("human-red".into())));
        for text in [
            "",
            "groom:1",
            "color:1,1",
            "color:1,1,2",
            "melanin:0.5",
            "absorption:-1,0,0",
            "color:nan,0,0",
            "file:",
            "preset",
        ] {
            assert!(source(text).is_err(), "{text}");
        }
    }
}
