//! Each system's defaults give the figures it is known for; what goes both ways comes back; what is out of
//! range is refused by the system's own name for it.
#![allow(clippy::unwrap_used, clippy::panic)]

use glam::Vec3;
use proptest::prelude::*;

use super::*;
use crate::HairBcsdf;
use crate::HairParameters;
use crate::RoughnessScales;

#[track_caller]
fn near(found: Vec3, expected: [f32; 3], tolerance: f32) {
    assert!(
        (found - Vec3::from_array(expected)).abs().max_element() < tolerance,
        "{found}, not {expected:?}"
    );
}

/// What was refused, in the words the user reads.
#[track_caller]
fn refused(parameters: Result<HairParameters, ScatteringError>) -> String {
    match parameters {
        Err(error) => error.to_string(),
        Ok(parameters) => panic!("accepted: {parameters:?}"),
    }
}

#[test]
fn every_system_that_can_be_said_by_default_is() {
    for parameters in [
        CyclesHair::default().parameters(),
        PbrtHair::default().parameters(),
        MitsubaHair::default().parameters(),
        ArnoldHair::default().parameters(),
        PxrMarschnerHair::default().parameters(),
    ] {
        assert!(HairBcsdf::new(&parameters.unwrap()).is_ok());
    }
}

#[test]
fn pbrt_is_brown_by_default_and_tilted_the_other_way() {
    let brown = PbrtHair::default().parameters().unwrap();
    near(brown.sigma_a, [1.3 * 0.419, 1.3 * 0.697, 1.3 * 1.37], 1e-6);
    assert_eq!((brown.beta_m, brown.beta_n, brown.eta), (0.3, 0.3, 1.55));
    assert_eq!(brown.alpha, -2.0_f32.to_radians());
    let red = PbrtHair { pheomelanin: Some(0.5), ..PbrtHair::default() }.parameters().unwrap();
    near(red.sigma_a, [0.5 * 0.187, 0.5 * 0.4, 0.5 * 1.05], 1e-6);
    let both = PbrtHair { sigma_a: Some(Vec3::ONE), eumelanin: Some(1.0), ..PbrtHair::default() };
    assert_eq!(refused(both.parameters()), "give sigma_a or eumelanin or pheomelanin, not both");
    let negative = PbrtHair { eumelanin: Some(-1.0), ..PbrtHair::default() };
    assert_eq!(refused(negative.parameters()), "eumelanin must lie in [0, infinity), found -1");
}

#[test]
fn mitsuba_counts_the_index_of_air() {
    let hair = MitsubaHair::default().parameters().unwrap();
    assert!((hair.eta - 1.549_570_8).abs() < 1e-6, "{}", hair.eta);
    near(hair.sigma_a, [1.3 * 0.419 + 0.2 * 0.187, 1.3 * 0.697 + 0.2 * 0.4, 1.3 * 1.37 + 0.2 * 1.05], 1e-6);
    let scaled =
        MitsubaHair { sigma_a: Some(Vec3::new(0.2, 0.25, 0.7)), scale: 2.0, ..MitsubaHair::default() };
    near(scaled.parameters().unwrap().sigma_a, [0.4, 0.5, 1.4], 1e-6);
    let vacuum = MitsubaHair { ext_ior: 0.0, ..MitsubaHair::default() };
    assert!(refused(vacuum.parameters()).starts_with("ext_ior must lie in"));
}

/// Blender's manual: melanin 0.8, all red, and the default colour and absorption of its panel.
#[test]
fn cycles_colours_hair_in_three_ways() {
    let of = |parametrization| CyclesHair { parametrization, ..CyclesHair::default() };
    let melanin = of(CyclesParametrization::Melanin).parameters().unwrap();
    let amount = -(0.2_f32.ln());
    near(melanin.sigma_a, [0.343 * amount, 0.733 * amount, 1.924 * amount], 1e-5);
    let absorption = of(CyclesParametrization::Absorption).parameters().unwrap();
    assert_eq!(absorption.sigma_a, Vec3::new(0.245_531, 0.52, 1.365));
    // The default colour is black hair: its fit, worked by hand.
    let color = of(CyclesParametrization::Color).parameters().unwrap();
    near(color.sigma_a, [0.4719, 0.7668, 1.1035], 2e-4);
    assert_eq!(color.alpha, 2.0_f32.to_radians());
    // A dye adds its own absorption.
    let dyed = CyclesHair { tint: Vec3::new(1.0, 0.5, 0.5), ..of(CyclesParametrization::Melanin) };
    let more = dyed.parameters().unwrap().sigma_a - melanin.sigma_a;
    near(more, [0.0, 0.013_857, 0.013_857], 1e-5);
}

#[test]
fn coat_makes_r_alone_smoother() {
    let plain = CyclesHair::default().parameters().unwrap().lobe_spreads();
    let coated = CyclesHair { coat: 0.5, ..CyclesHair::default() }.parameters().unwrap();
    assert!((coated.beta_m - 0.15).abs() < 1e-6);
    let scales = coated.roughness_scales;
    let v = longitudinal(coated.beta_m);
    for (found, expected) in
        [(v * scales.tt * scales.tt, plain[1][0]), (v * scales.trt * scales.trt, plain[2][0])]
    {
        assert!((found / expected - 1.0).abs() < 1e-5, "{found}, not {expected}");
    }
    let varnished = CyclesHair { coat: 0.95, ..CyclesHair::default() };
    assert!(refused(varnished.parameters()).starts_with("coat must lie in [0, 1)"));
}

fn longitudinal(beta_m: f32) -> f32 {
    crate::hair::parameters::longitudinal_variance(f64::from(beta_m)) as f32
}

/// The node's published figures: exp(-(0.419, 0.697, 1.37)) and exp(-(0.187, 0.4, 1.05)), and at melanin 0.25,
/// redness 0.5 an absorption of half of -ln 0.75 times each.
#[test]
fn materialx_s_pigments_are_those_of_d_eon() {
    let half = 0.5 * -(0.75_f32.ln());
    let sigma_a = MaterialXMelanin::default().absorption().unwrap();
    near(sigma_a, [half * (0.419 + 0.187), half * (0.697 + 0.4), half * (1.37 + 1.05)], 1e-5);
    let clear = MaterialXMelanin { eumelanin_color: Vec3::ZERO, ..MaterialXMelanin::default() };
    assert!(clear.absorption().unwrap_err().to_string().starts_with("eumelanin_color must lie in (0, 1]"));
}

#[test]
fn materialx_s_roughness_comes_back() {
    let [r, tt, trt] = MaterialXRoughness::default().pairs().unwrap();
    let v = (0.726 * 0.1 + 0.812 * 0.01_f32).powi(2);
    for (found, expected) in [(r, v), (tt, 0.25 * v), (trt, 4.0 * v)] {
        assert!((found[0] - expected).abs() < 1e-7 && (found[1] - 0.100_76).abs() < 1e-6, "{found:?}");
    }
    let hair =
        MaterialXHair { roughness_r: r, roughness_tt: tt, roughness_trt: trt, ..MaterialXHair::default() };
    let parameters = hair.parameters().unwrap();
    assert!((parameters.beta_m - 0.1).abs() < 1e-6 && (parameters.beta_n - 0.2).abs() < 1e-6);
    assert!((parameters.roughness_scales.tt - 0.5).abs() < 1e-6);
    assert!((parameters.roughness_scales.trt - 2.0).abs() < 1e-6);
    assert_eq!(parameters.alpha, 0.0);
}

#[test]
fn materialx_s_inputs_without_a_counterpart_are_refused() {
    let [r, tt, trt] = MaterialXRoughness::default().pairs().unwrap();
    let hair =
        MaterialXHair { roughness_r: r, roughness_tt: tt, roughness_trt: trt, ..MaterialXHair::default() };
    assert!(hair.parameters().is_ok());
    let red = MaterialXHair { tint_tt: Vec3::new(1.0, 0.5, 0.5), ..hair };
    assert!(refused(red.parameters()).starts_with("tint_TT must lie in greys"));
    let grey = MaterialXHair { tint_trt: Vec3::splat(0.5), ..hair };
    assert_eq!(grey.parameters().unwrap().lobe_weights, [1.0, 1.0, 0.5, 0.5, 1.0]);
    assert!(refused(MaterialXHair::default().parameters()).starts_with("roughness_TT s must lie in"));
    let rough = MaterialXHair { roughness_r: [28.0, r[1]], ..hair };
    assert!(refused(rough.parameters()).starts_with("roughness_R v must lie in [5.2826e-7, 27.436]"));
    let wide = MaterialXHair { roughness_r: [r[0], 7.0], ..hair };
    assert!(refused(wide.parameters()).starts_with("roughness_R s must lie in [2.6620e-4, 6.831]"));
    let turned = MaterialXHair { cuticle_angle: 1.1, ..hair };
    assert!(refused(turned.parameters()).starts_with("cuticle_angle must lie in (0, 1)"));
    let weighted = HairParameters { lobe_weights: [1.0, 1.0, 1.0, 0.0, 1.0], ..HairParameters::default() };
    assert!(MaterialXHair::from_parameters(&weighted).is_err());
}

proptest! {
    #[test]
    fn materialx_both_ways(
        beta_m in 0.001_f32..=1.0, beta_n in 0.001_f32..=1.0, alpha in -1.5_f32..1.5, eta in 1.0001_f32..=3.0,
        tt in 0.1_f32..=8.0, trt in 0.1_f32..=8.0, weights in prop::array::uniform3(0.0_f32..2.0),
    ) {
        let [r, w_tt, w_trt] = weights;
        let parameters = HairParameters {
            beta_m, beta_n, alpha, eta,
            sigma_a: Vec3::new(0.1, 0.4, 1.2),
            lobe_weights: [r, w_tt, w_trt, w_trt, 1.0],
            roughness_scales: RoughnessScales { tt, trt },
            ..HairParameters::default()
        };
        let back = MaterialXHair::from_parameters(&parameters).unwrap().parameters().unwrap();
        for (found, expected) in [
            (back.beta_m, beta_m),
            (back.beta_n, beta_n),
            (back.roughness_scales.tt, tt),
            (back.roughness_scales.trt, trt),
        ] {
            prop_assert!((found / expected - 1.0).abs() < 2e-6, "{found}, not {expected}");
        }
        prop_assert!((back.alpha - alpha).abs() < 1e-6);
        prop_assert_eq!((back.eta, back.sigma_a, back.lobe_weights), (eta, parameters.sigma_a, parameters.lobe_weights));
    }

    /// Inverting the polynomials is exact to the last bits of f32, from end to end.
    #[test]
    fn spreads_give_back_their_roughness(exponent in -5.0_f32..=0.0) {
        let beta = 10.0_f32.powf(exponent);
        let found = beta_m_from_variance(longitudinal(beta)).unwrap();
        prop_assert!((found / beta - 1.0).abs() < 1e-6, "{found}, not {beta}");
        let s = crate::hair::parameters::azimuthal_deviation(f64::from(beta)) as f32;
        let found = beta_n_from_scale(s).unwrap();
        prop_assert!((found / beta - 1.0).abs() < 1e-6, "{found}, not {beta}");
    }
}

#[test]
fn the_ends_of_the_spreads() {
    assert_eq!(beta_m_from_variance(longitudinal(1.0)), Ok(1.0));
    assert!((beta_n_from_scale(6.831).unwrap() - 1.0).abs() < 1e-6);
    for bad in [0.0, -1.0, 27.5, f32::NAN, f32::INFINITY] {
        assert!(beta_m_from_variance(bad).is_err() && beta_n_from_scale(bad).is_err(), "{bad}");
    }
}

#[test]
fn arnold_adds_melanin_and_base() {
    let black = ArnoldHair::default().parameters().unwrap();
    let most = 1e4_f32.ln();
    near(black.sigma_a, [most * 0.303, most * 0.5485, most * 1.21], 1e-4);
    assert_eq!((black.beta_m, black.beta_n, black.alpha), (0.2, 0.2, 3.0_f32.to_radians()));
    let textured = ArnoldHair { melanin: 0.0, base: 0.5, ..ArnoldHair::default() }.parameters().unwrap();
    let grey = crate::absorption_from_color(Vec3::splat(0.5), 0.2).unwrap();
    assert_eq!(textured.sigma_a, grey);
    let apart = ArnoldHair { roughness_anisotropic: true, roughness_azimuthal: 0.6, ..ArnoldHair::default() };
    assert_eq!(apart.parameters().unwrap().beta_n, 0.6);
    let dull = ArnoldHair { diffuse: 0.3, ..ArnoldHair::default() };
    assert!(refused(dull.parameters()).starts_with("diffuse must lie in {0}"));
    let loud = ArnoldHair { melanin: f32::NAN, ..ArnoldHair::default() };
    assert!(refused(loud.parameters()).starts_with("melanin must lie in [0, 1]"));
}

#[test]
fn renderman_s_cones_become_variances() {
    let hair = PxrMarschnerHair::default().parameters().unwrap();
    let v = 8.0_f32.to_radians().powi(2);
    assert!((longitudinal(hair.beta_m) / v - 1.0).abs() < 1e-5);
    assert_eq!(hair.roughness_scales, RoughnessScales { tt: 1.0, trt: 1.0 });
    assert_eq!(hair.alpha, 3.0_f32.to_radians());
    // 1.851 radii is the mean crossing at an index of 1.55.
    near(hair.sigma_a, [0.495, 0.495, 0.495], 1e-3);
    // TRT of 0.4 is 2.5 times the square of TT's 0.4.
    assert!((hair.lobe_weights[2] - 2.5).abs() < 1e-5);
    let sharp = PxrMarschnerHair { specular_cone_angle_r: 0.0, ..PxrMarschnerHair::default() };
    assert!(refused(sharp.parameters()).starts_with("specularConeAngleR must lie in"));
}

/// Who wrote `scale_tilt: 120` has no `alpha` to look for.
#[test]
fn refusals_have_the_system_s_own_names_and_units() {
    let arnold = |change: fn(&mut ArnoldHair)| {
        let mut hair = ArnoldHair::default();
        change(&mut hair);
        hair.parameters()
    };
    let cycles = |change: fn(&mut CyclesHair)| {
        let mut hair = CyclesHair::default();
        change(&mut hair);
        hair.parameters()
    };
    let mitsuba = |change: fn(&mut MitsubaHair)| {
        let mut hair = MitsubaHair::default();
        change(&mut hair);
        hair.parameters()
    };
    let renderman = |change: fn(&mut PxrMarschnerHair)| {
        let mut hair = PxrMarschnerHair::default();
        change(&mut hair);
        hair.parameters()
    };
    let materialx = |change: fn(&mut MaterialXHair)| {
        let [roughness_r, roughness_tt, roughness_trt] = MaterialXRoughness::default().pairs().unwrap();
        let mut hair = MaterialXHair { roughness_r, roughness_tt, roughness_trt, ..MaterialXHair::default() };
        change(&mut hair);
        hair.parameters()
    };
    for (parameters, told) in [
        (arnold(|h| h.shift = 120.0), "shift must lie in (-90, 90) degrees, found 120"),
        (arnold(|h| h.ior = 1.0), "ior must lie in [1.0001, 3], found 1"),
        (cycles(|h| h.offset = 1.6), "offset must lie in (-pi/2, pi/2), found 1.6"),
        (cycles(|h| h.ior = 5.0), "ior must lie in [1.0001, 3], found 5"),
        (cycles(|h| (h.roughness, h.coat) = (0.002, 0.6)), "coat must lie in [0, 1)"),
        (mitsuba(|h| h.scale_tilt = -95.0), "scale_tilt must lie in (-90, 90) degrees, found -95"),
        (mitsuba(|h| h.int_ior = 1.0), "int_ior must lie in [1.0001, 3] times ext_ior, found 1"),
        (renderman(|h| h.specular_offset = 91.0), "specularOffset must lie in (-90, 90) degrees, found 91"),
        (renderman(|h| h.specular_eccentricity = 0.0), "specularEccentricity must lie in [0.1, 1], found 0"),
        (
            renderman(|h| h.specular_glint_width = 0.01),
            "specularGlintWidth must lie in [0.0153, 180] degrees",
        ),
        (
            renderman(|h| h.specular_cone_angle_r = 120.0),
            "specularConeAngleR must lie in [0.0417, 90] degrees, found 120",
        ),
        (renderman(|h| h.specular_cone_angle_tt = 0.7), "specularConeAngleTT must lie in [0.1, 8] times"),
        (materialx(|h| h.ior = 0.5), "ior must lie in [1.0001, 3], found 0.5"),
        (materialx(|h| h.cuticle_angle = 0.0), "cuticle_angle must lie in (0, 1), found 0"),
        (materialx(|h| h.roughness_r[0] = 1e-8), "roughness_R v must lie in [5.2826e-7, 27.436]"),
        (materialx(|h| h.roughness_tt[0] = 1e-9), "roughness_TT v must lie in [0.01, 64] times"),
    ] {
        let found = refused(parameters);
        assert!(found.starts_with(told), "{found}, not {told}");
    }
    let smooth = PxrMarschnerHair {
        specular_cone_angle_r: 0.03,
        specular_cone_angle_tt: 0.03,
        specular_cone_angle_trt: 0.03,
        ..PxrMarschnerHair::default()
    };
    assert!(refused(smooth.parameters()).starts_with("specularConeAngleR must lie in [0.0417, 90] degrees"));
    let turned = PbrtHair { alpha: 100.0, ..PbrtHair::default() };
    assert_eq!(refused(turned.parameters()), "alpha must lie in (-90, 90) degrees, found 100");
}
