//! Laws that hold for every fibre: no NaN, symmetry, monotony, bounds that are kept.

use crate::support::WATER;

use fibre_scattering::{
    Absorption, FarFieldBcsdf, HairBcsdf, HairParameters, ReferenceBcsdf, RoughnessScales, ScatteringError,
    WaterFilm, absorption_from_color, absorption_from_melanin, absorption_from_pigments,
    color_from_absorption,
};
use glam::Vec3;
use proptest::prelude::*;

/// Values from all over a range, and its ends.
fn spanning(low: f32, high: f32) -> impl Strategy<Value = f32> {
    prop_oneof![6 => low..=high, 1 => Just(low), 1 => Just(high)]
}

fn roughness() -> impl Strategy<Value = f32> {
    prop_oneof![3 => 1e-3_f32..=1.0, 3 => (-3.0_f32..=0.0).prop_map(|e| 10.0_f32.powf(e).max(1e-3)), 1 => Just(1.0_f32)]
}

fn absorption() -> impl Strategy<Value = f32> {
    prop_oneof![2 => Just(0.0_f32), 4 => (-4.0_f32..=4.0).prop_map(|e| 10.0_f32.powf(e))]
}

/// Every parameter over its whole range, and what most hair leaves out left out as often as not.
fn parameters() -> impl Strategy<Value = HairParameters> {
    let chiang = (
        roughness(),
        roughness(),
        spanning(-1.57, 1.57),
        spanning(1.0001, 3.0),
        [absorption(), absorption(), absorption()],
    );
    let scales = prop_oneof![
        1 => Just(RoughnessScales::default()),
        1 => (spanning(0.1, 8.0), spanning(0.1, 8.0)).prop_map(|(tt, trt)| RoughnessScales { tt, trt }),
    ];
    let layers = prop::option::of((-2.0_f32..=2.0).prop_map(|e| 10.0_f32.powf(e).clamp(0.01, 100.0)));
    let film = prop::option::of(
        (spanning(1.0001, 3.0), roughness()).prop_map(|(eta, roughness)| WaterFilm { eta, roughness }),
    );
    let aspect = prop_oneof![2 => Just(1.0_f32), 1 => spanning(0.1, 1.0)];
    (chiang, scales, layers, film, aspect).prop_map(
        |((beta_m, beta_n, alpha, eta, sigma_a), roughness_scales, cuticle_layers, film, aspect)| {
            HairParameters {
                beta_m,
                beta_n,
                alpha,
                eta,
                sigma_a: sigma_a.into(),
                lobe_weights: [1.0; 5],
                roughness_scales,
                cuticle_layers,
                film,
                aspect,
            }
        },
    )
}

fn unit() -> impl Strategy<Value = Vec3> {
    let grazing = (1e-9_f32..1e-2, -4.0_f32..4.0, any::<bool>()).prop_map(|(cos, phi, side)| {
        let sin = (1.0 - cos * cos).sqrt();
        Vec3::new(if side { sin } else { -sin }, cos * phi.cos(), cos * phi.sin())
    });
    let any = (-1.0_f32..=1.0, -4.0_f32..4.0).prop_map(|(sin, phi)| {
        let cos = (1.0 - sin * sin).sqrt();
        Vec3::new(sin, cos * phi.cos(), cos * phi.sin())
    });
    prop_oneof![
        6 => any,
        2 => grazing,
        1 => prop::sample::select(vec![Vec3::X, Vec3::NEG_X, Vec3::Y, Vec3::NEG_Y, Vec3::Z, Vec3::NEG_Z]),
    ]
}

fn uniforms() -> impl Strategy<Value = [f32; 4]> {
    let last = 1.0 - f32::EPSILON / 2.0;
    let one = || prop_oneof![6 => 0.0_f32..1.0, 1 => Just(0.0_f32), 1 => Just(last)];
    [one(), one(), one(), one()]
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(20_000) })]

    #[test]
    fn nothing_is_ever_nan(
        parameters in parameters(), wo in unit(), wi in unit(),
        h in spanning(-1.0, 1.0), u in uniforms(),
    ) {
        let scatter = HairBcsdf::new(&parameters).unwrap().at(wo, h);
        let (values, pdf) = scatter.evaluate_with_pdf(wi);
        prop_assert!(pdf.is_finite() && pdf >= 0.0);
        for value in values.0 {
            prop_assert!(value.is_finite() && value.min_element() >= 0.0);
        }
        let albedo: Vec3 = scatter.albedo().into_iter().sum();
        prop_assert!(albedo.min_element() >= 0.0 && albedo.max_element() <= 1.0 + 1e-6);
        if let Some(sample) = scatter.sample(u) {
            prop_assert!((sample.wi.length() - 1.0).abs() < 1e-6);
            prop_assert!(sample.pdf > 0.0 && sample.pdf.is_finite());
            prop_assert!(sample.weight().is_finite());
            prop_assert!(sample.weight().max_element() <= 1.0 + 1e-5);
            prop_assert_eq!((sample.values, sample.pdf), scatter.evaluate_with_pdf(sample.wi));
        }
    }

    #[test]
    fn nothing_is_ever_nan_in_double_precision(
        parameters in parameters(), wo in unit(), wi in unit(), h in spanning(-1.0, 1.0), u in uniforms(),
    ) {
        let wo = wo.as_dvec3().normalize().to_array();
        let scatter = ReferenceBcsdf::new(&parameters).unwrap().at(wo, f64::from(h));
        let (values, pdf) = scatter.evaluate_with_pdf(wi.as_dvec3().normalize().to_array());
        prop_assert!(pdf.is_finite() && pdf >= 0.0);
        prop_assert!(values.as_flattened().iter().all(|value| value.is_finite() && *value >= 0.0));
        if let Some(wi) = scatter.sample_direction(u.map(f64::from)) {
            prop_assert!((glam::DVec3::from_array(wi).length() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn double_precision_says_the_same(
        parameters in parameters(), wo in unit(), wi in unit(), h in -0.99_f32..=0.99,
    ) {
        // Along the fibre there is no azimuth to agree on.
        if wo.x.abs() > 0.9999 || wi.x.abs() > 0.9999 {
            return Ok(());
        }
        // Where lobes are so wide that the rounding of a direction is nothing beside them.
        let rough = |beta: f32| beta.max(0.2);
        let film = parameters.film.map(|film| WaterFilm { roughness: rough(film.roughness), ..film });
        let (beta_m, beta_n) = (rough(parameters.beta_m), rough(parameters.beta_n));
        let roughness_scales = RoughnessScales::default();
        let parameters = HairParameters { beta_m, beta_n, film, roughness_scales, ..parameters };
        let single = HairBcsdf::new(&parameters).unwrap().at(wo, h);
        let (wo, wi_double) = (wo.as_dvec3().normalize(), wi.as_dvec3().normalize().to_array());
        let double = ReferenceBcsdf::new(&parameters).unwrap().at(wo.to_array(), f64::from(h));
        let (values, exact) = (single.evaluate(wi), double.evaluate_with_pdf(wi_double).0);
        let albedo = double.albedo();
        for p in 0..4 {
            let (found, exact) = (f64::from(values.0[p].x), exact[p][0]);
            // What carries next to nothing is as good as the light that is left of it.
            let carried = albedo[p][0].max(1e-3);
            prop_assert!((found - exact).abs() <= 2e-3 * exact.max(carried), "lobe {p}: {found} {exact}");
        }
    }

    #[test]
    fn the_far_field_is_never_nan_and_samples_what_it_evaluates(
        parameters in parameters(), wo in unit(), wi in unit(), u in uniforms(), nodes in 1_u32..=12,
    ) {
        let absorption = Absorption::of_cortex(parameters.sigma_a).unwrap();
        let scatter = FarFieldBcsdf::new(&parameters, nodes).unwrap().at(wo, absorption);
        let (values, pdf) = scatter.evaluate_with_pdf(wi);
        prop_assert!(pdf.is_finite() && pdf >= 0.0);
        for value in values.0 {
            prop_assert!(value.is_finite() && value.min_element() >= 0.0);
        }
        let albedo: Vec3 = scatter.albedo().into_iter().sum();
        prop_assert!(albedo.min_element() >= 0.0 && albedo.max_element() <= 1.0 + 2e-6);
        if let Some(sample) = scatter.sample(u) {
            prop_assert!((sample.wi.length() - 1.0).abs() < 1e-6);
            prop_assert!(sample.weight().is_finite() && sample.weight().max_element() <= 1.0 + 1e-5);
            prop_assert_eq!((sample.values, sample.pdf), scatter.evaluate_with_pdf(sample.wi));
        }
    }

    #[test]
    fn mirroring_offset_and_azimuth_together_changes_nothing(
        parameters in parameters(), wo in unit(), wi in unit(), h in spanning(-1.0, 1.0),
    ) {
        let bcsdf = HairBcsdf::new(&parameters).unwrap();
        let flip = Vec3::new(1.0, 1.0, -1.0);
        let here = bcsdf.at(wo, h).evaluate_with_pdf(wi);
        let there = bcsdf.at(wo * flip, -h).evaluate_with_pdf(wi * flip);
        // Azimuths are rounded differently on the seam at +-pi: a few ulps times 1/s.
        let near = |a: f32, b: f32| (a - b).abs() <= 0.02 * a.max(b) + 1e-12;
        for (a, b) in here.0.0.into_iter().zip(there.0.0) {
            prop_assert!(near(a.x, b.x) && near(a.y, b.y) && near(a.z, b.z), "{a} {b}");
        }
        prop_assert!(near(here.1, there.1));
    }

    #[test]
    fn turning_the_fibre_end_for_end_turns_the_tilt(
        parameters in parameters(), wo in unit(), wi in unit(), h in spanning(-1.0, 1.0),
    ) {
        let turned = HairParameters { alpha: -parameters.alpha, ..parameters };
        let flip = Vec3::new(-1.0, 1.0, 1.0);
        let here = HairBcsdf::new(&parameters).unwrap().at(wo, h).evaluate(wi);
        let there = HairBcsdf::new(&turned).unwrap().at(wo * flip, h).evaluate(wi * flip);
        prop_assert_eq!(here, there);
    }
}

/// Which way the scales of real hair turn each lobe: R nearer to the root, TT and TRT to the tip.
#[test]
fn a_positive_tilt_turns_r_to_the_root_and_the_others_to_the_tip() {
    let (theta_o, alpha) = (0.35_f64, 3.0_f32.to_radians());
    let parameters = HairParameters { beta_m: 0.03, beta_n: 0.9, alpha, ..HairParameters::default() };
    let scatter = HairBcsdf::new(&parameters)
        .unwrap()
        .at(crate::support::single(crate::support::direction(theta_o, 0.0)), 0.2);
    for (lobe, turn) in [(0, -2.0), (1, 1.0), (2, 4.0)] {
        // An azimuth that every lobe reaches: only the inclination of the peak is asked for.
        let value = |theta: f64| {
            scatter.evaluate(crate::support::single(crate::support::direction(theta, 2.0))).0[lobe].x
        };
        let places = (-1500..1500).map(|i| f64::from(i) * 1e-3);
        let peak = places.max_by(|&a, &b| value(a).total_cmp(&value(b))).unwrap();
        let expected = -theta_o + turn * f64::from(alpha);
        assert!((peak - expected).abs() < 5e-3, "lobe {lobe}: {peak}, not {expected}");
    }
}

/// At one offset the model is not reciprocal: its attenuations see `wo` and not `wi`. Averaged over
/// offsets, without tilt, it is where both inclinations have the same size.
#[test]
fn averaged_over_offsets_equal_inclinations_are_reciprocal() {
    let bcsdf = HairBcsdf::new(&HairParameters {
        alpha: 0.0,
        sigma_a: Vec3::new(0.1, 0.5, 2.0),
        ..HairParameters::default()
    })
    .unwrap();
    let a = crate::support::single(crate::support::direction(0.5, 0.0));
    let b = crate::support::single(crate::support::direction(-0.5, 1.3));
    let average = |wo: Vec3, wi: Vec3| {
        let count = 400;
        let offset = |i| (i as f32 + 0.5) / count as f32 * 2.0 - 1.0;
        let sum: Vec3 = (0..count).map(|i| bcsdf.at(wo, offset(i)).evaluate(wi).sum()).sum();
        sum / count as f32
    };
    let (there, back) = (average(a, b), average(b, a));
    assert!((there - back).abs().max_element() < 1e-4 * there.max_element(), "{there} {back}");
}

/// Per offset: what is scattered, what of it in R, and how far forward it goes on the mean (1 straight on).
fn seen_by_eye(parameters: &HairParameters) -> (f64, f64, f64) {
    let bcsdf = HairBcsdf::new(parameters).unwrap();
    let wo = crate::support::single(crate::support::direction(0.3, 0.0));
    let (mut all, mut first, mut forward) = (0.0, 0.0, 0.0);
    let count = 64;
    for node in 0..count {
        let scatter = bcsdf.at(wo, (node as f32 + 0.5) / count as f32 * 2.0 - 1.0);
        let albedo: Vec3 = scatter.albedo().into_iter().sum();
        all += f64::from(albedo.y) / f64::from(count);
        first += f64::from(scatter.albedo()[0].y) / f64::from(count);
        // Azimuths of the lobes' middles: TT goes on, R and TRT come back, the residual goes anywhere.
        for (lobe, share) in scatter.albedo().into_iter().enumerate().take(3) {
            let h = f64::from((node as f32 + 0.5) / count as f32 * 2.0 - 1.0);
            let phi = crate::support::Case { h, theta_o: 0.3_f64.to_degrees(), ..crate::support::PLAIN }
                .phis()[lobe];
            forward -= phi.cos() * f64::from(share.y) / f64::from(count);
        }
    }
    (all, first, forward / all)
}

/// Wet hair, as everybody knows it: darker, for light goes forward and through pigment instead of back; and
/// shinier, for what the smooth water reflects is gathered in a peak.
#[test]
fn wet_hair_is_darker_and_shinier() {
    let dry = HairParameters { sigma_a: Vec3::new(0.1, 0.3, 0.8), ..HairParameters::default() };
    let wet = HairParameters { film: Some(WATER), ..dry };
    let ((all_dry, r_dry, on_dry), (all_wet, r_wet, on_wet)) = (seen_by_eye(&dry), seen_by_eye(&wet));
    println!(
        "albedo {all_dry:.4} -> {all_wet:.4}, R {r_dry:.4} -> {r_wet:.4}, forward {on_dry:.4} -> {on_wet:.4}"
    );
    assert!(all_wet < 0.995 * all_dry && r_wet < 0.8 * r_dry && on_wet > on_dry + 0.05);

    let peak = |parameters: &HairParameters| {
        let wo = crate::support::single(crate::support::direction(0.3, 0.0));
        let scatter = HairBcsdf::new(parameters).unwrap().at(wo, 0.0);
        let at = |theta: i32| crate::support::single(crate::support::direction(f64::from(theta) * 1e-3, 0.0));
        (-1500..1500).map(|theta| scatter.evaluate(at(theta)).0[0].y).fold(0.0, f32::max)
    };
    println!("peak of R {:.3} -> {:.3}", peak(&dry), peak(&wet));
    assert!(peak(&wet) > 4.0 * peak(&dry));

    // Without pigment nothing is darker: all light comes back either way.
    let white = HairParameters { film: Some(WATER), ..HairParameters::default() };
    assert!((seen_by_eye(&white).0 - 1.0).abs() < 1e-6);
}

/// Layers reflect more the more there are; half a layer of 2017 is nearly Fresnel's surface.
#[test]
fn cuticle_layers_brighten_r() {
    let r = |cuticle_layers| seen_by_eye(&HairParameters { cuticle_layers, ..HairParameters::default() }).1;
    let (bare, half) = (r(None), r(Some(0.5)));
    assert!((half / bare - 1.0).abs() < 0.05, "{half} {bare}");
    assert!(r(Some(0.1)) < half && half < r(Some(1.0)) && r(Some(1.0)) < r(Some(2.45)));
}

#[test]
fn an_ellipse_that_is_nearly_round_is_nearly_the_round_fibre() {
    let round = HairParameters { sigma_a: Vec3::new(0.1, 0.5, 2.0), ..HairParameters::default() };
    let worst = |aspect: f32| {
        let (round, ellipse) =
            (HairBcsdf::new(&round).unwrap(), HairBcsdf::new(&HairParameters { aspect, ..round }).unwrap());
        let mut worst = 0.0_f32;
        for step in 0..400 {
            let along = f64::from(step % 20) * 0.07 - 0.7;
            let wo = crate::support::single(crate::support::direction(
                0.7 - 0.003 * f64::from(step),
                f64::from(step),
            ));
            let wi = crate::support::single(crate::support::direction(along, f64::from(step) * 1.7));
            let h = 0.95 - 0.00475 * step as f32;
            let (a, b) = (round.at(wo, h).evaluate(wi), ellipse.at(wo, h).evaluate(wi));
            for (a, b) in a.0.into_iter().zip(b.0) {
                worst = worst.max((a - b).abs().max_element());
            }
        }
        worst
    };
    let differences = [0.9, 0.99, 0.999, 0.9999].map(worst);
    println!("an ellipse against the round fibre, by 1 - aspect 0.1 .. 0.0001: {differences:?}");
    assert!(differences.windows(2).all(|pair| pair[1] < 0.2 * pair[0]), "{differences:?}");
    assert!(differences[3] < 2e-3, "{differences:?}");
}

/// From the flat side the ribbon is thin and lets light through; from the edge it is thick.
#[test]
fn an_ellipse_is_as_thick_as_it_is_seen() {
    let ribbon = HairParameters { aspect: 0.3, sigma_a: Vec3::ONE, ..HairParameters::default() };
    let bcsdf = HairBcsdf::new(&ribbon).unwrap();
    let through = |wo: Vec3| bcsdf.at(wo, 0.0).albedo()[1].x;
    let entered = 1.0 - HairBcsdf::new(&ribbon).unwrap().at(Vec3::Y, 0.0).albedo()[0].x;
    for (wo, length) in [(Vec3::Y, 2.0_f32), (Vec3::Z, 0.6), (Vec3::NEG_Z, 0.6)] {
        let expected = entered * entered * (-length).exp();
        assert!((through(wo) - expected).abs() < 1e-5, "{} {expected}", through(wo));
    }
}

#[test]
fn absorption_per_strand_is_the_same_as_in_the_material() {
    let sigma_a = Vec3::new(0.2, 0.5, 1.1);
    let white = HairBcsdf::new(&HairParameters::default()).unwrap();
    let dark = HairBcsdf::new(&HairParameters { sigma_a, ..HairParameters::default() }).unwrap();
    let wi = Vec3::new(0.6, -0.8, 0.0);
    assert_eq!(
        white.with_absorption(Absorption::of_cortex(sigma_a).unwrap()).at(Vec3::Y, 0.2).evaluate_with_pdf(wi),
        dark.at(Vec3::Y, 0.2).evaluate_with_pdf(wi),
    );
    for odd in [f32::NAN, -1.0, f32::INFINITY] {
        let found = Absorption::of_cortex(Vec3::new(0.1, odd, 0.1)).unwrap_err().to_string();
        assert_eq!(found, format!("sigma_a.g must lie in [0, infinity), found {odd}"));
    }
    let part = Absorption::default().toward(Absorption::of_cortex(sigma_a).unwrap(), 0.25);
    assert!((part.cortex() - 0.25 * sigma_a).length() < 1e-7);
}

#[test]
fn parameters_outside_their_bounds_are_refused_by_name() {
    let below_1 = f32::from_bits(1.0_f32.to_bits() - 1);
    type Case = (fn(&mut HairParameters, f32), &'static str, &'static str, &'static [f32]);
    let cases: [Case; 15] = [
        (|p, x| p.beta_m = x, "beta_m", "[0.001, 1]", &[0.0, 0.000_999, 1.001]),
        (|p, x| p.beta_n = x, "beta_n", "[0.001, 1]", &[1e-5, -0.3, 2.0]),
        (|p, x| p.alpha = x, "alpha", "(-pi/2, pi/2)", &[1.6, -1.6]),
        (|p, x| p.eta = x, "eta", "[1.0001, 3]", &[1.0, 3.1]),
        (|p, x| p.sigma_a.x = x, "sigma_a.r", "[0, infinity)", &[-1e-9]),
        (|p, x| p.sigma_a.z = x, "sigma_a.b", "[0, infinity)", &[-1.0]),
        (|p, x| p.lobe_weights[2] = x, "lobe_weights.TRT", "[0, infinity)", &[-0.1]),
        (|p, x| p.lobe_weights[4] = x, "lobe_weights.scattered", "[0, infinity)", &[-0.1]),
        (|p, x| p.roughness_scales.tt = x, "roughness_scales.tt", "[0.1, 8]", &[0.0, 8.1]),
        (|p, x| p.roughness_scales.trt = x, "roughness_scales.trt", "[0.1, 8]", &[0.099, 9.0]),
        (|p, x| p.cuticle_layers = Some(x), "cuticle_layers", "[0.01, 100]", &[0.0, 101.0]),
        (|p, x| p.film = Some(WaterFilm { eta: x, ..WATER }), "film.eta", "[1.0001, 3]", &[1.0, 4.0]),
        (
            |p, x| p.film = Some(WaterFilm { roughness: x, ..WATER }),
            "film.roughness",
            "[0.001, 1]",
            &[0.0, 1.5],
        ),
        (|p, x| p.aspect = x, "aspect", "[0.1, 1]", &[0.0, 0.05, 1.01]),
        (|p, x| p.lobe_weights[0] = x, "lobe_weights.R", "[0, infinity)", &[]),
    ];
    for (change, name, range, values) in cases {
        for &found in values.iter().chain(&[f32::NAN, f32::INFINITY, f32::NEG_INFINITY]) {
            let mut parameters = HairParameters::default();
            change(&mut parameters, found);
            let refused = HairBcsdf::new(&parameters).unwrap_err();
            assert_eq!(refused.to_string(), format!("{name} must lie in {range}, found {found}"));
        }
        // What is accepted next to that is not bounded: 1 is in every range but that of indices.
        let mut parameters = HairParameters::default();
        change(&mut parameters, if name.ends_with("eta") { 1.0001 } else { below_1 });
        HairBcsdf::new(&parameters).unwrap();
    }
}

#[test]
fn colour_and_pigment_become_absorption() {
    // (ln 0.5 / 5.8884)^2 for beta_n 0.3, worked by hand from the published polynomial.
    let grey = absorption_from_color(Vec3::splat(0.5), 0.3).unwrap();
    let divisor = 5.969 - 0.215 * 0.3 + 2.532 * 0.09 - 10.73 * 0.027 + 5.574 * 0.0081 + 0.245 * 0.00243;
    let expected = (0.5_f32.ln() / divisor).powi(2);
    assert!((grey.x - expected).abs() < 1e-6 * expected, "{grey} {expected}");
    assert_eq!(absorption_from_color(Vec3::ONE, 0.3), Ok(Vec3::ZERO));
    assert!(absorption_from_color(Vec3::ZERO, 0.3).unwrap().is_finite());
    assert!(absorption_from_color(Vec3::splat(0.1), 0.3).unwrap().x > grey.x);

    assert_eq!(absorption_from_melanin(0.0, 0.5), Ok(Vec3::ZERO));
    // MaterialX's colours of the pigments are the transmittances at unit concentration.
    let one = 1.0 - (-1.0_f32).exp();
    let black = absorption_from_melanin(one, 0.0).unwrap();
    let red = absorption_from_melanin(one, 1.0).unwrap();
    let transmitted = |sigma: Vec3| Vec3::new((-sigma.x).exp(), (-sigma.y).exp(), (-sigma.z).exp());
    assert!((transmitted(black) - Vec3::new(0.657_704, 0.498_077, 0.254_107)).length() < 1e-5);
    assert!((transmitted(red) - Vec3::new(0.829_444, 0.670_32, 0.349_938)).length() < 1e-5);
    assert_eq!(absorption_from_pigments(1.0, 0.0), Ok(Vec3::new(0.419, 0.697, 1.37)));
    // Black is bounded, at a melanin of 0.9999.
    let most = absorption_from_melanin(1.0, 0.0).unwrap();
    assert!((most.x - 0.419 * 1e4_f32.ln()).abs() < 1e-5);
}

#[test]
fn the_fit_of_colour_and_its_inverse() {
    for beta_n in [0.05, 0.3, 0.9] {
        for color in [Vec3::new(0.9, 0.5, 0.1), Vec3::new(0.02, 0.3, 0.99), Vec3::new(1.0, 1e-6, 0.5)] {
            let sigma_a = absorption_from_color(color, beta_n).unwrap();
            let back = color_from_absorption(sigma_a, beta_n).unwrap();
            assert!((back - color).abs().max_element() < 1e-5, "{color} {back}");
        }
    }
}

#[test]
fn colour_and_pigment_outside_their_ranges_are_refused() {
    let name = |refused: Result<Vec3, ScatteringError>| match refused {
        Err(ScatteringError::OutOfRange { name, .. }) => name,
        other => panic!("{other:?}"),
    };
    for color in [Vec3::new(0.1, 1.01, 0.1), Vec3::new(-1e-9, 0.1, 0.1), Vec3::new(0.1, 0.1, f32::NAN)] {
        assert_eq!(name(absorption_from_color(color, 0.3)), "color");
    }
    for beta_n in [0.0, 1.1, f32::NAN] {
        assert_eq!(name(absorption_from_color(Vec3::ONE, beta_n)), "beta_n");
        assert_eq!(name(color_from_absorption(Vec3::ONE, beta_n)), "beta_n");
    }
    assert_eq!(name(color_from_absorption(Vec3::NEG_ONE, 0.3)), "sigma_a.r");
    for bad in [-0.1, 1.1, f32::NAN] {
        assert_eq!(name(absorption_from_melanin(bad, 0.5)), "melanin");
        assert_eq!(name(absorption_from_melanin(0.5, bad)), "melanin_redness");
    }
    for bad in [-0.1, f32::INFINITY, f32::NAN] {
        assert_eq!(name(absorption_from_pigments(bad, 0.5)), "eumelanin");
        assert_eq!(name(absorption_from_pigments(0.5, bad)), "pheomelanin");
    }
}
