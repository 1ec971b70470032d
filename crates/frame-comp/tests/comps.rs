//! Passes re-weighed and plates put behind, against sums done by hand.
#![allow(clippy::unwrap_used)]

use frame_comp::{
    Background, CompError, Fit, Meaning, Plate, Weights, behind, residual, reweigh, shown, smaller,
};
use glam::Vec3;
use hair_render::{Aov, Backdrop, Curve, Cutout, Frame, FrameReport, Preview, ToneMapping, tone_map};
use proptest::prelude::*;

fn frame(width: u32, height: u32, passes: Vec<(Aov, Vec<Vec3>)>, alpha: Vec<f32>) -> Frame {
    let sum = |i: usize| passes.iter().map(|(_, pixels)| pixels[i].as_dvec3()).sum::<glam::DVec3>().as_vec3();
    let beauty = (0..(width * height) as usize).map(sum).collect();
    let report = FrameReport::default();
    Frame { width, height, cutout: None, beauty, alpha, passes, report }
}

fn color() -> impl Strategy<Value = Vec3> {
    prop_oneof![
        3 => (0.0f32..2.0, 0.0f32..2.0, 0.0f32..2.0),
        1 => (0.0f32..1e4, 0.0f32..1e-4, 0.0f32..1.0),
        1 => Just((0.0, 0.0, 0.0)),
    ]
    .prop_map(|(r, g, b)| Vec3::new(r, g, b))
}

/// A frame of 3 x 2 pixels with all passes.
fn frames() -> impl Strategy<Value = Frame> {
    let passes = prop::collection::vec(prop::collection::vec(color(), 6), 7);
    (passes, prop::collection::vec(0.0f32..=1.0, 6))
        .prop_map(|(passes, alpha)| frame(3, 2, Aov::ALL.into_iter().zip(passes).collect(), alpha))
}

proptest! {
    #[test]
    fn weights_of_one_change_no_bit(frame in frames()) {
        let ones: Weights = "R=1,tt=1,Background=1".parse().unwrap();
        prop_assert_eq!(&reweigh(&frame, &ones).unwrap(), &frame);
        prop_assert_eq!(&reweigh(&frame, &Weights::default()).unwrap(), &frame);
    }

    #[test]
    fn a_weighed_beauty_is_the_weighed_sum(frame in frames(), factors in prop::collection::vec(0.0f32..3.0, 7)) {
        let mut weights = Weights::default();
        for (pass, factor) in Aov::ALL.into_iter().zip(&factors) {
            weights.set(pass, *factor).unwrap();
        }
        let weighed = reweigh(&frame, &weights).unwrap();
        for (index, pixel) in weighed.beauty.iter().enumerate() {
            let terms = frame.passes.iter().zip(&factors);
            let sum: glam::DVec3 = terms.map(|((_, p), f)| p[index].as_dvec3() * f64::from(*f)).sum();
            let scale = frame.beauty[index].max_element() + sum.max_element() as f32;
            let off = (sum - pixel.as_dvec3()).abs().max_element();
            prop_assert!(off <= 2e-6 * f64::from(scale), "{} off of {}", off, scale);
            prop_assert!(pixel.min_element() >= 0.0);
        }
        // The passes were weighed with it: the result adds up as its source did.
        prop_assert!(residual(&weighed).relative < 1e-5);
        prop_assert_eq!(&weighed.alpha, &frame.alpha);
    }

    #[test]
    fn passes_of_a_sound_frame_leave_nothing(frame in frames()) {
        let residual = residual(&frame);
        prop_assert!(residual.missing.is_empty() && residual.relative < 1e-6, "{:?}", residual);
    }

    #[test]
    fn a_plate_of_one_color_stays_one_in_every_size(
        (w, h) in (1usize..9, 1usize..9),
        (width, height) in (1u32..12, 1u32..12),
        fit in prop_oneof![Just(Fit::Fill), Just(Fit::Stretch)],
    ) {
        let plate = Plate::new(w, h, vec![Vec3::new(0.25, 0.5, 4.0); w * h], Meaning::Light).unwrap();
        let fitted = plate.fitted(width, height, fit);
        prop_assert_eq!(fitted.pixels.len(), (width * height) as usize);
        for pixel in &fitted.pixels {
            prop_assert!((*pixel - Vec3::new(0.25, 0.5, 4.0)).abs().max_element() < 1e-5, "{}", pixel);
        }
        prop_assert!(fitted.bare == 0.0 && (fitted.cut == 0.0 || fit == Fit::Fill));
    }

    #[test]
    fn no_words_break_a_weight_or_a_color(words in any::<String>()) {
        let _ = words.parse::<Weights>();
        let _ = Background::read(&words);
    }
}

#[test]
fn light_in_no_pass_stays() {
    let mut one = frame(1, 1, vec![(Aov::Tt, vec![Vec3::splat(0.5)])], vec![1.0]);
    one.beauty[0] = Vec3::splat(0.75);
    let found = residual(&one);
    assert_eq!((found.missing.len(), found.largest, found.relative), (6, 0.25, 0.25 / 0.75));
    let weights: Weights = "TT=0".parse().unwrap();
    assert_eq!(reweigh(&one, &weights).unwrap().beauty[0], Vec3::splat(0.25));
}

#[test]
fn what_cannot_be_weighed_is_refused_by_name() {
    let one = frame(1, 1, vec![(Aov::R, vec![Vec3::ONE]), (Aov::Tt, vec![Vec3::ONE])], vec![1.0]);
    let error = reweigh(&one, &"TRT=2".parse().unwrap()).unwrap_err();
    assert!(
        matches!(error, CompError::NoSuchPass { pass: "TRT", .. })
            && error.to_string().contains("R, TT")
            && error.to_string().contains("--aovs TRT")
    );
    let cases = [
        ("TT", "no `=`"),
        ("TT=x", "no number"),
        ("TT=-1", "0..=1000"),
        ("TT=nan", "0..=1000"),
        ("TTT=1", "no pass is called `TTT`"),
        ("TT=1,tt=2", "twice"),
        ("beauty=2", "no pass"),
    ];
    for (words, expected) in cases {
        let error = words.parse::<Weights>().unwrap_err().to_string();
        assert!(error.contains(expected), "{words}: {error}");
    }
    assert_eq!("TRT=2, R=0.5".parse::<Weights>().unwrap().to_string(), "R=0.5,TRT=2");
}

fn gradient(width: usize, height: usize) -> Plate {
    let pixels =
        (0..width * height).map(|i| Vec3::new((i % width) as f32, (i / width) as f32, 1.0)).collect();
    Plate::new(width, height, pixels, Meaning::Light).unwrap()
}

#[test]
fn plates_fill_stand_whole_or_stretch() {
    let plate = gradient(4, 2);
    let same = plate.fitted(4, 2, Fit::Fill);
    assert_eq!((same.cut, same.bare, same.pixels[5]), (0.0, 0.0, Vec3::new(1.0, 1.0, 1.0)));
    // Halved: the mean of 2 x 2.
    let half = plate.fitted(2, 1, Fit::Fill);
    assert_eq!(half.pixels, [Vec3::new(0.5, 0.5, 1.0), Vec3::new(2.5, 0.5, 1.0)]);
    // A square frame sees the middle half of it.
    let square = plate.fitted(2, 2, Fit::Fill);
    assert_eq!((square.cut, square.bare), (0.5, 0.0));
    assert_eq!(square.pixels[0], Vec3::new(1.0, 0.0, 1.0));
    // Whole, it leaves the upper and the lower quarter bare.
    let whole = plate.fitted(4, 4, Fit::Whole);
    assert_eq!((whole.cut, whole.bare), (0.0, 0.5));
    assert_eq!((whole.pixels[0], whole.pixels[4]), (Vec3::ZERO, Vec3::new(0.0, 0.0, 1.0)));
    let stretched = plate.fitted(8, 2, Fit::Stretch);
    assert_eq!((stretched.scale, stretched.pixels[7].x), ((2.0, 1.0), 3.0));
}

#[test]
fn backgrounds_are_read_as_they_are_meant() {
    let color = |words: &str| match Background::read(words) {
        Ok(Background::Color(color)) => Some(color),
        _ => None,
    };
    assert_eq!(color("#ffffff"), Some(Vec3::ONE));
    assert!((color("#808080").unwrap().x - 0.215_86).abs() < 1e-5);
    assert_eq!(color("0.1, 2,0"), Some(Vec3::new(0.1, 2.0, 0.0)));
    for words in ["#fff", "#12345g", "#+12345", "1,2", "1,2,-3", "1,2,3,4", "nan,0,0", "no such.png", ""] {
        assert!(Background::read(words).is_err(), "{words}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plate.exr");
    std::fs::write(&path, b"not a picture").unwrap();
    let error = Background::read(&path.to_string_lossy()).unwrap_err().to_string();
    assert!(error.contains("plate.exr") && error.contains("(.png, .jpg, .exr, .hdr)"), "{error}");
}

#[test]
fn a_png_behind_is_seen_as_it_is_and_light_is_exposed_with_the_frame() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plate.png");
    let rgba: Vec<u8> = (0..6).flat_map(|i| [i * 40, 255 - i * 40, 128, 255]).collect();
    Preview { width: 3, height: 2, rgba: rgba.clone() }.write_png(&path).unwrap();
    let background = Background::read(&path.to_string_lossy()).unwrap();
    let empty = frame(3, 2, vec![], vec![0.0; 6]);
    let mut empty = empty;
    empty.beauty = vec![Vec3::ZERO; 6];
    let mapping = ToneMapping { exposure: 2.0, ..Default::default() };
    assert_eq!(shown(&empty, Some(&background), Fit::Fill, &mapping).rgba, rgba);

    let light = Plate::new(1, 1, vec![Vec3::splat(0.1)], Meaning::Light).unwrap();
    let light = Background::Plate(light);
    let clip = ToneMapping { exposure: 1.0, curve: Curve::Clip, backdrop: Backdrop::Transparent };
    let exposed = shown(&empty, Some(&light), Fit::Fill, &clip);
    let alone = frame(1, 1, vec![(Aov::R, vec![Vec3::splat(0.1)])], vec![1.0]);
    assert_eq!(exposed.rgba[..4], tone_map(&alone, &clip).rgba[..4]);

    let half = frame(1, 1, vec![(Aov::R, vec![Vec3::splat(0.25)])], vec![0.5]);
    let over = behind(&half, &light, Fit::Fill);
    assert_eq!((over.beauty[0], over.alpha[0]), (Vec3::splat(0.25 + 0.1 * 0.5), 1.0));
}

#[test]
fn a_smaller_frame_holds_as_much_light_and_still_adds_up() {
    let pixels =
        |k: usize| (0..60).map(|i| Vec3::new((i * k % 7) as f32, (i % 5) as f32, 1.0)).collect::<Vec<_>>();
    let alpha = (0..60).map(|i| (i % 4) as f32 / 3.0).collect();
    let large = frame(10, 6, vec![(Aov::R, pixels(3)), (Aov::Tt, pixels(5))], alpha);
    let small = smaller(&large, 5);
    assert_eq!((small.width, small.height), (5, 3));
    let sum = |frame: &Frame| frame.beauty.iter().sum::<Vec3>();
    assert!((sum(&large) - sum(&small) * 4.0).abs().max_element() < 1e-2);
    assert!(residual(&small).relative < 1e-6);
    assert_eq!(smaller(&large, 10), large);
}

/// Behind a part of a picture lies the same part of the plate, whatever the fit.
#[test]
fn a_crop_gets_its_part_of_the_plate() {
    let plate = Background::Plate(gradient(9, 4));
    let whole = frame(12, 8, vec![], vec![0.0; 96]);
    let mut whole = Frame { beauty: vec![Vec3::ZERO; 96], ..whole };
    whole.alpha.iter_mut().enumerate().for_each(|(i, alpha)| *alpha = (i % 3) as f32 / 2.0);
    let (x, y, width, height) = (3, 2, 7, 5);
    let places: Vec<usize> = (0..width * height).map(|i| (i / width + y) * 12 + i % width + x).collect();
    let cutout = Cutout { x: x as u32, y: y as u32, full_width: 12, full_height: 8 };
    let part = Frame {
        width: width as u32,
        height: height as u32,
        cutout: Some(cutout),
        beauty: vec![Vec3::ZERO; places.len()],
        alpha: places.iter().map(|&at| whole.alpha[at]).collect(),
        ..whole.clone()
    };
    for fit in [Fit::Fill, Fit::Whole, Fit::Stretch] {
        let (all, some) = (behind(&whole, &plate, fit), behind(&part, &plate, fit));
        let expected: Vec<Vec3> = places.iter().map(|&at| all.beauty[at]).collect();
        assert_eq!(some.beauty, expected, "{fit:?}");
        let mapping = ToneMapping::default();
        let (all, some) =
            (shown(&whole, Some(&plate), fit, &mapping), shown(&part, Some(&plate), fit, &mapping));
        let (all, some) = (all.rgba.as_chunks::<4>().0, some.rgba.as_chunks::<4>().0);
        assert!(places.iter().zip(some).all(|(&at, pixel)| all[at] == *pixel), "{fit:?}");
    }
}

/// A photograph that was taken on its side stands upright.
#[test]
fn photographs_are_turned_as_they_were_held() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("plate.jpg");
    let mut jpeg = Vec::new();
    let rgb: Vec<u8> = (0..32 * 16).flat_map(|i| if i % 32 < 16 { [250; 3] } else { [5; 3] }).collect();
    image::codecs::jpeg::JpegEncoder::new(&mut jpeg)
        .encode(&rgb, 32, 16, image::ExtendedColorType::Rgb8)
        .unwrap();
    // Behind the first two bytes: an Exif segment that says orientation 6, to be turned clockwise by a quarter.
    let tiff = [&b"II*\0\x08\0\0\0\x01\0"[..], b"\x12\x01\x03\0\x01\0\0\0\x06\0\0\0", &[0; 4]].concat();
    let exif = [&[0xff, 0xe1, 0, (tiff.len() + 8) as u8][..], b"Exif\0\0", &tiff].concat();
    std::fs::write(&path, [&jpeg[..2], &exif, &jpeg[2..]].concat()).unwrap();
    let plate = Plate::read(&path).unwrap();
    assert_eq!(plate.size(), (16, 32));
    let pixels = plate.fitted(16, 32, Fit::Stretch).pixels;
    assert!(pixels[4 * 16 + 8].x > 0.8 && pixels[28 * 16 + 8].x < 0.1, "white is above");
}
