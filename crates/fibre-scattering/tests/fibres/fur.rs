//! Fur: hair without a medulla, energy, sampling, and agreement with walks of another make.

use std::f64::consts::{PI, TAU};
use std::sync::{Arc, LazyLock};

use crate::brute_force::{Chance, Cylinders, SET_A, SET_B};
use crate::support::{Random, direction, single};
use fibre_scattering::{
    Absorption, FurBcsdf, FurParameters, FurReference, HairBcsdf, HairParameters, Lobe, Medulla, MedullaKey,
    MedullaTable, WaterFilm, YanBcsdf, YanForm, YanPath,
};
use glam::Vec3;

fn parameters(cylinders: &Cylinders) -> FurParameters {
    let hair = HairParameters {
        eta: cylinders.eta as f32,
        cuticle_layers: cylinders.layers.map(|layers| layers as f32),
        film: cylinders.film.map(|eta| WaterFilm { eta: eta as f32, ..WaterFilm::default() }),
        ..HairParameters::default()
    };
    let medulla = Medulla {
        kappa: cylinders.kappa as f32,
        sigma_s: cylinders.sigma_s as f32,
        g: cylinders.g as f32,
        ..Medulla::NONE
    };
    FurParameters { hair, medulla }
}

fn table(parameters: &FurParameters, walks: u32) -> Option<Arc<MedullaTable>> {
    let key = MedullaKey { walks, ..MedullaKey::needed(parameters)? };
    Some(Arc::new(MedullaTable::build(&key).unwrap()))
}

type Set = (Cylinders, FurParameters, Option<Arc<MedullaTable>>);

/// Sets A and B of the published fits, white, with tables that are good enough to compare.
static SETS: LazyLock<[Set; 2]> = LazyLock::new(|| {
    [SET_A, SET_B].map(|set| {
        let parameters = parameters(&set);
        (set, parameters, table(&parameters, 4000))
    })
});

type Material = (FurParameters, Option<Arc<MedullaTable>>);

/// Tables of no use but to be exact: with extreme media, from few walks.
static ROUGH: LazyLock<Vec<Material>> = LazyLock::new(|| {
    let media =
        [(0.86, 3.0, 0.8), (0.99, 100.0, 0.99), (0.01, 100.0, -0.99), (0.5, 1e-6, 0.0), (0.9, 50.0, -0.5)];
    media
        .into_iter()
        .flat_map(|(kappa, sigma_s, g)| {
            [1.0001, 1.55, 3.0].map(|eta| Cylinders { eta, kappa, sigma_s, g, layers: None, film: None })
        })
        .map(|cylinders| {
            let parameters = parameters(&cylinders);
            let table = table(&parameters, 20);
            (parameters, table)
        })
        .collect()
});

const RAYS: [(f64, f64); 7] =
    [(0.0, 0.0), (0.3, 20.0), (-0.7, -60.0), (0.999, 45.0), (-1.0, 0.0), (0.5, 89.99), (0.2, -90.0)];

#[test]
fn without_a_medulla_it_is_hair_to_the_bit() {
    let hair = HairParameters { sigma_a: Vec3::new(0.1, 0.4, 2.0), ..HairParameters::default() };
    let sigma_a = Vec3::new(0.3, 0.0, 1.0);
    let absorption = Absorption::new(sigma_a, Vec3::splat(3.0)).unwrap();
    let medullas = [Medulla::NONE, Medulla { sigma_s: 7.0, g: 0.5, sigma_a: Vec3::ONE, ..Medulla::NONE }];
    let hair = (hair, HairBcsdf::new(&hair).unwrap().with_absorption(absorption));
    for medulla in medullas {
        let fur = FurBcsdf::new(&FurParameters { hair: hair.0, medulla }, None).unwrap();
        let mut random = Random(3);
        for (h, theta) in RAYS {
            let wo = single(direction(theta.to_radians(), 0.4));
            let (a, b) = (hair.1.at(wo, h as f32), fur.at(wo, h as f32, absorption));
            assert_eq!(a.albedo(), b.albedo());
            for _ in 0..200 {
                let u = [(); 4].map(|()| random.next() as f32);
                assert_eq!(a.sample(u), b.sample(u));
                let wi = a.sample(u).map_or(Vec3::Y, |sample| sample.wi);
                assert_eq!(a.evaluate_with_pdf(wi), b.evaluate_with_pdf(wi));
            }
        }
    }
}

#[test]
fn a_medulla_that_only_absorbs_is_on_the_way_of_tt_and_trt() {
    let mut fur = parameters(&SET_A);
    fur.medulla = Medulla { sigma_s: 0.0, sigma_a: Vec3::new(0.2, 1.0, 5.0), ..fur.medulla };
    fur.hair.sigma_a = Vec3::new(0.5, 0.1, 0.0);
    let reference = FurReference::new(&fur, None).unwrap();
    for (h, theta) in [(0.0_f64, 0.0_f64), (0.5, 30.0), (-0.99, -70.0)] {
        let (sin, cos) = theta.to_radians().sin_cos();
        let eta = f64::from(fur.hair.eta);
        let kappa = f64::from(fur.medulla.kappa);
        let cos_t = (1.0 - (sin / eta).powi(2)).sqrt();
        let b = h * cos / (eta * cos_t);
        let s_m = if b.abs() < kappa { (kappa * kappa - b * b).sqrt() } else { 0.0 };
        let s_c = (1.0 - b * b).sqrt() - s_m;
        let albedo = reference.at(direction(theta.to_radians(), 0.0), h).albedo();
        for channel in 0..3 {
            let [cortex, medulla] = [fur.hair.sigma_a, fur.medulla.sigma_a].map(|s| f64::from(s[channel]));
            let t = (-2.0 * (s_c * cortex + s_m * medulla) / cos_t).exp();
            let f = albedo[0][channel];
            let expected = [f, (1.0 - f).powi(2) * t, (1.0 - f).powi(2) * f * t * t];
            for (lobe, expected) in expected.into_iter().enumerate() {
                assert!((albedo[lobe][channel] - expected).abs() < 1e-9, "{h} {theta} {lobe}");
            }
            assert_eq!(albedo[4][channel], 0.0);
        }
    }
    // Where next to nothing scatters it is the same.
    let still = FurBcsdf::new(&fur, None).unwrap();
    fur.medulla.sigma_s = 1e-7;
    let scatters = FurBcsdf::new(&fur, table(&fur, 20)).unwrap();
    let absorption = Absorption::new(fur.hair.sigma_a, fur.medulla.sigma_a).unwrap();
    let at =
        |fur: &FurBcsdf| fur.at(Vec3::Y, 0.3, absorption).evaluate(Vec3::new(0.1, -0.9, 0.2).normalize());
    for lobe in Lobe::ALL {
        let (a, b) = (at(&still)[lobe], at(&scatters)[lobe]);
        assert!((a - b).abs().max_element() <= 1e-5 * (a.max_element() + 0.1), "{lobe:?}: {a} {b}");
    }
}

#[test]
fn a_white_fibre_returns_all_light() {
    for (parameters, table) in &*ROUGH {
        let fur = FurBcsdf::new(parameters, table.clone()).unwrap();
        for (h, theta) in RAYS {
            let wo = single(direction(theta.to_radians(), 1.0));
            let albedo: Vec3 = fur.at(wo, h as f32, Absorption::default()).albedo().into_iter().sum();
            assert!((albedo - Vec3::ONE).abs().max_element() < 5e-6, "{parameters:?} {h} {theta}: {albedo}");
        }
    }
}

/// The integral over all directions of a function of azimuth and sine, exact for the scattered lobe: between
/// its knots that is a product of straight lines, and two points of Gauss suffice.
fn integral(centre: f64, f: impl Fn(f64, f64) -> f64) -> f64 {
    let (sines, around) = MedullaTable::knots();
    let columns = (TAU / around).round() as u32;
    assert!(
        (f64::from(columns) * around - TAU).abs() < 1e-12
            && (sines[0], sines[sines.len() - 1]) == (-1.0, 1.0)
    );
    let points = [0.5 - 0.75_f64.sqrt() / 3.0, 0.5 + 0.75_f64.sqrt() / 3.0];
    let mut sum = 0.0;
    for (i, pair) in (0..columns).flat_map(|i| sines.windows(2).map(move |pair| (i, pair))) {
        let (below, above) = (pair[0], pair[1]);
        for (a, b) in points.iter().flat_map(|a| points.iter().map(move |b| (a, b))) {
            let value = f(centre + (f64::from(i) + a) * around, below + b * (above - below));
            sum += value * around * (above - below) / 4.0;
        }
    }
    sum
}

/// Azimuth where unscattered light leaves first.
fn centre(parameters: &FurParameters, h: f64, theta: f64) -> f64 {
    let (sin, cos) = theta.to_radians().sin_cos();
    let eta = f64::from(parameters.hair.eta);
    let bent = (eta * eta - sin * sin).sqrt() / cos;
    2.0 * (h / bent).asin() - 2.0 * h.asin() + PI
}

#[test]
fn the_scattered_lobe_integrates_to_its_albedo() {
    for (mut parameters, table) in ROUGH.iter().cloned() {
        parameters.hair.sigma_a = Vec3::new(0.0, 0.2, 3.0);
        parameters.medulla.sigma_a = Vec3::new(0.0, 0.0, 1.0);
        let fur = FurReference::new(&parameters, table).unwrap();
        for (h, theta) in [(0.0, 0.0), (0.35, 30.0), (-0.2, 50.0), (-0.8, -75.0)] {
            let hit = fur.at(direction(theta_radians(theta), 0.0), h);
            let centre = centre(&parameters, h, theta);
            for channel in 0..3 {
                let found = integral(centre, |phi, sin| {
                    hit.evaluate_with_pdf(direction(sin.asin(), phi)).0[4][channel]
                });
                let expected = hit.albedo()[4][channel];
                assert!((found - expected).abs() < 1e-9, "{parameters:?} {h} {theta}: {found} {expected}");
            }
        }
    }
}

fn theta_radians(degrees: f64) -> f64 {
    degrees.to_radians()
}

#[test]
fn absorption_darkens_and_nothing_is_not_a_number() {
    let sigmas = [0.0, 1e-6, 0.01, 1.0, 30.0, 1e4, 1e30];
    for (parameters, table) in &*ROUGH {
        let fur = FurBcsdf::new(parameters, table.clone()).unwrap();
        let mut random = Random(8);
        for (h, theta) in RAYS {
            let wo = single(direction(theta.to_radians(), 1.0));
            let mut before = [1.0 + 1e-5; 2];
            for sigma in sigmas {
                let absorption =
                    Absorption::new(Vec3::new(sigma, 0.0, sigma), Vec3::new(0.0, sigma, sigma)).unwrap();
                let hit = fur.at(wo, h as f32, absorption);
                let albedo: Vec3 = hit.albedo().into_iter().sum();
                for (channel, before) in before.iter_mut().enumerate() {
                    assert!(albedo[channel] >= 0.0 && albedo[channel] <= *before + 1e-6, "{albedo}");
                    *before = albedo[channel];
                }
                for _ in 0..20 {
                    let u = [(); 4].map(|()| random.next() as f32);
                    let Some(sample) = hit.sample(u) else { continue };
                    assert!(sample.values.sum().is_finite() && sample.wi.is_normalized(), "{sample:?}");
                    assert!(sample.weight().max_element() <= 1.0 + 1e-4, "{sample:?}");
                    assert_eq!((sample.values, sample.pdf), hit.evaluate_with_pdf(sample.wi));
                }
            }
        }
    }
}

#[test]
fn samples_follow_the_density() {
    const COUNT: usize = 60_000;
    const CELLS: (usize, usize) = (16, 10);
    let absorption = Absorption::new(Vec3::new(0.0, 0.2, 0.6), Vec3::new(0.3, 0.0, 0.6)).unwrap();
    for (number, (_, parameters, table)) in SETS.iter().enumerate() {
        let fur = FurBcsdf::new(parameters, table.clone()).unwrap();
        for (h, theta) in [(0.1, 10.0), (-0.6, -50.0), (0.95, 80.0)] {
            let hit = fur.at(single(direction(f64::to_radians(theta), 0.0)), h as f32, absorption);
            let cell = |phi: f64, sin: f64| {
                let around = (phi.rem_euclid(TAU) / TAU * CELLS.0 as f64) as usize;
                let along = ((sin + 1.0) / 2.0 * CELLS.1 as f64) as usize;
                around.min(CELLS.0 - 1) * CELLS.1 + along.min(CELLS.1 - 1)
            };
            let mut expected = vec![0.0; CELLS.0 * CELLS.1];
            let fine = (CELLS.0 * 40, CELLS.1 * 40);
            for i in 0..fine.0 {
                for j in 0..fine.1 {
                    let phi = (i as f64 + 0.5) / fine.0 as f64 * TAU;
                    let sin = (j as f64 + 0.5) / fine.1 as f64 * 2.0 - 1.0;
                    let pdf = f64::from(hit.pdf(single(direction(sin.asin(), phi))));
                    expected[cell(phi, sin)] += pdf * 2.0 * TAU / (fine.0 * fine.1) as f64;
                }
            }
            let total: f64 = expected.iter().sum();
            assert!((total - 1.0).abs() < 1e-3, "{total}");
            let mut counts = vec![0.0; expected.len()];
            let mut random = Random(77 + number as u64);
            for _ in 0..COUNT {
                let u = [(); 4].map(|()| random.next() as f32);
                let wi = hit.sample(u).unwrap().wi.as_dvec3();
                counts[cell(wi.z.atan2(wi.y), wi.x)] += 1.0;
            }
            let (mut chi, mut degrees) = (0.0, -1.0);
            for (count, expected) in counts.iter().zip(&expected) {
                let expected = expected / total * COUNT as f64;
                if expected > 5.0 {
                    chi += (count - expected).powi(2) / expected;
                    degrees += 1.0;
                }
            }
            let deviate = (chi - degrees) / f64::sqrt(2.0 * degrees);
            assert!(deviate < 5.0, "{h} {theta}: {chi} for {degrees}");
        }
    }
}

/// Cortex and medulla.
const ABSORPTIONS: [[f64; 2]; 8] =
    [[0.0, 0.0], [0.4, 0.0], [0.0, 0.2], [0.39, 0.21], [0.05, 0.05], [2.0, 0.0], [0.0, 2.0], [3.0, 3.0]];

#[test]
fn albedos_are_those_of_an_independent_walk() {
    const WALKS: u64 = 40_000;
    let mut worst = 0.0_f64;
    for (set, parameters, table) in SETS.iter() {
        let fur = FurReference::new(parameters, table.clone()).unwrap();
        let mut errors = [[0.0; 2]; 8];
        for (h, theta) in [(0.0, 0.0), (0.4, 25.0), (-0.8, 0.0), (0.6, -70.0)] {
            let wo = direction(theta_radians(theta), 0.0);
            let mut chance = Chance::new(91);
            let mut walked = [0.0; 8];
            for _ in 0..WALKS {
                let outcome = set.walk(wo, h, &mut chance);
                for (sum, absorption) in walked.iter_mut().zip(ABSORPTIONS) {
                    *sum += outcome.passed(absorption) / WALKS as f64;
                }
            }
            for (index, [cortex, medulla]) in ABSORPTIONS.into_iter().enumerate() {
                let albedo = fur.at_absorbing(wo, h, [[cortex; 3], [medulla; 3]]).albedo();
                let albedo: f64 = albedo.iter().map(|lobe| lobe[0]).sum();
                worst = worst.max((albedo - walked[index]).abs());
                errors[index][0] += albedo;
                errors[index][1] += walked[index];
            }
        }
        for (absorption, [table, walk]) in ABSORPTIONS.iter().zip(errors) {
            println!("{absorption:?}: {:+.2} %", 100.0 * (table / walk - 1.0));
            assert!((table / walk - 1.0).abs() < 0.01, "{absorption:?}: {table} {walk}");
        }
    }
    println!("worst difference {worst}");
    assert!(worst < 0.01, "{worst}");
}

#[test]
fn scales_and_water_are_walked_alike() {
    const WALKS: u64 = 30_000;
    for (layers, film) in [(Some(2.45), None), (None, Some(1.333))] {
        let set = Cylinders { layers, film, ..SET_A };
        let parameters = parameters(&set);
        let fur = FurReference::new(&parameters, table(&parameters, 1000)).unwrap();
        for (index, [cortex, medulla]) in [[0.39, 0.21], [2.0, 0.0]].into_iter().enumerate() {
            let (mut found, mut walked) = (0.0, 0.0);
            for (h, theta) in [(0.3, 10.0), (-0.7, -45.0)] {
                let wo = direction(theta_radians(theta), 0.0);
                let mut chance = Chance::new(7 + index as u64);
                for _ in 0..WALKS {
                    walked += set.walk(wo, h, &mut chance).passed([cortex, medulla]) / WALKS as f64;
                }
                let albedo = fur.at_absorbing(wo, h, [[cortex; 3], [medulla; 3]]).albedo();
                found += albedo.iter().map(|lobe| lobe[0]).sum::<f64>();
            }
            println!("{layers:?} {film:?} {cortex} {medulla}: {found:.4} {walked:.4}");
            assert!((found - walked).abs() < 0.012, "{layers:?} {film:?}: {found} {walked}");
        }
    }
}

/// Parameters of section "own measurements" of the project's notes: theta 0, index 1.55, smooth, bare.
fn measured(kappa: f32, sigma_s: f32, g: f32, cortex: f32, medulla: f32) -> FurParameters {
    FurParameters {
        hair: HairParameters { eta: 1.55, sigma_a: Vec3::splat(cortex), ..HairParameters::default() },
        medulla: Medulla { kappa, sigma_s, g, sigma_a: Vec3::splat(medulla) },
    }
}

/// Mean over all offsets.
fn over_offsets(f: impl Fn(f64) -> f64) -> f64 {
    let count = 400;
    (0..count).map(|i| f((f64::from(i) + 0.5) / f64::from(count) * 2.0 - 1.0)).sum::<f64>() / f64::from(count)
}

#[test]
fn the_five_lobe_model_is_as_bright_as_was_measured() {
    // Total albedo of the forms F, (1 - F) and (1 - F)(1 - P), and of walks.
    let rows = [
        (measured(0.86, 3.15, 0.79, 0.0, 0.0), [0.158, 1.008, 1.000], 1.000),
        (measured(0.86, 3.15, 0.79, 0.39, 0.21), [0.136, 0.769, 0.763], 0.474),
        (measured(0.88, 1.69, 0.44, 0.0, 0.0), [0.215, 1.065, 1.000], 1.000),
        (measured(0.88, 1.69, 0.44, 0.64, 0.17), [0.171, 0.794, 0.747], 0.465),
        (measured(0.5, 3.0, 0.5, 0.0, 0.0), [0.389, 1.087, 0.996], 1.000),
    ];
    let total = |albedo: [[f64; 3]; 5]| albedo.iter().map(|lobe| lobe[0]).sum::<f64>();
    for (parameters, expected, walked) in rows {
        let forms = [YanForm::Printed, YanForm::Released, YanForm::Corrected];
        for (form, expected) in forms.into_iter().zip(expected) {
            let yan = YanBcsdf::new(&parameters, form, YanPath::Radius, 1).unwrap();
            let found = over_offsets(|h| total(yan.at([0.0, 1.0, 0.0], h).albedo()));
            assert!((found - expected).abs() < 0.0025, "{form:?}: {found} {expected}");
        }
        let fur = FurReference::new(&parameters, table(&parameters, 1000)).unwrap();
        let found = over_offsets(|h| total(fur.at([0.0, 1.0, 0.0], h).albedo()));
        assert!((found - walked).abs() < 0.004, "whole fibre: {found} {walked}");
    }
}

#[test]
fn each_of_the_five_lobes_holds_its_light() {
    let parameters = measured(0.86, 1.5, 0.5, 0.2, 0.1);
    for (form, path) in [(YanForm::Released, YanPath::Mean), (YanForm::Corrected, YanPath::Radius)] {
        let yan = YanBcsdf::new(&parameters, form, path, 200).unwrap();
        for (theta, h) in [(0.0, 0.2), (0.3, -0.7)] {
            let hit = yan.at(direction(theta, 0.5), h);
            let steps = (720, 400);
            let mut sums = [0.0; 5];
            for i in 0..steps.0 {
                for j in 0..steps.1 {
                    let sin = (f64::from(j) + 0.5) / f64::from(steps.1) * 2.0 - 1.0;
                    let phi = (f64::from(i) + 0.5) / f64::from(steps.0) * TAU;
                    for (sum, value) in sums.iter_mut().zip(hit.evaluate(direction(sin.asin(), phi))) {
                        *sum += value[0] * 2.0 * TAU / f64::from(steps.0 * steps.1);
                    }
                }
            }
            for (lobe, (sum, share)) in sums.iter().zip(hit.albedo()).enumerate() {
                // C^M differs from front to back, and C^N need not follow it: the product is not normal.
                let near = if lobe < 3 { 0.01 } else { 0.1 };
                assert!((sum / share[0] - 1.0).abs() < near, "{form:?} {h} {lobe}: {sum} {share:?}");
            }
        }
    }
}

/// Physics is reciprocal once the offset is integrated over, and so is a walk; what the table is off by is noise
/// and the distance of its knots.
#[test]
fn scattered_light_is_nearly_reciprocal() {
    let (_, parameters, table) = &SETS[1];
    let fur = FurReference::new(parameters, table.clone()).unwrap();
    let far = |wo: [f64; 3], wi: [f64; 3]| {
        over_offsets(|h| fur.at(wo, h).evaluate_with_pdf(wi).0[4][0]) / wi[1].hypot(wi[2])
    };
    let (mut sum, mut worst, mut count) = (0.0, 0.0_f64, 0.0);
    let thetas = [0.0, 0.3, -0.6, 0.9, -1.2];
    for (i, &theta_o) in thetas.iter().enumerate() {
        for &theta_i in &thetas[i..] {
            for phi in [0.4, 1.2, 2.0, 3.1] {
                let (a, b) = (direction(theta_o, 0.0), direction(theta_i, phi));
                let (there, back) = (far(a, b), far(b, a));
                let error = (there - back).abs() / (0.5 * (there + back));
                sum += error;
                worst = worst.max(error);
                count += 1.0;
            }
        }
    }
    println!("reciprocity: mean {:.3}, worst {worst:.3}", sum / count);
    assert!(sum / count < 0.06 && worst < 0.3, "{} {worst}", sum / count);
}

#[test]
fn tables_survive_as_bytes_and_bad_bytes_are_refused() {
    let (_, parameters, table) = &SETS[0];
    let table = table.as_ref().unwrap();
    let bytes = table.to_bytes();
    assert!(bytes.len() <= 512 * 1024 && table.size() <= 512 * 1024, "{}", bytes.len());
    assert_eq!(&MedullaTable::from_bytes(&bytes).unwrap(), &**table);
    let mut random = Random(5);
    for length in [0, 1, 7, 39, 40, 1000, bytes.len() - 1] {
        assert!(MedullaTable::from_bytes(&bytes[..length]).is_err());
    }
    // A changed byte may give another table, but one that still is a density.
    let mut refused = 0;
    for _ in 0..300 {
        let mut bytes = bytes.clone();
        let place = (random.next() * bytes.len() as f64) as usize;
        bytes[place] ^= 1 << (random.next() * 8.0) as u8;
        let Ok(table) = MedullaTable::from_bytes(&bytes) else {
            refused += 1;
            continue;
        };
        let Ok(fur) = FurBcsdf::new(parameters, Some(Arc::new(table))) else { continue };
        let hit = fur.at(Vec3::Y, 0.3, Absorption::default());
        assert!(hit.sample(random.four()).is_some_and(|sample| sample.values.sum().is_finite()));
    }
    assert!(refused > 30, "{refused}");
}

#[test]
fn a_table_of_another_material_is_refused() {
    let [(_, a, _), (_, b, table)] = &*SETS;
    assert!(FurBcsdf::new(b, table.clone()).is_ok());
    assert!(FurBcsdf::new(a, table.clone()).is_err() && FurBcsdf::new(a, None).is_err());
    let mut wet = *b;
    wet.hair.film = Some(WaterFilm::default());
    assert!(FurBcsdf::new(&wet, table.clone()).is_err());
    let mut flat = *b;
    flat.hair.aspect = 0.8;
    assert!(FurBcsdf::new(&flat, table.clone()).is_err());
}
