//! Which material is checked: a preset, and what the command line changes in it.

use anyhow::{anyhow, bail};
use fibre_material::{Field, HairColor, Material, Varying};
use fibre_verification::Subject;
use glam::Vec3;
use groom::Groom;

#[derive(Debug, Clone, clap::Args)]
#[command(next_help_heading = "Material")]
pub struct MaterialArgs {
    /// A material by name
    #[arg(long, value_name = "NAME", default_value = "default")]
    pub preset: String,
    /// Colour r,g,b of a head of hair, 0..1
    #[arg(long, value_name = "RGB", value_parser = parse_rgb, conflicts_with = "absorption")]
    pub color: Option<Vec3>,
    /// Absorption of the cortex r,g,b per fibre radius
    #[arg(long, value_name = "RGB", value_parser = parse_rgb)]
    pub absorption: Option<Vec3>,
    /// Roughness along the fibre, above 0, at most 1
    #[arg(long)]
    pub beta_m: Option<f32>,
    /// Roughness around the fibre, above 0, at most 1
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
    /// Its name, for titles.
    pub fn title(&self) -> String {
        self.preset.clone()
    }

    /// The model of it.
    pub fn subject(&self) -> anyhow::Result<Subject> {
        let mut material = match self.preset.as_str() {
            "default" => Material::default(),
            name => bail!("there is no preset `{name}`: expected default"),
        };
        self.change(&mut material);
        // A fibre alone: what varies over a groom takes the value a groom without that attribute has.
        let strand = Groom::new(vec![0, 2], vec![Vec3::ZERO, Vec3::Y])?;
        let dressed = material.dress(&strand)?;
        let Varying::Constant(absorption) = dressed.absorption else {
            return Err(anyhow!("the material's absorption differs from strand to strand: give one colour"));
        };
        let mut parameters = dressed.parameters;
        (parameters.hair.sigma_a, parameters.medulla.sigma_a) = (absorption.cortex(), absorption.medulla());
        let nodes = match dressed.field {
            Field::Near => None,
            Field::Far { nodes } => Some(nodes),
        };
        Ok(Subject::new(&parameters, nodes)?)
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
