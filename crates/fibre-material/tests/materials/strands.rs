//! Materials on grooms: what differs, by how much, and what stays.

use std::sync::Arc;

use fibre_material::{ColorTexture, Dressed, HairColor, Material, Picture, Varying};
use fibre_scattering::{absorption_from_color, absorption_from_melanin};
use glam::{Vec2, Vec3};
use groom::{Attribute, Domain, Groom, VAxis, Values, names};

/// `count` strands of three points, the middle one a quarter of the way along.
fn strands(count: u32) -> Groom {
    let points = (0..count).flat_map(|i| [0.0, 1.0, 4.0].map(|y| Vec3::new(i as f32, y, 0.0))).collect();
    Groom::new((0..=count).map(|i| i * 3).collect(), points).unwrap()
}

fn dressed(text: &str, groom: &Groom) -> Dressed {
    Material::from_yaml(text, "a.yaml").unwrap().dress(groom).unwrap_or_else(|e| panic!("{text}: {e}"))
}

/// The cortex's absorption of each strand.
fn by_strand(dressed: &Dressed) -> Vec<Vec3> {
    let Varying::Strand(all) = &dressed.absorption else { panic!("not by strand: {:?}", dressed.parameters) };
    all.iter().map(|absorption| absorption.cortex()).collect()
}

const MANY: u32 = 100_000;

#[test]
fn the_share_of_white_hairs_is_the_one_asked_for() {
    let groom = strands(MANY);
    for share in [0.01_f64, 0.15, 0.5, 0.9] {
        for seed in [0, 1, 99] {
            let text = format!("melanin: 0.6\nvariation: {{white: {share}, seed: {seed}}}");
            let all = by_strand(&dressed(&text, &groom));
            let white = all.iter().filter(|&&sigma| sigma == Vec3::ZERO).count() as f64;
            let sigma = (f64::from(MANY) * share * (1.0 - share)).sqrt();
            assert!((white - f64::from(MANY) * share).abs() < 4.0 * sigma, "{share} {seed}: {white}");
        }
    }
    // None and all are exact.
    let one = |share| dressed(&format!("melanin: 0.6\nvariation: {{white: {share}}}"), &groom).absorption;
    let Varying::Constant(white) = one(1) else { panic!("all are white") };
    assert_eq!(white.cortex(), Vec3::ZERO);
    assert!(matches!(one(0), Varying::Constant(dark) if dark.cortex().x > 0.0));
}

#[test]
fn a_strand_keeps_its_lot_in_any_company() {
    let text = "melanin: 0.5\nredness: 0.4\n\
                variation: {pigment: 0.5, redness: 0.2, white: 0.2, roughness: 0.3, seed: 5}";
    let mut groom = strands(500);
    let ids = Values::Int((0..500).map(|i| (i * 7919) % 1009).collect());
    groom.set_attribute(names::ID, Attribute { domain: Domain::Strand, values: ids }).unwrap();
    let all = dressed(text, &groom);
    let (sigmas, betas) = (by_strand(&all), all.roughness.as_ref().unwrap());
    let few = groom.subsample_by_stride(3).unwrap();
    let part = dressed(text, &few);
    let (few_sigmas, few_betas) = (by_strand(&part), part.roughness.as_ref().unwrap());
    assert_eq!(few_sigmas.len(), few.strand_count());
    for strand in 0..few.strand_count() {
        let same = (0..500).find(|&s| groom.strand_id(s) == few.strand_id(strand)).unwrap();
        assert_eq!((few_sigmas[strand], few_betas[strand]), (sigmas[same], betas[same]));
    }
    // Another seed is another head of hair.
    let other = dressed(&text.replace("seed: 5", "seed: 6"), &groom);
    let same = by_strand(&other).iter().zip(&sigmas).filter(|(a, b)| a == b).count();
    assert!(same < 60, "{same}");
}

/// Mean and its standard error over the strands.
fn mean(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let count = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / count;
    let variance = values.map(|v| (v - mean) * (v - mean)).sum::<f64>() / (count - 1.0);
    (mean, (variance / count).sqrt())
}

#[test]
fn means_are_kept() {
    let groom = strands(MANY);
    let plain = Material::from_yaml("color: [0.5, 0.3, 0.2]", "").unwrap().constant().unwrap().hair;
    for text in ["color: [0.5, 0.3, 0.2]", "groom: {color: [0.5, 0.3, 0.2]}"] {
        let all = by_strand(&dressed(&format!("{text}\nvariation: {{pigment: 0.8}}"), &groom));
        for channel in 0..3 {
            let (found, error) = mean(all.iter().map(|sigma| f64::from(sigma[channel])));
            let expected = f64::from(plain.sigma_a[channel]);
            assert!((found - expected).abs() < 4.0 * error, "{found} {expected} {error}");
            // Evenly spread over 1 - 0.8 .. 1 + 0.8 times the mean.
            let (low, high) =
                all.iter().fold((f32::MAX, 0.0_f32), |(l, h), s| (l.min(s[channel]), h.max(s[channel])));
            assert!((low / plain.sigma_a[channel] - 0.2).abs() < 1e-3);
            assert!((high / plain.sigma_a[channel] - 1.8).abs() < 1e-3);
        }
    }
    // Melanin's concentration keeps its mean (its absorption, which is not proportional, does not).
    let all = by_strand(&dressed("melanin: 0.4\nvariation: {pigment: 1}", &groom));
    let unit = f64::from(absorption_from_melanin(1.0 - (-1.0_f32).exp(), 0.0).unwrap().x);
    let concentrations = all.iter().map(|sigma| 1.0 - (-f64::from(sigma.x) / unit).exp());
    let (found, error) = mean(concentrations);
    assert!((found - 0.4).abs() < 4.0 * error, "{found} {error}");
    let all = dressed("beta_m: 0.4\nvariation: {roughness: 0.5}", &groom).roughness.unwrap();
    let (found, error) = mean(all.iter().map(|beta| f64::from(beta[0])));
    assert!((found - 0.4).abs() < 4.0 * error, "{found} {error}");
    assert!(all.iter().all(|[m, n]| (m / 0.4 - n / 0.3).abs() < 1e-5), "both move together");
}

#[test]
fn colour_is_kept_where_roughness_varies() {
    let color = Vec3::new(0.5, 0.3, 0.2);
    let all = dressed("color: [0.5, 0.3, 0.2]\nvariation: {roughness: 0.5}", &strands(50));
    for (sigma, [_, beta_n]) in by_strand(&all).into_iter().zip(all.roughness.as_ref().unwrap()) {
        assert_eq!(sigma, absorption_from_color(color, *beta_n).unwrap());
    }
    // Pigment is pigment whatever the roughness.
    let melanin = dressed("melanin: 0.5\nvariation: {roughness: 0.5}", &strands(50));
    assert!(matches!(melanin.absorption, Varying::Constant(_)) && melanin.roughness.is_some());
}

#[test]
fn gradients_have_their_ends() {
    let groom = strands(2);
    let plain = absorption_from_melanin(0.5, 0.0).unwrap();
    let all = dressed("melanin: 0.5\nalong: {absorption: [[0, 2], [1, 0]]}", &groom);
    let Varying::Vertex(values) = &all.absorption else { panic!("not by vertex") };
    let sigmas: Vec<Vec3> = values.iter().map(|a| a.cortex()).collect();
    assert_eq!((sigmas[0], sigmas[2]), (2.0 * plain, Vec3::ZERO));
    assert!((sigmas[1] - 1.5 * plain).abs().max_element() < 1e-6, "by length, not by index");
    let all = dressed("melanin: 0.5\nalong: {melanin: [[0, 0.5], [1, 3]]}", &groom);
    let Varying::Vertex(values) = &all.absorption else { panic!("not by vertex") };
    assert_eq!(values[3].cortex(), absorption_from_melanin(0.25, 0.0).unwrap());
    assert_eq!(values[5].cortex(), absorption_from_melanin(1.0, 0.0).unwrap(), "held to 1");
    let all = dressed("color_ramp: [[0, [0.1, 0.1, 0.1]], [1, [0.9, 0.8, 0.7]]]", &groom);
    let Varying::Vertex(values) = &all.absorption else { panic!("not by vertex") };
    assert_eq!(values[0].cortex(), absorption_from_color(Vec3::splat(0.1), 0.3).unwrap());
    assert_eq!(values[2].cortex(), absorption_from_color(Vec3::new(0.9, 0.8, 0.7), 0.3).unwrap());
    // What does not change along is not held by vertex.
    let level = dressed("melanin: 0.5\nalong: {absorption: [[0, 2]]}", &groom);
    assert!(matches!(level.absorption, Varying::Constant(a) if a.cortex() == 2.0 * plain));
}

#[test]
fn the_grooms_own_colour_and_melanin() {
    let mut groom = strands(3);
    let colors = [0.2, 0.4, 0.6].map(Vec3::splat);
    let set = |groom: &mut Groom, name, domain, values| {
        groom.set_attribute(name, Attribute { domain, values }).unwrap();
    };
    assert!(matches!(dressed("", &groom).absorption, Varying::Constant(_)));
    set(&mut groom, names::COLOR, Domain::Strand, Values::Vec3(colors.to_vec()));
    let expected = colors.map(|color| absorption_from_color(color, 0.3).unwrap());
    assert_eq!(by_strand(&dressed("", &groom)), expected);
    // Any other colour is above the groom's.
    assert!(matches!(dressed("melanin: 0.3", &groom).absorption, Varying::Constant(_)));
    set(&mut groom, names::MELANIN, Domain::Strand, Values::Float(vec![0.1, 0.5, 0.9]));
    set(&mut groom, names::REDNESS, Domain::Groom, Values::Float(vec![0.25]));
    let expected = [0.1, 0.5, 0.9].map(|m| absorption_from_melanin(m, 0.25).unwrap());
    assert_eq!(by_strand(&dressed("groom: {melanin: 1}", &groom)), expected);
    // A colour that is none is refused with its strand.
    set(&mut groom, names::COLOR, Domain::Strand, Values::Vec3(vec![Vec3::ONE, Vec3::splat(3.0), Vec3::ONE]));
    let told = Material::default().dress(&groom).unwrap_err().to_string();
    assert!(told.starts_with("the colour of strand 1 is [3, 3, 3]"), "{told}");
}

#[test]
fn colours_from_a_picture_at_the_root() {
    let picture = Picture::new(2, vec![Vec3::splat(0.25), Vec3::splat(0.75)]).unwrap();
    let texture = ColorTexture { file: "fur.png".into(), v_axis: VAxis::Up, picture: Arc::new(picture) };
    let material = Material { color: HairColor::Texture(texture), ..Material::default() };
    let mut groom = strands(2);
    let told = material.dress(&groom).unwrap_err().to_string();
    assert!(told.contains("root_uv"), "{told}");
    let values = Values::Vec2(vec![Vec2::new(0.25, 0.5), Vec2::new(0.75, 0.5)]);
    groom.set_attribute(names::ROOT_UV, Attribute { domain: Domain::Strand, values }).unwrap();
    let expected = [0.25, 0.75].map(|grey| absorption_from_color(Vec3::splat(grey), 0.3).unwrap());
    assert_eq!(by_strand(&material.dress(&groom).unwrap()), expected);
    // Without a groom, its mean.
    let mean = absorption_from_color(Vec3::splat(0.5), 0.3).unwrap();
    assert_eq!(material.constant().unwrap().hair.sigma_a, mean);
}

#[test]
fn the_medulla_goes_with_its_strand() {
    let groom = strands(200);
    let varied = "color: [0.5, 0.3, 0.2]\nvariation: {pigment: 0.5, white: 0.3}\n";
    let all = dressed(&format!("{varied}medulla: {{kappa: 0.5, sigma_a: [0.1, 0.2, 0.4]}}"), &groom);
    let Varying::Strand(values) = &all.absorption else { panic!("not by strand") };
    let own = Vec3::new(0.1, 0.2, 0.4);
    let plain = absorption_from_color(Vec3::new(0.5, 0.3, 0.2), 0.3).unwrap();
    for absorption in values {
        let factor = absorption.cortex().x / plain.x;
        assert!((absorption.medulla() - factor * own).abs().max_element() < 1e-5);
    }
    let all = dressed(&format!("{varied}fur: {{medulla_index: 0.8}}"), &groom);
    let Varying::Strand(values) = &all.absorption else { panic!("not by strand") };
    assert!(values.iter().all(|a| a.medulla() == a.cortex()));
}

#[test]
fn hues_and_values_vary_colours() {
    let all = by_strand(&dressed("color: [0.6, 0.3, 0.2]\nvariation: {hue: 30, value: 0.2}", &strands(300)));
    let back = |sigma| fibre_scattering::color_from_absorption(sigma, 0.3).unwrap();
    for color in all.into_iter().map(back) {
        let (high, low) = (color.max_element(), color.min_element());
        assert!((0.479..0.721).contains(&high) && (high / low - 3.0).abs() < 1e-3, "{color}");
        assert!(color.x == high || color.y < 0.72, "{color}");
    }
}

#[test]
fn nothing_varies_where_nothing_is_said_to() {
    for preset in ["default", "human-brown", "thesis-fur", "human-blond-wet"] {
        let dressed = Material::preset(preset).unwrap().dress(&strands(10)).unwrap();
        assert!(
            matches!(dressed.absorption, Varying::Constant(_)) && dressed.roughness.is_none(),
            "{preset}"
        );
        let constant = Material::preset(preset).unwrap().constant().unwrap();
        assert_eq!(dressed.parameters, constant, "{preset}");
    }
}

#[test]
fn grooms_without_strands_are_dressed() {
    let empty = Groom::new(vec![0], vec![]).unwrap();
    for text in ["", "melanin: 0.5\nvariation: {white: 0.5}", "along: {absorption: [[0, 1], [1, 2]]}"] {
        dressed(text, &empty);
    }
}
