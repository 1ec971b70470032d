//! Every committed pipeline, run small: its frames show what it promises.

use std::collections::BTreeMap;
use std::path::Path;

use end_to_end_tests::{run, workspace};
use exr::prelude::{ReadChannels, ReadLayers};

/// A picture's colours and alpha.
struct Picture {
    width: usize,
    pixels: Vec<[f32; 4]>,
}

impl Picture {
    fn read(path: &Path) -> Picture {
        let image = exr::prelude::read()
            .no_deep_data()
            .largest_resolution_level()
            .rgba_channels(
                |size, _| Picture { width: size.width(), pixels: vec![[0.0; 4]; size.area()] },
                |picture: &mut Picture, at, (r, g, b, a): (f32, f32, f32, f32)| {
                    let place = at.y() * picture.width + at.x();
                    picture.pixels[place] = [r, g, b, a];
                },
            )
            .first_valid_layer()
            .all_attributes()
            .from_file(path)
            .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        image.layer_data.channel_data.pixels
    }

    /// The mean of a channel: 0 red, 1 green, 2 blue, 3 alpha.
    fn mean(&self, channel: usize) -> f32 {
        self.pixels.iter().map(|pixel| pixel[channel]).sum::<f32>() / self.pixels.len() as f32
    }

    /// The mean of a channel over the columns for which `is_in` holds, told as a part of the width.
    fn mean_where(&self, channel: usize, is_in: impl Fn(f32) -> bool) -> f32 {
        let column = |i: usize| ((i % self.width) as f32 + 0.5) / self.width as f32;
        let all: Vec<f32> =
            (0..self.pixels.len()).filter(|&i| is_in(column(i))).map(|i| self.pixels[i][channel]).collect();
        all.iter().sum::<f32>() / all.len() as f32
    }

    /// How far apart two pictures are, as a part of how bright they are.
    fn distance(&self, other: &Picture) -> f32 {
        let pairs = self.pixels.iter().flatten().zip(other.pixels.iter().flatten());
        let (apart, bright) =
            pairs.fold((0.0, 1e-6), |(d, b), (x, y)| (d + (x - y).abs(), b + x.abs() + y.abs()));
        apart / bright
    }

    /// How many pixels are neither empty nor full.
    fn edges(&self) -> usize {
        self.pixels.iter().filter(|pixel| pixel[3] > 0.05 && pixel[3] < 0.95).count()
    }
}

/// Runs a pipeline with these settings; its frames by their paths below `frames/`, without their ending.
fn frames(name: &str, settings: &[&str]) -> BTreeMap<String, Picture> {
    frames_of(name, settings, &[])
}

/// The same with further arguments.
fn frames_of(name: &str, settings: &[&str], more: &[&str]) -> BTreeMap<String, Picture> {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let pipeline = workspace().join("pipelines").join(name).display().to_string();
    let mut arguments = vec!["--out".to_owned(), out.display().to_string(), pipeline];
    for setting in
        ["render.width=32", "render.height=32", "render.spp=2", "render.max_bounces=8"].iter().chain(settings)
    {
        arguments.extend(["--set".to_owned(), (*setting).to_owned()]);
    }
    arguments.extend(more.iter().map(|&word| word.to_owned()));
    let output = run("turntable", &arguments);
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    assert!(
        (out.join("sheet.png").is_file() || !more.is_empty()) && out.join("report.html").is_file(),
        "{name}"
    );
    let mut found = BTreeMap::new();
    gather(&out.join("frames"), "", &mut found);
    for (frame, picture) in &found {
        let alpha = picture.mean(3);
        assert!(alpha > 0.05, "{name} {frame}: alpha is {alpha}: nothing is in the picture");
        assert!(picture.pixels.iter().flatten().all(|value| value.is_finite()), "{name} {frame}");
        assert!(picture.mean(0) > 1e-3, "{name} {frame} is black");
    }
    found
}

fn gather(folder: &Path, below: &str, found: &mut BTreeMap<String, Picture>) {
    for entry in std::fs::read_dir(folder).unwrap().flatten() {
        let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
        if path.is_dir() {
            gather(&path, &format!("{below}{name}/"), found);
        } else if let Some(stem) = name.strip_suffix(".exr").filter(|stem| !stem.starts_with('.')) {
            found.insert(format!("{below}{stem}"), Picture::read(&path));
        }
    }
}

fn names(frames: &BTreeMap<String, Picture>) -> Vec<&str> {
    frames.keys().map(String::as_str).collect()
}

#[test]
fn the_quickstart_goes_round_a_head() {
    let frames = frames("quickstart.yaml", &["turntable.frames=2", "convert=[]"]);
    assert_eq!(names(&frames), ["frame.0001", "frame.0002"]);
    assert!(frames["frame.0001"].distance(&frames["frame.0002"]) > 0.05);
}

#[test]
fn hair_sweeps_show_what_each_parameter_does() {
    // Of fur one: every other has a table of its own to be worked out.
    let looks =
        ["honey", "dark-brown", "beta_n-0.1", "beta_n-0.7", "beta_m-0.1", "beta_m-0.6", "hair", "fur"];
    let only = format!("look={}", looks.join(","));
    let settings = ["groom.sample.strands=300", "attributes.width=0.003"];
    let frames = frames_of("hair-sweeps.yaml", &settings, &["--only", &only]);
    assert_eq!(frames.len(), looks.len(), "{:?}", names(&frames));
    let look = |name: &str| &frames[&format!("{name}/frame.0001")];
    assert!(look("honey").mean(1) > 1.5 * look("dark-brown").mean(1));
    assert!(look("beta_n-0.7").mean(0) > look("beta_n-0.1").mean(0));
    assert!(
        look("hair").distance(look("fur")) > 0.02 && look("beta_m-0.1").distance(look("beta_m-0.6")) > 0.02
    );
    // One groom, one view: the same pixels are covered.
    assert!((look("honey").mean(3) - look("fur").mean(3)).abs() < 0.05);
}

#[test]
fn an_animal_has_fur_all_over() {
    let coat = |strands: &str| {
        // From where it is: fur would be framed wider than skin.
        let place = ["camera.distance=0.9", "camera.target=[0, 0, 0]", "turntable.frames=2"];
        frames("fur-animal.yaml", &[place[0], place[1], place[2], "attributes.width=0.004", strands])
    };
    let (fur, bald) = (coat("groom.sample.strands=800"), coat("groom.sample.strands=1"));
    for frame in names(&fur) {
        assert!(fur[frame].mean(3) > bald[frame].mean(3), "fur stands over the skin");
        assert!(fur[frame].distance(&bald[frame]) > 0.1);
    }
}

#[test]
fn a_head_in_motion_moves_its_hair_and_is_blurred() {
    let settings =
        ["turntable.frames=2", "attributes.max_strands=300", "attributes.width=0.003", "render.spp=16"];
    let frames = frames("head-in-motion.yaml", &settings);
    let frame = |blur: &str, number: u32| &frames[&format!("{blur}/frame.{number:04}")];
    assert_eq!(frames.len(), 4);
    for blur in ["sharp", "blurred"] {
        assert!(frame(blur, 1).distance(frame(blur, 2)) > 0.05, "{blur}: the head moves");
    }
    for number in [1, 2] {
        assert!(frame("sharp", number).distance(frame("blurred", number)) > 0.02, "{number}: blur is seen");
    }
    let edges = |blur: &str| frame(blur, 1).edges() + frame(blur, 2).edges();
    assert!(edges("blurred") > edges("sharp"), "blur softens edges: {} {}", edges("blurred"), edges("sharp"));
}

#[test]
fn a_cornell_box_has_its_colours_on_their_sides() {
    let settings =
        ["turntable.frames=2", "groom.sample.strands=200", "attributes.width=0.004", "render.spp=16"];
    let frames = frames("cornell.yaml", &settings);
    for (name, picture) in &frames {
        assert!(picture.mean(3) > 0.9, "{name}: the room fills the picture");
        let share = |channel: usize, left: bool| {
            picture.mean_where(channel, |x| if left { x < 0.12 } else { x > 0.88 })
        };
        assert!(share(0, true) > 2.0 * share(1, true), "{name}: red is left");
        assert!(share(1, false) > 1.5 * share(0, false), "{name}: green is right");
    }
    assert!(frames["frame.0001"].distance(&frames["frame.0002"]) > 0.02, "the head turns");
}

#[test]
fn grooms_and_lights_make_six_variants() {
    let frames = frames(
        "lights.yaml",
        &["turntable.frames=1", "attributes.max_strands=300", "attributes.width=0.003"],
    );
    let expected = ["curly", "straight", "wavy"]
        .map(|groom| ["key-and-rim", "studio"].map(|light| format!("{groom}/{light}/frame.0001")));
    assert_eq!(names(&frames), expected.iter().flatten().collect::<Vec<_>>());
    let all: Vec<&Picture> = frames.values().collect();
    for (i, picture) in all.iter().enumerate() {
        assert!(all[..i].iter().all(|other| other.distance(picture) > 0.02));
    }
}

#[test]
fn more_quality_is_less_error() {
    let settings =
        ["attributes.max_strands=200", "attributes.width=0.003", "render.width=24", "render.height=24"];
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    let pipeline = workspace().join("pipelines/quality.yaml").display().to_string();
    let mut arguments = vec!["--out".to_owned(), out.display().to_string(), pipeline];
    arguments.extend(settings.iter().flat_map(|setting| ["--set".to_owned(), (*setting).to_owned()]));
    let output = run("turntable", &arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let mut frames = BTreeMap::new();
    gather(&out.join("frames"), "", &mut frames);
    let look = |name: &str| &frames[&format!("{name}/frame.0001")];
    assert!(look("low").distance(look("high")) > look("mid").distance(look("high")));
}
