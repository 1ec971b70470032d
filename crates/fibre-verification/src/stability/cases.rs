//! The extreme cases, as data.

use fibre_scattering::{FurParameters, HairParameters, Medulla, RoughnessScales, WaterFilm};
use glam::Vec3;

use crate::scatterer::View;

/// One fibre from one direction.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// What is extreme about it: cases of a family share a line of the page.
    pub family: &'static str,
    /// The extreme value, in words.
    pub name: String,
    /// The fibre.
    pub parameters: FurParameters,
    /// Nodes over the offset, for the far field.
    pub nodes: Option<u32>,
    /// From where it is seen.
    pub view: View,
}

/// Roughness along and around.
const ROUGHNESS: [(f32, f32); 10] = [
    (0.001, 0.001),
    (0.01, 0.01),
    (0.1, 0.1),
    (0.3, 0.3),
    (0.6, 0.6),
    (1.0, 1.0),
    (0.001, 1.0),
    (1.0, 0.001),
    (0.3, 0.001),
    (0.001, 0.3),
];

/// Inclination in degrees and offset.
const VIEWS: [(f64, f64); 8] = [
    (0.0, 0.0),
    (30.0, 0.5),
    (-60.0, -0.95),
    (89.0, 0.3),
    (0.0, 0.9999),
    (89.99, 0.0),
    (89.99, 0.9999),
    (-89.99, -0.9999),
];

const INDICES: [f32; 6] = [1.0001, 1.01, 1.1, 1.33, 2.0, 3.0];
const ABSORPTIONS: [f32; 6] = [0.0, 1e-3, 1.0, 10.0, 100.0, 1e4];
const TILTS: [f32; 4] = [-20.0, 0.0, 10.0, 60.0];
const FILM_ROUGHNESS: [f32; 3] = [0.001, 0.1, 1.0];
const LAYERS: [f32; 3] = [0.1, 2.45, 20.0];
const ASPECTS: [f32; 3] = [0.3, 0.7, 0.95];
const NODES: [u32; 3] = [1, 8, 64];

/// kappa, sigma_s, g.
const MEDULLAE: [(f32, f32, f32); 10] = [
    (0.01, 1.0, 0.0),
    (0.33, 0.01, 0.5),
    (0.33, 100.0, 0.0),
    (0.7, 3.0, 0.5),
    (0.86, 3.15, 0.79),
    (0.9, 100.0, 0.99),
    (0.9, 1.0, -0.99),
    (0.99, 0.01, 0.0),
    (0.99, 3.0, 0.99),
    (0.99, 100.0, -0.99),
];

/// A fibre that is coloured in every channel otherwise, so that no lobe hides behind another.
fn base() -> HairParameters {
    HairParameters { sigma_a: Vec3::new(0.06, 0.3, 1.0), ..HairParameters::default() }
}

/// Every case of the table, in the order of the page.
#[must_use]
pub fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add =
        |family, name: String, hair: HairParameters, medulla: Medulla, nodes, views: &[(f64, f64)]| {
            for &(theta, h) in views {
                let view = View::degrees(theta, h);
                let parameters = FurParameters { hair, medulla };
                cases.push(Case { family, name: name.clone(), parameters, nodes, view });
            }
        };
    let few = [VIEWS[1], VIEWS[2], VIEWS[6]];
    let none = Medulla::NONE;
    for (beta_m, beta_n) in ROUGHNESS {
        let hair = HairParameters { beta_m, beta_n, ..base() };
        add("roughness", format!("beta_m {beta_m}, beta_n {beta_n}"), hair, none, None, &VIEWS);
    }
    for eta in INDICES {
        add("index", format!("eta {eta}"), HairParameters { eta, ..base() }, none, None, &few);
    }
    for sigma in ABSORPTIONS {
        let hair = HairParameters { sigma_a: Vec3::new(sigma, 0.1 * sigma, 0.0), ..base() };
        add("absorption", format!("sigma_a {sigma}"), hair, none, None, &few);
    }
    let black = HairParameters { sigma_a: Vec3::splat(1e4), ..base() };
    add("absorption", "sigma_a 1e4, all channels".to_owned(), black, none, None, &few);
    for alpha in TILTS {
        let hair = HairParameters { alpha: alpha.to_radians(), beta_m: 0.1, ..base() };
        add("tilt", format!("alpha {alpha}°"), hair, none, None, &few);
    }
    for (tt, trt) in [(0.1, 8.0), (8.0, 0.1), (1.0, 1.0)] {
        let hair = HairParameters { roughness_scales: RoughnessScales { tt, trt }, ..base() };
        add("lobe scales", format!("TT {tt}, TRT {trt}"), hair, none, None, &few);
    }
    for layers in LAYERS {
        let hair = HairParameters { cuticle_layers: Some(layers), ..base() };
        add("cuticle", format!("{layers} layers"), hair, none, None, &few);
    }
    for roughness in FILM_ROUGHNESS {
        let film = Some(WaterFilm { roughness, ..WaterFilm::default() });
        add(
            "wet",
            format!("film of roughness {roughness}"),
            HairParameters { film, ..base() },
            none,
            None,
            &few,
        );
    }
    for aspect in ASPECTS {
        add("ellipse", format!("aspect {aspect}"), HairParameters { aspect, ..base() }, none, None, &few);
    }
    for nodes in NODES {
        let views = [VIEWS[0], VIEWS[1], VIEWS[5]].map(|(theta, _)| (theta, 0.0));
        add("far field", format!("{nodes} nodes"), base(), none, Some(nodes), &views);
    }
    for (kappa, sigma_s, g) in MEDULLAE {
        let medulla = Medulla { kappa, sigma_s, g, sigma_a: Vec3::new(0.05, 0.1, 0.2) };
        add("medulla", format!("kappa {kappa}, sigma_s {sigma_s}, g {g}"), base(), medulla, None, &few[..2]);
    }
    let clear = Medulla { kappa: 0.8, sigma_s: 0.0, sigma_a: Vec3::splat(0.1), g: 0.0 };
    add("medulla", "kappa 0.8, sigma_s 0".to_owned(), base(), clear, None, &few[..2]);
    cases
}

impl Case {
    /// Its name and view, in words.
    #[must_use]
    pub fn words(&self) -> String {
        format!("{}, {}", self.name, self.view.words())
    }
}
