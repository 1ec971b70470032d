//! Materials of hair and fur as people describe them, and what they come to on a groom.
//!
//! A [`Material`] comes from a YAML file ([`Material::open`]; [`MaterialFile`] lists the keys), a preset
//! ([`Material::preset`]) or code. [`Material::dress`] puts it on a groom: what differs from strand to strand
//! or along a strand is worked out there, once, and what does not is held once.
//!
//! ```
//! use fibre_material::{Material, Varying};
//!
//! let text = "preset: human-brown\nvariation: {white: 0.15, pigment: 0.3}\nbeta_m: 0.25\n";
//! let greying = Material::from_yaml(text, "greying.yaml")?;
//! assert_eq!(greying.variation.white.share, 0.15);
//!
//! let points = (0..3000).map(|i| glam::Vec3::new((i / 3) as f32, (i % 3) as f32, 0.0)).collect();
//! let groom = groom::Groom::new((0..=1000).map(|strand| 3 * strand).collect(), points)?;
//! let dressed = greying.dress(&groom)?;
//! let Varying::Strand(absorption) = &dressed.absorption else { panic!("every strand is its own") };
//! let white = absorption.iter().filter(|absorption| absorption.cortex() == glam::Vec3::ZERO).count();
//! assert!((100..200).contains(&white));
//!
//! let fault = Material::from_yaml("beta_m: 0.3\nmelanine: 0.4\n", "a.yaml").unwrap_err();
//! assert_eq!(fault.to_string(), "a.yaml:2:1: unknown key `melanine`, did you mean `melanin`?");
//! let fault = Material::from_yaml("eta: 1.55\nbeta_m: 7\n", "a.yaml").unwrap_err();
//! assert_eq!(fault.to_string(), "a.yaml:2:9: beta_m: must lie in [0.001, 1], found 7");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod build;
mod color;
mod dressed;
mod error;
mod file;
mod fur_controls;
mod hue;
mod import;
mod material;
mod open;
mod overlay;
mod painter;
mod picture;
mod preset;
mod variation;
mod varying;

pub use build::KeyFault;
pub use color::{ColorRamp, ColorTexture, HairColor};
pub use dressed::Dressed;
pub use error::MaterialError;
pub use file::{
    AlongFile, FieldName, FilmFile, FurFile, GroomColor, LobesFile, MaterialFile, MedullaFile, PigmentSet,
    ScalesFile, TextureFile, VDirection, VariationFile,
};
pub use fur_controls::FurControls;
pub use import::{
    ArnoldBlock, CyclesBlock, CyclesColoring, Degrees, MaterialXBlock, MitsubaBlock, PbrtBlock,
    RenderManBlock,
};
pub use material::{Field, Material};
pub use picture::{Picture, linear_pixels};
pub use preset::Preset;
pub use variation::{Along, Variation, White, WhiteColor};
pub use varying::Varying;
