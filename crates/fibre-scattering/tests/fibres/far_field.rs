//! The far field against the near field's mean over offsets: energy, error, sampling.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::support::{Case, PLAIN, Random, WATER, deviate, gauss, single};
use fibre_scattering::{
    Absorption, FarFieldBcsdf, FarFieldScatter, HairBcsdf, HairParameters, ScatteringError, WaterFilm,
};
use glam::Vec3;

fn far(case: &Case, nodes: u32) -> FarFieldScatter {
    let absorption = Absorption::of_cortex(case.parameters().sigma_a).unwrap();
    FarFieldBcsdf::new(&case.parameters(), nodes).unwrap().at(single(case.wo()), absorption)
}

/// The mean of the near field over so many offsets.
fn near(case: &Case, offsets: u32, azimuths: &[f64]) -> Vec<[f64; 4]> {
    let bcsdf = HairBcsdf::new(&case.parameters()).unwrap();
    let mut sums = vec![[0.0; 4]; azimuths.len()];
    for offset in 0..offsets {
        let h = (f64::from(offset) + 0.5) / f64::from(offsets) * 2.0 - 1.0;
        let scatter = bcsdf.at(single(case.wo()), h as f32);
        for (sum, &phi) in sums.iter_mut().zip(azimuths) {
            let values = scatter.evaluate(single(case.seen(-case.theta_o.to_radians(), phi)));
            for (sum, value) in sum.iter_mut().zip(values.0) {
                *sum += f64::from(value.x) / f64::from(offsets);
            }
        }
    }
    sums
}

fn turn(count: u32) -> Vec<f64> {
    (0..count).map(|step| (f64::from(step) + 0.5) / f64::from(count) * 2.0 * PI - PI).collect()
}

/// Root mean square of the difference over that of the value, around the fibre, of all lobes together.
fn error(case: &Case, nodes: u32, azimuths: &[f64], expected: &[[f64; 4]]) -> f64 {
    let scatter = far(case, nodes);
    let (mut difference, mut whole) = (0.0, 0.0);
    for (&phi, expected) in azimuths.iter().zip(expected) {
        let found = scatter.evaluate(single(case.seen(-case.theta_o.to_radians(), phi)));
        let (found, expected) = (f64::from(found.sum().x), expected.iter().sum::<f64>());
        difference += (found - expected).powi(2);
        whole += expected * expected;
    }
    (difference / whole).sqrt()
}

#[test]
fn the_error_against_the_near_field_falls_with_the_nodes() {
    // Smoother fibres would need more than 4,096 offsets for a mean to compare with.
    let cases = [
        (Case { beta_n: 0.05, ..PLAIN }, [0.2, 0.06, 0.02, 0.01]),
        (Case { beta_n: 0.1, theta_o: -65.0, ..PLAIN }, [0.15, 0.06, 0.02, 0.01]),
        (Case { beta_n: 0.3, ..PLAIN }, [0.2, 0.03, 0.01, 0.002]),
        (Case { beta_n: 0.6, ..PLAIN }, [0.1, 0.02, 0.005, 0.001]),
        (Case { beta_n: 1.0, ..PLAIN }, [0.01, 0.005, 0.001, 0.0005]),
        (Case { beta_n: 0.3, eta: 1.1, ..PLAIN }, [0.2, 0.05, 0.01, 0.002]),
        (Case { beta_n: 0.3, film: Some(WATER), ..PLAIN }, [0.2, 0.04, 0.02, 0.01]),
        (Case { beta_n: 0.3, aspect: 0.6, phi_o: 35.0, ..PLAIN }, [0.3, 0.2, 0.08, 0.03]),
    ];
    let azimuths = turn(180);
    let mut missed = false;
    for (case, bounds) in cases {
        let case = Case { sigma_a: [0.2; 3], ..case };
        let expected = near(&case, 4096, &azimuths);
        let errors = [4, 8, 16, 32].map(|nodes| error(&case, nodes, &azimuths, &expected));
        let Case { beta_n, eta, theta_o, film, aspect, .. } = case;
        println!(
            "beta_n {beta_n} eta {eta} theta {theta_o} wet {} aspect {aspect}: 4, 8, 16, 32 nodes {errors:.4?}",
            film.is_some()
        );
        missed |= errors.into_iter().zip(bounds).any(|(error, bound)| error >= bound);
    }
    assert!(!missed);
}

/// All light comes back, for every number of nodes: over the sphere, and not by the weights alone.
#[test]
fn a_white_fibre_returns_all_light() {
    let film = |roughness| Some(WaterFilm { roughness, ..WATER });
    let bodies = [
        PLAIN,
        Case { eta: 1.0001, ..PLAIN },
        Case { eta: 3.0, layers: Some(2.45), theta_o: 89.99, ..PLAIN },
        Case { film: film(0.02), theta_o: -70.0, ..PLAIN },
        Case { aspect: 0.3, phi_o: 50.0, ..PLAIN },
        Case { aspect: 0.3, phi_o: 95.0, eta: 3.0, theta_o: 60.0, ..PLAIN },
    ];
    let mut worst = (0.0, PLAIN, 0);
    for body in bodies {
        for (beta_m, beta_n) in [(0.001, 0.001), (0.3, 0.3), (0.1, 0.9), (1.0, 1.0)] {
            for nodes in [1, 6, 64] {
                let case = Case { beta_m, beta_n, ..body };
                let scatter = far(&case, nodes);
                let sum: Vec3 = scatter.albedo().into_iter().sum();
                assert!((sum - 1.0).abs().max_element() < 2e-6, "{sum} {nodes} {case:?}");
                let values = |theta: f64, phi: f64| {
                    let values = scatter.evaluate(single(case.seen(theta, phi)));
                    [0, 1, 2, 3].map(|p: usize| f64::from(values.0[p].x))
                };
                // Each lobe is a product: once around through the middle along, once along somewhere around.
                let azimuths = turn(match (beta_n < 0.01, case.eta < 1.01 || case.aspect < 1.0) {
                    (true, true) => 40_000,
                    (true, false) => 24_000,
                    _ => 1_000,
                });
                let (thetas, sigmas) = (case.thetas(), case.sigmas());
                let mut total = 0.0;
                for p in 0..4 {
                    let around: Vec<f64> = azimuths.iter().map(|&phi| values(thetas[p], phi)[p]).collect();
                    let (at, peak) = azimuths
                        .iter()
                        .zip(&around)
                        .fold((0.0, 0.0), |best, (&phi, &v)| if v > best.1 { (phi, v) } else { best });
                    if peak == 0.0 {
                        continue;
                    }
                    let around = around.iter().sum::<f64>() * 2.0 * PI / azimuths.len() as f64;
                    let edges = crate::support::edges(-FRAC_PI_2, FRAC_PI_2, &[(thetas[p], sigmas[p])]);
                    let parts = if beta_m < 0.005 { 6 } else { 1 };
                    let along = crate::support::integral(&edges, parts, |t| values(t, at)[p] * t.cos());
                    total += along * around / peak;
                }
                let error = (total - 1.0).abs();
                if error > worst.0 {
                    worst = (error, case, nodes);
                }
            }
        }
    }
    println!(
        "white furnace of the far field: worst error {:.2e} at {:?}, {} nodes",
        worst.0, worst.1, worst.2
    );
    assert!(worst.0 < 1e-4, "{worst:?}");
}

/// The far field's albedo is the near field's mean.
#[test]
fn its_albedo_is_the_mean_albedo() {
    let case = Case { sigma_a: [0.05, 0.3, 2.0], ..PLAIN };
    let bcsdf = HairBcsdf::new(&case.parameters()).unwrap();
    let mut mean = Vec3::ZERO;
    for offset in 0..4096 {
        let h = (offset as f32 + 0.5) / 2048.0 - 1.0;
        mean += bcsdf.at(single(case.wo()), h).albedo().into_iter().sum::<Vec3>() / 4096.0;
    }
    for (nodes, near) in [(4, 0.05), (16, 3e-3), (64, 2e-4)] {
        let found: Vec3 = far(&case, nodes).albedo().into_iter().sum();
        println!("{nodes} nodes: albedo {found} for {mean}");
        assert!((found - mean).abs().max_element() < near, "{nodes}: {found} {mean}");
    }
}

fn sampled() -> [(Case, u32); 8] {
    let base = Case { sigma_a: [0.1, 0.3, 1.0], ..PLAIN };
    [
        (base, 16),
        (Case { beta_m: 0.15, beta_n: 0.06, theta_o: -60.0, ..base }, 7),
        (Case { beta_n: 0.9, ..base }, 64),
        (Case { beta_m: 0.7, beta_n: 0.7, ..base }, 1),
        (Case { beta_n: 0.5, eta: 1.05, ..base }, 2),
        (Case { film: Some(WATER), ..base }, 16),
        (Case { aspect: 0.4, phi_o: 70.0, ..base }, 12),
        (Case { beta_m: 1.0, beta_n: 1.0, theta_o: 89.0, ..base }, 3),
    ]
}

#[test]
fn samples_follow_the_density_and_are_what_evaluation_says() {
    const COUNT: u32 = 100_000;
    const ALONG: usize = 30;
    const AROUND: usize = 48;
    for (number, (case, nodes)) in sampled().into_iter().enumerate() {
        let scatter = far(&case, nodes);
        let step = (PI / ALONG as f64, 2.0 * PI / AROUND as f64);
        let mut expected = vec![0.0; ALONG * AROUND];
        for (index, cell) in expected.iter_mut().enumerate() {
            let (theta, phi) =
                ((index / AROUND) as f64 * step.0 - FRAC_PI_2, (index % AROUND) as f64 * step.1 - PI);
            for (part_theta, part_phi) in
                (0..2).flat_map(|i| (0..2).map(move |j| (f64::from(i), f64::from(j))))
            {
                let (low, left) = (theta + part_theta * step.0 / 2.0, phi + part_phi * step.1 / 2.0);
                *cell += gauss(low, low + step.0 / 2.0, |t| {
                    t.cos()
                        * gauss(left, left + step.1 / 2.0, |x| {
                            f64::from(scatter.pdf(single(crate::support::direction(t, x))))
                        })
                });
            }
        }
        let total: f64 = expected.iter().sum();
        assert!((total - 1.0).abs() < 1e-4, "pdf integrates to {total}: {nodes} {case:?}");

        let mut random = Random(7 + number as u64);
        let (mut found, mut drawn) = (vec![0.0; ALONG * AROUND], 0.0);
        for draw in 0..COUNT {
            let Some(sample) = scatter.sample(random.four()) else { continue };
            drawn += 1.0;
            let wi = sample.wi.as_dvec3();
            assert!((wi.length() - 1.0).abs() < 1e-6);
            if draw % 50 == 0 {
                assert_eq!((sample.values, sample.pdf), scatter.evaluate_with_pdf(sample.wi));
                assert_eq!(
                    (sample.values, sample.pdf),
                    (scatter.evaluate(sample.wi), scatter.pdf(sample.wi))
                );
                assert!(sample.weight().max_element() <= 1.0 + 1e-5, "{sample:?}");
            }
            let along = ((wi.x.atan2(wi.y.hypot(wi.z)) + FRAC_PI_2) / step.0) as usize;
            let around = ((wi.z.atan2(wi.y) + PI) / step.1) as usize;
            found[along.min(ALONG - 1) * AROUND + around.min(AROUND - 1)] += 1.0;
        }
        assert!(drawn > 0.999 * f64::from(COUNT));
        let (mut chi_square, mut degrees, mut rest) = (0.0, -1.0, (0.0, 0.0));
        for (&expected, &found) in expected.iter().zip(&found) {
            let expected = expected * drawn;
            if expected < 10.0 {
                rest = (rest.0 + expected, rest.1 + found);
            } else {
                chi_square += (found - expected).powi(2) / expected;
                degrees += 1.0;
            }
        }
        chi_square += (rest.1 - rest.0).powi(2) / rest.0.max(1.0);
        let deviate = deviate(chi_square, degrees + 1.0);
        println!("{nodes} nodes, case {number}: chi-square {chi_square:.0} of {degrees}, {deviate:.1} sigma");
        assert!(deviate < 4.5, "chi-square {chi_square:.0} of {degrees}: {nodes} {case:?}");
    }
}

#[test]
fn nodes_outside_their_bounds_are_refused() {
    for nodes in [0, 65, u32::MAX] {
        let refused = FarFieldBcsdf::new(&HairParameters::default(), nodes).unwrap_err();
        let (name, range) = ("nodes", "1..=64");
        assert_eq!(refused, ScatteringError::OutOfRange { name, found: nodes as f32, range });
    }
    let bad = HairParameters { beta_m: 0.0, ..HairParameters::default() };
    assert!(FarFieldBcsdf::new(&bad, 8).is_err());
    let none = HairParameters { lobe_weights: [0.0; 5], ..HairParameters::default() };
    let scatter = FarFieldBcsdf::new(&none, 8).unwrap().at(Vec3::Y, Absorption::default());
    assert_eq!(scatter.sample([0.5; 4]), None);
    assert_eq!(scatter.pdf(Vec3::Z), 0.0);
}
