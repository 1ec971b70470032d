//! Which material is checked: a preset, and what the command line changes in it.

use std::path::PathBuf;

use fibre_material::{Field, HairColor, Material};
use fibre_verification::Subject;
use glam::Vec3;

#[derive(Debug, Clone, clap::Args)]
#[command(next_help_heading = "Material")]
pub struct MaterialArgs {
    /// A material file (.yaml) [default: light brown hair]
    #[arg(long, value_name = "FILE", conflicts_with = "preset")]
    pub material: Option<PathBuf>,
    /// A material by name; `list` prints the names
    #[arg(long, value_name = "NAME")]
    pub preset: Option<String>,
    /// Colour r,g,b of a head of hair, 0..1
    #[arg(long, value_name = "RGB", value_parser = parse_rgb, conflicts_with = "absorption")]
    pub color: Option<Vec3>,
    /// Absorption of the cortex r,g,b per fibre radius
    #[arg(long, value_name = "RGB", value_parser = parse_rgb)]
    pub absorption: Option<Vec3>,
    /// Roughness along the fibre, 0.001 to 1
    #[arg(long)]
    pub beta_m: Option<f32>,
    /// Roughness around the fibre, 0.001 to 1
    #[arg(long)]
    pub beta_n: Option<f32>,
    /// Tilt of the cuticle's scales, in degrees; positive tilts R to the root
    #[arg(long, allow_hyphen_values = true)]
    pub alpha: Option<f32>,
    /// Index of refraction, 1.0001..3
    #[arg(long)]
    pub eta: Option<f32>,
    /// Radius of the medulla over that of the fibre, 0..0.99
    #[arg(long)]
    pub kappa: Option<f32>,
    /// Scattering of the medulla per fibre radius, 0..100
    #[arg(long, value_name = "SIGMA")]
    pub medulla_scattering: Option<f32>,
    /// Absorption of the medulla r,g,b per fibre radius
    #[arg(long, value_name = "RGB", value_parser = parse_rgb)]
    pub medulla_absorption: Option<Vec3>,
    /// Mean cosine of the medulla's scattering, -0.99..0.99
    #[arg(long, allow_hyphen_values = true)]
    pub g: Option<f32>,
    /// Layers of the cuticle
    #[arg(long, value_name = "LAYERS")]
    pub cuticle_layers: Option<f32>,
    /// See the fibre from afar, by so many nodes over its width, 1..64
    #[arg(long, value_name = "NODES")]
    pub far_field: Option<u32>,
}

impl MaterialArgs {
    /// Its name, for titles, and what the command line changes in it.
    pub fn title(&self) -> String {
        let name = match (&self.material, &self.preset) {
            (Some(path), _) => path.file_stem().unwrap_or(path.as_os_str()).to_string_lossy().into_owned(),
            (None, Some(preset)) => preset.clone(),
            (None, None) => "hair".to_owned(),
        };
        if self.changes() { format!("{name}, changed on the command line") } else { name }
    }

    /// The model of it: of a fibre alone, so that what varies over a groom takes its mean.
    pub fn subject(&self) -> anyhow::Result<Subject> {
        let mut material = match (&self.material, &self.preset) {
            (Some(path), _) => Material::open(path)?,
            (None, Some(preset)) => Material::preset(preset)?,
            (None, None) => Material::default(),
        };
        self.change(&mut material);
        material.check()?;
        let nodes = match material.field {
            Field::Near => None,
            Field::Far { nodes } => Some(nodes),
        };
        Ok(Subject::new(&material.constant()?, nodes)?)
    }

    fn changes(&self) -> bool {
        let numbers = [
            self.beta_m,
            self.beta_n,
            self.alpha,
            self.eta,
            self.kappa,
            self.medulla_scattering,
            self.g,
            self.cuticle_layers,
        ];
        let colors = [self.color, self.absorption, self.medulla_absorption];
        numbers.iter().any(Option::is_some) || colors.iter().any(Option::is_some) || self.far_field.is_some()
    }

    fn change(&self, material: &mut Material) {
        let hair = &mut material.parameters;
        set(&mut hair.beta_m, self.beta_m);
        set(&mut hair.beta_n, self.beta_n);
        set(&mut hair.alpha, self.alpha.map(f32::to_radians));
        set(&mut hair.eta, self.eta);
        hair.cuticle_layers = self.cuticle_layers.or(hair.cuticle_layers);
        set(&mut material.color, self.color.map(HairColor::Color));
        set(&mut material.color, self.absorption.map(HairColor::Absorption));
        set(&mut material.medulla.kappa, self.kappa);
        set(&mut material.medulla.sigma_s, self.medulla_scattering);
        set(&mut material.medulla.sigma_a, self.medulla_absorption);
        set(&mut material.medulla.g, self.g);
        set(&mut material.field, self.far_field.map(|nodes| Field::Far { nodes }));
    }
}

fn set<T>(place: &mut T, value: Option<T>) {
    if let Some(value) = value {
        *place = value;
    }
}

fn parse_rgb(words: &str) -> Result<Vec3, String> {
    let numbers: Result<Vec<f32>, _> = words.split(',').map(|word| word.trim().parse::<f32>()).collect();
    match numbers.map_err(|fault| fault.to_string())?[..] {
        [grey] => Ok(Vec3::splat(grey)),
        [r, g, b] => Ok(Vec3::new(r, g, b)),
        ref other => Err(format!("expected 1 or 3 numbers, found {}", other.len())),
    }
}
