//! Samples follow the density, the density integrates to 1, and both are what evaluation says.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::support::{Case, PLAIN, Random, WATER, deviate, edges, gauss, single, wrapped};
use fibre_scattering::{RoughnessScales, WaterFilm};

fn cases() -> Vec<Case> {
    let mut cases = Vec::new();
    for (beta_m, beta_n) in [(0.3, 0.3), (0.05, 0.6), (0.001, 0.001), (1.0, 1.0), (0.7, 0.02)] {
        for (h, theta_o, alpha) in [(0.3, 20.0, 2.0), (-0.9, -70.0, 10.0), (0.0, 89.9, -3.0), (1.0, 0.0, 2.0)]
        {
            cases.push(Case { beta_m, beta_n, h, theta_o, alpha, sigma_a: [0.1, 0.3, 1.0], ..PLAIN });
        }
    }
    cases.extend(beyond_chiang());
    cases
}

/// What Chiang's model does not have: other scales, layers, water, ellipses.
fn beyond_chiang() -> [Case; 8] {
    let base = Case { beta_m: 0.2, beta_n: 0.25, h: -0.4, sigma_a: [0.1, 0.3, 1.0], ..PLAIN };
    let scales = RoughnessScales { tt: 3.0, trt: 0.2 };
    [
        Case { scales, ..base },
        Case { layers: Some(2.45), ..base },
        Case { film: Some(WATER), ..base },
        Case { film: Some(WaterFilm { roughness: 0.01, ..WATER }), layers: Some(0.1), h: 0.99, ..base },
        Case { aspect: 0.3, phi_o: 40.0, ..base },
        Case { aspect: 0.3, phi_o: 95.0, h: 0.9, theta_o: -70.0, beta_n: 0.01, ..base },
        Case { aspect: 0.1, phi_o: -130.0, h: -0.8, film: Some(WATER), ..base },
        Case { aspect: 0.85, phi_o: 10.0, layers: Some(0.5), scales, film: Some(WATER), beta_n: 0.8, ..base },
    ]
}

/// Panels over the sphere that no lobe of the case can hide between.
fn panels(case: &Case) -> (Vec<f64>, Vec<f64>) {
    let (thetas, sigmas, phis, scales) = (case.thetas(), case.sigmas(), case.phis(), case.logistic_scales());
    let along: Vec<_> = (0..4).map(|p| (thetas[p], 0.7 * sigmas[p])).collect();
    let around: Vec<_> = (0..3)
        .flat_map(|p| [-2.0 * PI, 0.0, 2.0 * PI].map(|turn| (phis[p] + turn, scales[p])))
        .chain([-PI, 0.0, PI].map(|seam| (seam, 1.0)))
        .collect();
    (edges(-FRAC_PI_2, FRAC_PI_2, &along), edges(-PI, PI, &around))
}

/// The integral of the pdf over each cell of the panels, by the double precision path.
fn expected(case: &Case, along: &[f64], around: &[f64]) -> Vec<f64> {
    let scatter = case.double();
    let mut cells = Vec::new();
    for theta in along.windows(2) {
        for phi in around.windows(2) {
            cells.push(gauss(theta[0], theta[1], |t| {
                let pdf = |x| scatter.evaluate_with_pdf(case.seen(t, x)).1;
                t.cos() * gauss(phi[0], phi[1], pdf)
            }));
        }
    }
    cells
}

fn cell(edges: &[f64], x: f64) -> usize {
    edges.partition_point(|&edge| edge <= x).clamp(1, edges.len() - 1) - 1
}

#[test]
fn samples_follow_the_density_which_integrates_to_one() {
    const COUNT: usize = 100_000;
    for (number, case) in cases().into_iter().enumerate() {
        let (along, around) = panels(&case);
        let expected = expected(&case, &along, &around);
        let total: f64 = expected.iter().sum();
        assert!((total - 1.0).abs() < 1e-4, "pdf integrates to {total}: {case:?}");

        let scatter = case.single();
        let mut random = Random(1 + number as u64);
        let mut found = vec![0.0; expected.len()];
        let mut drawn = 0.0;
        for _ in 0..COUNT {
            let Some(sample) = scatter.sample(random.four()) else {
                continue;
            };
            let wi = sample.wi.as_dvec3();
            let theta = wi.x.atan2(wi.y.hypot(wi.z));
            let phi = wrapped(wi.z.atan2(wi.y) - case.phi_o.to_radians());
            found[cell(&along, theta) * (around.len() - 1) + cell(&around, phi)] += 1.0;
            drawn += 1.0;
        }
        assert!(drawn > 0.999 * COUNT as f64, "{drawn} drawn: {case:?}");

        let (mut chi_square, mut degrees) = (0.0, -1.0);
        let mut rest = (0.0, 0.0);
        for (&expected, &found) in expected.iter().zip(&found) {
            let expected = expected * drawn;
            if expected < 10.0 {
                rest = (rest.0 + expected, rest.1 + found);
            } else {
                chi_square += (found - expected).powi(2) / expected;
                degrees += 1.0;
            }
        }
        if rest.0 > 0.0 {
            let expected = rest.0.max(1.0);
            chi_square += (rest.1 - rest.0).powi(2) / expected;
            degrees += 1.0;
        }
        let deviate = deviate(chi_square, degrees);
        assert!(deviate < 4.5, "chi-square {chi_square:.0} of {degrees} ({deviate:.1} sigma): {case:?}");
    }
}

#[test]
fn a_sample_is_what_evaluation_says() {
    for (number, case) in cases().into_iter().enumerate() {
        let scatter = case.single();
        let mut random = Random(100 + number as u64);
        for _ in 0..2000 {
            let Some(sample) = scatter.sample(random.four()) else {
                continue;
            };
            assert!((sample.wi.length() - 1.0).abs() < 1e-6);
            assert_eq!((sample.values, sample.pdf), scatter.evaluate_with_pdf(sample.wi));
            assert_eq!(sample.pdf, scatter.pdf(sample.wi));
            assert_eq!(sample.values, scatter.evaluate(sample.wi));
            // The promise of choosing lobes by the least absorbed channel.
            assert!(sample.weight().max_element() <= 1.0 + 1e-5, "{:?}", sample);
        }
    }
}

#[test]
fn a_smooth_fibre_mirrors_light_where_geometry_says() {
    for (h, aspect, phi_o) in [-0.8, -0.2, 0.0, 0.5, 0.9_f64]
        .into_iter()
        .flat_map(|h| [(h, 1.0, 0.0), (h, 0.3, 35.0), (h, 0.6, 160.0), (h, 0.3, -90.0_f64)])
    {
        let smooth = Case { beta_m: 0.001, beta_n: 0.001, alpha: 0.0, ..PLAIN };
        let case = Case { h, theta_o: 35.0, aspect, phi_o, ..smooth };
        let wo = single(case.wo());
        // The side of positive h is that of -z where wo lies over +y: see the crate's page. On the ellipse
        // the line of sight at the offset h of the half-width meets the point whose eccentric angle is E.
        let phi_o = phi_o.to_radians();
        let eccentric = (phi_o.sin() / aspect).atan2(phi_o.cos()) - h.asin();
        let normal = single([0.0, eccentric.cos(), eccentric.sin() / aspect]).normalize();
        let mirrored = normal * (2.0 * wo.dot(normal)) - wo;
        let scatter = case.single();
        let at_mirror = scatter.evaluate(mirrored);
        let aside = scatter.evaluate(single(case.seen(-0.61, case.phis()[0] + 0.02)));
        assert!(at_mirror.0[0].x > 1e3 * aside.0[0].x.max(1.0), "{case:?}: {at_mirror:?}");
    }
}

/// Scales that open towards the tip have normals that lean to the root.
#[test]
fn tilt_turns_reflection_to_the_root_and_the_rest_to_the_tip() {
    let case = Case { beta_m: 0.02, h: 0.0, theta_o: 10.0, alpha: 2.0, ..PLAIN };
    let values = case.values_double();
    let phis = case.phis();
    for (p, lean) in [(0, -4.0), (1, 2.0), (2, 8.0), (3, 0.0_f64)] {
        let value = |degrees: f64| values(degrees.to_radians(), phis[p])[p];
        let peak = -10.0 + lean;
        assert!(value(peak) > value(peak + 0.5) && value(peak) > value(peak - 0.5), "lobe {p}");
    }
}
