//! The rows there are.

use fibre_material::{Field, FurControls, HairColor, Material, MaterialError};
use fibre_scattering::{HairParameters, WaterFilm};
use glam::Vec3;
use hair_render::HairMaterial;

use crate::{Cell, Row, SweepError, colors};

/// The thesis' base colour.
const BASE: Vec3 = Vec3::new(0.856, 0.212_813, 0.046_948);
/// A medulla that is told from it: a pale blue.
const OTHER: Vec3 = Vec3::new(0.25, 0.45, 0.75);
/// Offsets the far field is integrated by.
const NODES: u32 = 16;

impl Row {
    /// Every row, in the order of the thesis.
    ///
    /// # Errors
    /// [`SweepError::Material`], which the values written here do not lead to.
    pub fn all() -> Result<Vec<Row>, SweepError> {
        Ok(vec![
            offset(),
            beta_m(),
            beta_n(),
            alpha(),
            color(),
            medulla_index()?,
            medulla_scattering()?,
            cuticle_layers()?,
            hair_and_fur()?,
            wet(),
            far_field(),
        ])
    }

    /// The rows of these names, in the order of [`Row::all`]; all of them where none is named.
    ///
    /// # Errors
    /// [`SweepError::Row`] for a name that is not there.
    pub fn named(names: &[String]) -> Result<Vec<Row>, SweepError> {
        let mut rows = Row::all()?;
        for name in names {
            if !rows.iter().any(|row| row.name == name) {
                let known: Vec<&str> = rows.iter().map(|row| row.name).collect();
                return Err(SweepError::Row { name: name.clone(), known: known.join(", ") });
            }
        }
        if !names.is_empty() {
            rows.retain(|row| names.iter().any(|name| name == row.name));
        }
        Ok(rows)
    }
}

/// The thesis' hair shader at its defaults, but for what `change` changes.
fn hair(change: impl FnOnce(&mut HairParameters)) -> Material {
    let mut parameters = HairParameters {
        beta_m: 0.25,
        beta_n: 0.3,
        alpha: 2_f32.to_radians(),
        eta: 1.55,
        ..HairParameters::default()
    };
    change(&mut parameters);
    Material { parameters, color: HairColor::Color(BASE), ..Material::default() }
}

/// The same as fur.
fn fur(controls: FurControls) -> Result<Material, MaterialError> {
    let hair = hair(|_| {});
    let (parameters, medulla) = controls.parameters(hair.parameters)?;
    let medulla_as_cortex = controls.medulla_color.is_none();
    Ok(Material { parameters, medulla, medulla_as_cortex, ..hair })
}

fn offset() -> Row {
    let cell = |h: f32| Cell {
        material: HairMaterial { fixed_offset: Some(h), ..Cell::new("", hair(|_| {})).material },
        caption: format!("h = {h}"),
    };
    Row {
        name: "h",
        title: "Offset across the fibre, one for all hits",
        figure: Some("3.8"),
        shows: "Where a ray meets a fibre is geometry, and fixing it is for looking only: at the rims all light \
                is mirrored and no colour is left; through the middle the fibre absorbs most.",
        cells: [-1.0, 0.0, 1.0].map(cell).into(),
    }
}

fn beta_m() -> Row {
    let cell = |beta: f32| Cell::new(format!("beta_m = {beta}"), hair(|h| h.beta_m = beta));
    Row {
        name: "beta-m",
        title: "Longitudinal roughness",
        figure: Some("3.9"),
        shows: "Low: shiny, the highlights narrow. High: flat.",
        cells: [0.1, 0.25, 0.6].map(cell).into(),
    }
}

fn beta_n() -> Row {
    // One absorption for all: through the fit of a colour, which knows beta_n, all would be as light.
    let sigma = Vec3::new(0.01, 0.12, 0.4);
    let cell = |beta: f32| {
        let material = Material { color: HairColor::Absorption(sigma), ..hair(|h| h.beta_n = beta) };
        Cell::new(format!("beta_n = {beta}"), material)
    };
    Row {
        name: "beta-n",
        title: "Azimuthal roughness",
        figure: Some("3.10"),
        shows: "With one absorption, hair is lighter the higher it is: more of the light that was scattered \
                many times finds its way out.",
        cells: [0.1, 0.25, 0.5, 0.7].map(cell).into(),
    }
}

fn alpha() -> Row {
    let cell = |degrees: f32| {
        Cell::new(format!("alpha = {degrees} degrees"), hair(|h| h.alpha = degrees.to_radians()))
    };
    Row {
        name: "alpha",
        title: "Tilt of the cuticle's scales",
        figure: Some("3.11"),
        shows: "More tilt moves the white highlight towards the root and the coloured one towards the tip.",
        cells: [2.0, 4.5].map(cell).into(),
    }
}

fn color() -> Row {
    let cell = |named: crate::NamedColor| {
        let material = Material { color: HairColor::Color(named.linear), ..hair(|_| {}) };
        Cell::new(named.name, material)
    };
    Row {
        name: "color",
        title: "Colour, by Chiang's fit",
        figure: Some("3.12"),
        shows: "One fibre each; only the absorption differs.",
        cells: colors().into_iter().map(cell).collect(),
    }
}

fn medulla_index() -> Result<Row, SweepError> {
    let cell = |index: f32| {
        let controls =
            FurControls { medulla_color: Some(OTHER), medulla_index: index, ..FurControls::default() };
        Ok(Cell::new(format!("medulla index {index}"), fur(controls)?))
    };
    Ok(Row {
        name: "medulla-index",
        title: "Medulla index",
        figure: Some("3.13"),
        shows: "0: hair of the base colour. 1: all medulla, and the medulla's colour (a pale blue here).",
        cells: [0.0, 0.5, 1.0].map(cell).into_iter().collect::<Result<_, SweepError>>()?,
    })
}

fn medulla_scattering() -> Result<Row, SweepError> {
    let cell = |scattering: f32| {
        let controls = FurControls { medulla_scattering: scattering, ..FurControls::default() };
        Ok(Cell::new(format!("medulla scattering {scattering}"), fur(controls)?))
    };
    Ok(Row {
        name: "medulla-scattering",
        title: "Medulla scattering",
        figure: Some("3.14"),
        shows: "The more the medulla scatters, the softer and the more alike from all sides the fibre is.",
        cells: [0.01, 0.065, 0.2].map(cell).into_iter().collect::<Result<_, SweepError>>()?,
    })
}

fn cuticle_layers() -> Result<Row, SweepError> {
    let cell = |layers: f32| {
        let controls = FurControls { cuticle_layers: Some(layers), ..FurControls::default() };
        Ok(Cell::new(format!("{layers} layers"), fur(controls)?))
    };
    Ok(Row {
        name: "cuticle-layers",
        title: "Cuticle layers",
        figure: Some("3.15"),
        shows: "More layers reflect more at the surface: paler, and with a stronger white highlight.",
        cells: [0.1, 2.45].map(cell).into_iter().collect::<Result<_, SweepError>>()?,
    })
}

fn hair_and_fur() -> Result<Row, SweepError> {
    let both = FurControls { medulla_color: Some(BASE), ..FurControls::default() };
    Ok(Row {
        name: "hair-fur",
        title: "Hair against fur of the same colours",
        figure: Some("4.5"),
        shows: "Base and medulla have one colour; the medulla spreads the light that hair sends on.",
        cells: vec![Cell::new("hair", hair(|_| {})), Cell::new("fur", fur(both)?)],
    })
}

fn wet() -> Row {
    Row {
        name: "wet",
        title: "Dry and wet",
        figure: None,
        shows: "A film of water takes away most of the step in index at the fibre: less light comes back, and \
                the film's own surface is smooth. Darker and shinier; nothing else changes.",
        cells: vec![
            Cell::new("dry", hair(|_| {})),
            Cell::new("wet", hair(|h| h.film = Some(WaterFilm::default()))),
        ],
    }
}

fn far_field() -> Row {
    let far = Material { field: Field::Far { nodes: NODES }, ..hair(|_| {}) };
    Row {
        name: "field",
        title: "Near field and far field",
        figure: None,
        shows: "Every hit with its own offset, or the offset integrated out: the same but for the noise where \
                fibres are thinner than a pixel.",
        cells: vec![Cell::new("near", hair(|_| {})), Cell::new(format!("far, {NODES} offsets"), far)],
    }
}
