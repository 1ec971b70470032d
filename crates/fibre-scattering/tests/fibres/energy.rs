//! A fibre without absorption returns all light, whatever its shape and from wherever it is lit.

use crate::support::{Case, PLAIN, Random, WATER, scattered};
use fibre_scattering::{HairBcsdf, HairParameters, RoughnessScales, WaterFilm};

const ROUGHNESS: [(f64, f64); 9] = [
    (0.001, 0.001),
    (0.01, 0.01),
    (0.1, 0.1),
    (0.3, 0.3),
    (0.6, 0.6),
    (0.85, 0.85),
    (1.0, 1.0),
    (0.001, 1.0),
    (1.0, 0.001),
];
const OFFSETS: [f64; 7] = [0.0, 0.3, -0.7, 0.95, -0.9999, 1.0, -1.0];
const INCLINATIONS: [f64; 8] = [0.0, 30.0, -60.0, 85.0, 89.9, -89.99, 89.99, 90.0];
const TILTS: [f64; 5] = [0.0, 2.0, -3.0, 20.0, 60.0];
const INDICES: [f64; 4] = [1.0001, 1.33, 1.55, 3.0];

fn extremes() -> impl Iterator<Item = Case> {
    let shapes = ROUGHNESS.into_iter().flat_map(|(beta_m, beta_n)| {
        TILTS.into_iter().flat_map(move |alpha| {
            INDICES.into_iter().map(move |eta| Case { beta_m, beta_n, alpha, eta, ..PLAIN })
        })
    });
    shapes.flat_map(|shape| {
        OFFSETS
            .into_iter()
            .flat_map(move |h| INCLINATIONS.into_iter().map(move |theta_o| Case { h, theta_o, ..shape }))
    })
}

/// What Chiang's model does not have, one by one and together, over the shapes and the directions.
fn extremes_beyond_chiang() -> impl Iterator<Item = Case> {
    let scales = |tt, trt| RoughnessScales { tt, trt };
    let film = |eta, roughness| Some(WaterFilm { eta, roughness });
    let bodies = [
        Case { scales: scales(0.1, 8.0), ..PLAIN },
        Case { scales: scales(8.0, 0.1), ..PLAIN },
        Case { layers: Some(0.01), ..PLAIN },
        Case { layers: Some(2.45), ..PLAIN },
        Case { layers: Some(100.0), ..PLAIN },
        Case { film: Some(WATER), ..PLAIN },
        Case { film: film(1.0001, 0.001), eta: 3.0, ..PLAIN },
        Case { film: film(3.0, 1.0), eta: 1.0001, layers: Some(0.5), ..PLAIN },
        Case { aspect: 0.1, phi_o: 0.0, ..PLAIN },
        Case { aspect: 0.3, phi_o: 90.0, ..PLAIN },
        Case { aspect: 0.3, phi_o: 50.0, eta: 3.0, ..PLAIN },
        Case { aspect: 0.3, phi_o: -20.0, eta: 1.0001, ..PLAIN },
        Case { aspect: 0.85, phi_o: 130.0, film: Some(WATER), layers: Some(2.45), ..PLAIN },
        Case { aspect: 0.999_999, phi_o: 10.0, ..PLAIN },
    ];
    let shapes = bodies
        .into_iter()
        .flat_map(|body| ROUGHNESS.into_iter().map(move |(beta_m, beta_n)| Case { beta_m, beta_n, ..body }));
    shapes.flat_map(|shape| {
        OFFSETS
            .into_iter()
            .flat_map(move |h| INCLINATIONS.into_iter().map(move |theta_o| Case { h, theta_o, ..shape }))
    })
}

/// Directions rounded to `f32` scatter about the smoothest lobes by a thousandth of their value:
/// noise that the quadrature averages, with more nodes where the lobes are that narrow.
fn scattered_single(case: &Case) -> [f64; 4] {
    let narrow = case.beta_m.min(case.beta_n) < 0.005;
    scattered(case, if narrow { 6 } else { 1 }, case.values_single())
}

/// The worst error of a table of cases.
fn worst_of(cases: impl Iterator<Item = Case>, total: impl Fn(&Case) -> f64) -> (f64, Case) {
    let mut worst = (0.0, PLAIN);
    for case in cases {
        let error = (total(&case) - 1.0).abs();
        assert!(error.is_finite(), "{case:?}");
        if error > worst.0 {
            worst = (error, case);
        }
    }
    worst
}

#[test]
fn a_white_fibre_returns_all_light_in_single_precision() {
    for (name, cases) in [
        ("Chiang's", Box::new(extremes()) as Box<dyn Iterator<Item = Case>>),
        ("beyond Chiang's", Box::new(extremes_beyond_chiang().step_by(3))),
    ] {
        let worst = worst_of(cases, |case| scattered_single(case).iter().sum());
        println!("white furnace, f32, {name}: worst error {:.2e} at {:?}", worst.0, worst.1);
        assert!(worst.0 < 1e-4, "{worst:?}");
    }
}

#[test]
fn a_white_fibre_returns_all_light_in_double_precision() {
    let cases = extremes().step_by(7).chain(extremes_beyond_chiang().step_by(11));
    let worst = worst_of(cases, |case| scattered(case, 1, case.values_double()).iter().sum());
    println!("white furnace, f64: worst error {:.2e} at {:?}", worst.0, worst.1);
    assert!(worst.0 < 1e-5, "{worst:?}");
}

#[test]
fn every_lobe_scatters_its_attenuation() {
    for case in extremes().step_by(11).chain(extremes_beyond_chiang().step_by(23)) {
        let case = Case { sigma_a: [0.4; 3], ..case };
        let albedo = case.single().albedo();
        let found = scattered_single(&case);
        for p in 0..4 {
            let expected = f64::from(albedo[p].x);
            assert!(
                (found[p] - expected).abs() < 1e-4 * expected.max(1e-6),
                "lobe {p}: {} for {expected} at {case:?}",
                found[p]
            );
        }
    }
}

#[test]
fn attenuations_sum_to_one_without_absorption_and_to_less_with_it() {
    for case in extremes().chain(extremes_beyond_chiang()) {
        let sum: f32 = case.single().albedo().iter().map(|a| a.x).sum();
        assert!((sum - 1.0).abs() < 1e-6, "{sum} at {case:?}");
        let dark = Case { sigma_a: [1e-3, 1.0, 1e4], ..case };
        let albedo = dark.single().albedo();
        for lobe in albedo {
            assert!(lobe.is_finite() && lobe.min_element() >= 0.0);
            assert!(lobe.x >= lobe.y && lobe.y >= lobe.z, "{lobe} at {case:?}");
        }
        assert!(albedo.iter().map(|a| a.x).sum::<f32>() <= 1.0 + 1e-6);
    }
}

/// The furnace as a renderer meets it: by sampling. White gives 1 sample for sample; with
/// absorption the mean is the albedo.
#[test]
fn the_mean_weight_of_samples_is_the_albedo() {
    for (number, case) in extremes().chain(extremes_beyond_chiang()).step_by(97).enumerate() {
        let mut random = Random(number as u64);
        let white = case.single();
        for _ in 0..50 {
            if let Some(sample) = white.sample(random.four()) {
                let weight = sample.weight();
                assert!((weight - 1.0).abs().max_element() < 1e-5, "{weight} {case:?}");
            }
        }
        let dark = Case { sigma_a: [0.05, 0.5, 2.0], ..case };
        let scatter = dark.single();
        let albedo: glam::Vec3 = scatter.albedo().into_iter().sum();
        let mut mean = glam::DVec3::ZERO;
        const COUNT: u32 = 4000;
        for index in 0..COUNT {
            let mut u = random.four();
            // One stratum per sample for the choice of the lobe, which decides most of the weight.
            u[0] = ((f64::from(index) + f64::from(u[0])) / f64::from(COUNT)) as f32;
            if let Some(sample) = scatter.sample(u) {
                mean += sample.weight().as_dvec3() / f64::from(COUNT);
            }
        }
        let error = (mean - albedo.as_dvec3()).abs().max_element();
        assert!(error < 5e-3, "{error}: {mean} for {albedo} at {dark:?}");
    }
}

#[test]
fn lobe_weights_multiply_their_lobe_alone() {
    let parameters = PLAIN.parameters();
    let wo = crate::support::single(PLAIN.wo());
    let wi = crate::support::single(crate::support::direction(-0.3, 2.0));
    let plain = HairBcsdf::new(&parameters).unwrap().at(wo, 0.3).evaluate(wi);
    let weighted = HairParameters { lobe_weights: [0.5, 0.0, 2.0, 1.0, 1.0], ..parameters };
    let scatter = HairBcsdf::new(&weighted).unwrap().at(wo, 0.3);
    let found = scatter.evaluate(wi);
    for (p, weight) in weighted.lobe_weights.into_iter().enumerate() {
        assert_eq!(found.0[p], plain.0[p] * weight);
    }
    let mut random = Random(1);
    for _ in 0..1000 {
        let sample = scatter.sample(random.four()).unwrap();
        assert_ne!(sample.lobe, fibre_scattering::Lobe::Tt);
    }
    let none = HairParameters { lobe_weights: [0.0; 5], ..parameters };
    let scatter = HairBcsdf::new(&none).unwrap().at(wo, 0.3);
    assert_eq!(scatter.sample([0.5; 4]), None);
    assert_eq!(scatter.pdf(wi), 0.0);
}
