//! Frames as a whole: threads, cancelling, files.

use std::sync::atomic::{AtomicU64, Ordering};

use crate::common::*;
use exr::prelude::*;
use glam::Vec3;
use groom::{Attribute, Domain, Values, names};
use hair_render::*;

fn colourful() -> Scene {
    let mut groom = tuft(80, 0.03);
    let colors = (0..groom.point_count()).map(|i| Vec3::new(0.9, 0.2 + 0.5 * (i % 9) as f32 / 9.0, 0.2));
    let attribute = Attribute { domain: Domain::Vertex, values: Values::Vec3(colors.collect()) };
    groom.set_attribute(names::COLOR, attribute).unwrap();
    scene(vec![hair(groom, HairColor::default())], Some(Environment::studio(64).unwrap()), vec![])
}

#[test]
fn the_bits_do_not_depend_on_the_threads() {
    let scene = colourful();
    let frames = [1, 2, 5].map(|threads| {
        let settings = RenderSettings {
            threads: Some(threads),
            width: 45,
            height: 37,
            aovs: AovSet::all(),
            ..settings(1, 5)
        };
        let frame = shoot(&scene, &front(&scene), &settings);
        assert_eq!(frame.report.threads, threads);
        frame
    });
    for frame in &frames[1..] {
        assert!(frame.beauty == frames[0].beauty && frame.alpha == frames[0].alpha);
        assert!(frame.passes == frames[0].passes && frame.report.rel_mse == frames[0].report.rel_mse);
    }
    let other =
        shoot(&scene, &front(&scene), &RenderSettings { seed: 1, width: 45, height: 37, ..settings(1, 5) });
    assert_ne!(other.beauty, frames[0].beauty);
}

struct StopAfter(AtomicU64);

impl Progress for StopAfter {
    fn advance(&self, done: u64, total: u64) {
        assert!(done <= total);
        self.0.fetch_sub(1, Ordering::Relaxed);
    }

    fn cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed) == 0
    }
}

#[test]
fn a_cancelled_render_says_so() {
    let scene = colourful();
    let stop = StopAfter(AtomicU64::new(1));
    let settings = RenderSettings { threads: Some(1), ..settings(64, 2) };
    assert!(matches!(render(&scene, &front(&scene), &settings, &stop), Err(RenderError::Cancelled)));
}

#[test]
fn a_frame_is_read_back_as_it_was_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.exr");
    let scene = colourful();
    let camera = front(&scene);
    let settings = RenderSettings { aovs: AovSet::all(), ..settings(20, 6) };
    let frame = shoot(&scene, &camera, &settings);
    let metadata = Metadata {
        command: "hair-render 長い髪.hair".into(),
        digest: "abc123".into(),
        camera: Some(camera),
        extra: [("groom".to_owned(), "a.hair".to_owned())].into(),
        ..Default::default()
    };
    frame.write_exr(&path, &metadata).unwrap();

    let image = read_first_flat_layer_from_file(&path).unwrap();
    let channel = |name: &str| -> Vec<f32> {
        let found = image.layer_data.channel_data.list.iter().find(|c| c.name == *name).unwrap();
        found.sample_data.values_as_f32().collect()
    };
    for c in 0..3 {
        let name = ["R", "G", "B"][c];
        assert_eq!(channel(name), frame.beauty.iter().map(|b| b[c]).collect::<Vec<_>>());
        for (aov, pixels) in &frame.passes {
            let found = channel(&format!("{}.{name}", aov.name()));
            assert_eq!(found, pixels.iter().map(|p| p[c]).collect::<Vec<_>>());
        }
    }
    assert_eq!(channel("A"), frame.alpha);
    let attributes = &image.layer_data.attributes;
    let other = |key: &str| attributes.other.get(&Text::from(key)).cloned().unwrap();
    assert_eq!(
        other("command"),
        AttributeValue::Text(Text::from_slice_unchecked("hair-render 長い髪.hair".as_bytes()))
    );
    assert_eq!(other("digest"), AttributeValue::Text(Text::from("abc123")));
    assert_eq!(other("groom"), AttributeValue::Text(Text::from("a.hair")));
    assert_eq!(other("seed"), AttributeValue::Text(Text::from("0")));
    assert_eq!(other("spp"), AttributeValue::I32(6));
    assert_eq!(other("seconds"), AttributeValue::F64(frame.report.seconds));
    assert_eq!(other("relativeError"), AttributeValue::F64(frame.report.relative_error.unwrap()));
    assert_eq!(other("colorInteropID"), AttributeValue::Text(Text::from("lin_rec709_scene")));
    assert!(attributes.world_to_camera.is_some() && attributes.world_to_normalized_device.is_some());
    assert!(attributes.software_name.is_some());
    assert!(image.attributes.chromaticities.is_some());

    let (back, header) = Frame::read_exr(&path).unwrap();
    assert_eq!(back, frame);
    assert_eq!(FrameHeader::read(&path).unwrap(), header);
    assert_eq!((header.digest.as_str(), header.spp, header.seed), ("abc123", 6, 0));
    assert_eq!((header.command, header.extra), (metadata.command.clone(), metadata.extra.clone()));
    let matrices = [camera.camera_from_world(), camera.ndc_from_world(1.0)].map(|matrix| matrix.as_mat4());
    assert_eq!(header.matrices, Some(matrices));
    // Written again without a camera, the matrices are those of the file.
    let again = Metadata { matrices: header.matrices, exposure_seconds: Some(0.25), ..Metadata::default() };
    frame.write_exr(&path, &again).unwrap();
    let again = FrameHeader::read(&path).unwrap();
    assert_eq!((again.matrices, again.exposure_seconds), (Some(matrices), Some(0.25)));
    assert_eq!((header.relative_error, header.threads), (frame.report.relative_error, frame.report.threads));

    frame.write_exr(&path, &Metadata { precision: Precision::Half, ..metadata }).unwrap();
    let half = Frame::read_exr(&path).unwrap().0;
    for (found, expected) in half.beauty.iter().zip(&frame.beauty) {
        assert!((*found - *expected).abs().max_element() <= 5e-4 * expected.max_element() + 1e-6);
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "only the finished file is there");
    let missing = folder.path().join("no/such/folder.exr");
    assert!(matches!(frame.write_exr(&missing, &Metadata::default()), Err(RenderError::Io { .. })));
}

/// What no compressor can shorten must come back to the bit, at sizes that fill no block.
#[test]
fn pure_noise_comes_back_to_the_bit() {
    let folder = tempfile::tempdir().unwrap();
    for (width, height) in [(1, 1), (37, 53), (130, 33)] {
        let count = (width * height) as usize;
        let mut state = u64::from(width);
        let mut bits = || loop {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            let value = f32::from_bits((state >> 32) as u32);
            if value.is_finite() {
                return value;
            }
        };
        let mut colors = || (0..count).map(|_| Vec3::new(bits(), bits(), bits())).collect::<Vec<_>>();
        let (beauty, passes) = (colors(), vec![(Aov::Tt, colors()), (Aov::Residual, colors())]);
        let alpha = (0..count).map(|_| bits()).collect();
        let report = shoot(&scene(vec![], None, vec![]), &front(&colourful()), &settings(1, 2)).report;
        let frame = Frame { width, height, cutout: None, beauty, alpha, passes, report };
        let path = folder.path().join("noise.exr");
        frame.write_exr(&path, &Metadata::default()).unwrap();
        let image = read_first_flat_layer_from_file(&path).unwrap();
        let channel = |name: &str| -> Vec<u32> {
            let found = image.layer_data.channel_data.list.iter().find(|c| c.name == *name).unwrap();
            found.sample_data.values_as_f32().map(f32::to_bits).collect()
        };
        let wrote = |pixels: &[Vec3], c: usize| pixels.iter().map(|p| p[c].to_bits()).collect::<Vec<_>>();
        for (c, name) in ["R", "G", "B"].into_iter().enumerate() {
            assert_eq!(channel(name), wrote(&frame.beauty, c));
            for (aov, pixels) in &frame.passes {
                assert_eq!(channel(&format!("{}.{name}", aov.name())), wrote(pixels, c));
            }
        }
        assert_eq!(channel("A"), frame.alpha.iter().map(|a| a.to_bits()).collect::<Vec<_>>());
        let back = Frame::read_exr(&path).unwrap().0;
        assert!(back.beauty == frame.beauty && back.alpha == frame.alpha && back.passes == frame.passes);
    }
}

/// What was blurred says so, and is read back.
#[test]
fn the_motion_of_a_picture_is_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("frame.exr");
    let groom = tuft(20, 0.03);
    let scene = scene(vec![spinning(groom, blond(), 0.4, 3)], Some(white()), vec![]);
    let frame = shoot(&scene, &front(&scene), &settings(9, 3));
    let metadata = Metadata { frame_rate: Some(23.976), exposure_seconds: Some(0.02), ..Metadata::default() };
    frame.write_exr(&path, &metadata).unwrap();
    let (back, header) = Frame::read_exr(&path).unwrap();
    assert!(back.report.motion.is_some());
    assert_eq!(back, frame);
    assert!((header.frame_rate.unwrap() - 23.976).abs() < 1e-3);
}

#[test]
fn settings_out_of_range_are_refused() {
    let scene = colourful();
    for bad in [
        RenderSettings { width: 0, ..Default::default() },
        RenderSettings { spp: 0, ..Default::default() },
        RenderSettings { filter_radius: f32::NAN, ..Default::default() },
        RenderSettings { threads: Some(0), ..Default::default() },
    ] {
        assert!(matches!(render(&scene, &front(&scene), &bad, &Silent), Err(RenderError::Argument { .. })));
    }
    assert!(RenderSettings::default().max_bounces >= 64);
}
