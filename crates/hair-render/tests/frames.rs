//! Frames as a whole: threads, cancelling, files.
#![allow(clippy::unwrap_used)] // also the helpers are test code

mod common;

use std::sync::atomic::{AtomicU64, Ordering};

use common::*;
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
        command: "hair-render a.hair".into(),
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
    assert_eq!(other("command"), AttributeValue::Text(Text::from("hair-render a.hair")));
    assert_eq!(other("digest"), AttributeValue::Text(Text::from("abc123")));
    assert_eq!(other("groom"), AttributeValue::Text(Text::from("a.hair")));
    assert_eq!(other("spp"), AttributeValue::I32(6));
    assert_eq!(other("relativeError"), AttributeValue::F64(frame.report.relative_error.unwrap()));
    assert_eq!(other("colorInteropID"), AttributeValue::Text(Text::from("lin_rec709_scene")));
    assert!(attributes.world_to_camera.is_some() && attributes.software_name.is_some());
    assert!(image.attributes.chromaticities.is_some());

    frame.write_exr(&path, &Metadata { precision: Precision::Half, ..metadata }).unwrap();
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1, "only the finished file is there");
    let missing = folder.path().join("no/such/folder.exr");
    assert!(matches!(frame.write_exr(&missing, &Metadata::default()), Err(RenderError::Io { .. })));
}

#[test]
fn broken_environments_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let good = folder.path().join("good.exr");
    write_studio(&good, 16).unwrap();
    let bytes = std::fs::read(&good).unwrap();
    let path = folder.path().join("bad.exr");
    for length in (0..bytes.len()).step_by(7) {
        std::fs::write(&path, &bytes[..length]).unwrap();
        let message = Environment::open(&path).unwrap_err().to_string();
        assert!(message.contains("bad.exr"), "{message}");
    }
    let hdr = folder.path().join("bad.hdr");
    for content in ["", "#?RADIANCE\n", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 999999999 +X 999999999\n"] {
        std::fs::write(&hdr, content).unwrap();
        assert!(Environment::open(&hdr).is_err(), "{content}");
    }
    assert!(matches!(Environment::open(&folder.path().join("none.hdr")), Err(RenderError::Io { .. })));
    std::fs::write(&hdr, "GIF89a").unwrap();
    assert!(matches!(Environment::open(&hdr), Err(RenderError::UnsupportedPicture { .. })));
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
