//! What the options of cyhair-convert do to a groom, found by reading its output back.

use std::path::PathBuf;
use std::process::{Command, Output};

use end_to_end_tests::program;
use glam::{DVec3, Vec3};
use groom::{Groom, random};
use groom_formats::{ReadOptions, WriteOptions};
use serde_json::Value;

struct Folder(tempfile::TempDir);

impl Folder {
    /// A folder with 120 wavy strands of 30 points in `in.txt`, 6 to 12 long, roots on z = 0.
    fn new() -> Self {
        let folder = Folder(tempfile::tempdir().unwrap());
        groom_formats::write(&wavy(), &folder.path("in.txt"), &WriteOptions::default()).unwrap();
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn convert(&self, arguments: &[&str]) -> Output {
        Command::new(program("cyhair-convert")).current_dir(self.0.path()).args(arguments).output().unwrap()
    }

    /// What `in.txt` becomes with these options, as the file `name`.
    fn write(&self, name: &str, options: &[&str]) {
        let run = self.convert(&[&["in.txt", name], options].concat());
        assert_eq!(run.status.code(), Some(0), "{options:?}: {}", words(&run));
    }

    /// What `in.txt` becomes with these options, by way of text, which keeps every bit of the points.
    fn edit(&self, options: &[&str]) -> Groom {
        self.write("out.txt", options);
        self.read("out.txt")
    }

    fn read(&self, name: &str) -> Groom {
        groom_formats::read(&self.path(name), &ReadOptions::default()).unwrap().groom
    }

    /// The numbers of a primvar, from USD's text.
    fn primvar(&self, name: &str, options: &[&str]) -> Vec<f64> {
        self.write("out.usda", options);
        let text = std::fs::read_to_string(self.path("out.usda")).unwrap();
        let (_, after) = text.split_once(&format!("primvars:{name} = [")).unwrap();
        let (list, _) = after.split_once(']').unwrap();
        let numbers = list.split([',', '(', ')']).map(str::trim).filter(|word| !word.is_empty());
        numbers.map(|number| number.parse().unwrap()).collect()
    }

    /// What is said when these options cannot be done.
    fn refused(&self, options: &[&str]) -> String {
        let run = self.convert(&[&["in.txt", "refused.txt"], options].concat());
        assert_eq!(run.status.code(), Some(2), "{options:?}: {}", words(&run));
        assert!(!self.path("refused.txt").exists());
        words(&run)
    }
}

fn words(run: &Output) -> String {
    String::from_utf8_lossy(&run.stderr).into_owned()
}

fn wavy() -> Groom {
    let (mut offsets, mut points) = (vec![0], Vec::new());
    for id in 0..120 {
        let number = |what| random(2, id, what);
        let root = Vec3::new(number("x") * 20.0, number("y") * 20.0, 0.0);
        let (wave, height) = (number("wave"), 6.0 + 4.0 * number("height"));
        for i in 0..30 {
            let t = i as f32 / 29.0;
            points
                .push(root + Vec3::new(wave * (t * 14.0).sin(), wave * (t * 11.0).cos() - wave, t * height));
        }
        offsets.push(points.len() as u32);
    }
    let mut groom = Groom::new(offsets, points).unwrap();
    groom.up_axis = groom::UpAxis::Z;
    groom.set_width(0.02).unwrap();
    groom
}

fn length(strand: &[Vec3]) -> f64 {
    strand.windows(2).map(|pair| pair[0].as_dvec3().distance(pair[1].as_dvec3())).sum()
}

/// The distance from a point to a polyline, found by halving each segment time and again.
fn distance(point: DVec3, line: &[Vec3]) -> f64 {
    let to_segment = |pair: &[Vec3]| {
        let (mut a, mut b) = (pair[0].as_dvec3(), pair[1].as_dvec3());
        for _ in 0..60 {
            let middle = (a + b) * 0.5;
            if a.distance(point) < b.distance(point) { b = middle } else { a = middle }
        }
        a.distance(point)
    };
    line.windows(2).map(to_segment).fold(f64::INFINITY, f64::min)
}

#[test]
fn simplified_strands_stay_within_the_tolerance() {
    let folder = Folder::new();
    let before = folder.read("in.txt");
    let mut counts = vec![before.point_count()];
    for tolerance in ["0.001", "0.02", "0.3"] {
        let after = folder.edit(&["--tolerance", tolerance]);
        let bound: f64 = tolerance.parse().unwrap();
        for (old, new) in before.strands().zip(after.strands()) {
            assert_eq!((old.first(), old.last()), (new.first(), new.last()));
            assert!(old.iter().all(|p| distance(p.as_dvec3(), new) <= bound * 1.000_01));
            assert!(new.iter().all(|p| old.contains(p)), "points are kept, not moved");
        }
        counts.push(after.point_count());
    }
    assert!(counts.windows(2).all(|pair| pair[1] < pair[0]), "{counts:?}");
    // The ramp is there before the points go, so that it bends where it should.
    let ramp = ["--width", "2", "--width-ramp", "0:1,0.3:3,1:0", "--tolerance", "0.05"];
    let after = folder.edit(&ramp);
    for strand in 0..after.strand_count() {
        let widest = after.strand_range(strand).map(|v| after.radii().get(strand, v)).fold(0.0, f32::max);
        assert!((2.8..=3.0).contains(&widest), "{widest}");
    }
}

#[test]
fn quantized_points_lie_on_the_grid_as_near_as_told() {
    let folder = Folder::new();
    let before = folder.read("in.txt");
    let run = folder.convert(&["in.txt", "out.txt", "--quantize", "10", "--json"]);
    let report: Value = serde_json::from_slice(&run.stdout).unwrap();
    let after = folder.read("out.txt");
    let points = || before.positions().iter().chain(after.positions());
    let (low, high) = points().fold((Vec3::MAX, Vec3::MIN), |(low, high), p| (low.min(*p), high.max(*p)));
    let step = (high - low).max_element() / 1023.0;
    let pairs = before.positions().iter().zip(after.positions());
    let most = pairs.map(|(a, b)| a.as_dvec3().distance(b.as_dvec3())).fold(0.0, f64::max);
    assert_eq!(report["quantize_error"].as_f64().unwrap(), most);
    assert!(most > 0.0 && most <= f64::from(step) * 0.867, "{most} {step}");
    for point in after.positions() {
        let steps = (*point - low) / step;
        assert!(steps.distance(steps.round()) < 1e-2, "{steps}");
    }
}

#[test]
fn width_ramps_run_along_the_length() {
    let folder = Folder::new();
    let after = folder.edit(&["--width-ramp", "0:1,0.25:3,1:0.5"]);
    for strand in 0..after.strand_count() {
        let points = after.strand(strand);
        for (i, vertex) in after.strand_range(strand).enumerate() {
            let t = length(&points[..=i]) / length(points);
            let factor = if t < 0.25 { 1.0 + t * 8.0 } else { 3.0 - (t - 0.25) / 0.75 * 2.5 };
            let width = f64::from(after.radii().get(strand, vertex)) * 2.0;
            assert!((width - 0.02 * factor).abs() < 1e-6, "{t} {width}");
        }
    }
    let both = folder.edit(&["--width-ramp", "0:1,1:0", "--width", "4"]);
    assert_eq!((both.radii().get(0, 0), both.radii().get(0, 29)), (2.0, 0.0));
}

#[test]
fn colours_come_from_the_picture() {
    let folder = Folder::new();
    // Red runs from 0 to 255 with the columns, green is 255 in the top half, blue a known grey.
    let pixel = |x: u32, y: u32| image::Rgb([x as u8, if y < 8 { 255 } else { 0 }, 188]);
    image::RgbImage::from_fn(256, 16, pixel).save(folder.path("p.png")).unwrap();
    image::Rgb32FImage::from_fn(4, 4, |x, _| image::Rgb([x as f32 * 0.25, 0.5, 9.0]))
        .save(folder.path("p.hdr"))
        .unwrap();
    let linear =
        |coded: f64| if coded <= 0.04045 { coded / 12.92 } else { ((coded + 0.055) / 1.055).powf(2.4) };
    let color = |uv: &str, more: &[&str]| {
        let set = format!("root_uv={uv}");
        let groom = folder.edit(&[&["--set", set.as_str()], more].concat());
        groom.colors().unwrap().get(0, 0)
    };
    for column in [0, 1, 40, 200, 255] {
        let u = (f64::from(column) + 0.5) / 256.0;
        for (v, way, green) in
            [("0.9", "up", 1.0), ("0.9", "down", 0.0), ("0.1", "up", 0.0), ("-1.9", "down", 1.0)]
        {
            let found = color(&format!("{u},{v}"), &["--color-from-texture", "p.png", "--texture-v", way]);
            let expected =
                Vec3::new(linear(f64::from(column) / 255.0) as f32, green, linear(188.0 / 255.0) as f32);
            assert!(found.distance(expected) < 1e-4, "{column} {v} {way}: {found} {expected}");
        }
    }
    let found = color("0.5,0.5", &["--color-from-texture", "p.hdr"]);
    assert!(found.distance(Vec3::new(0.375, 0.5, 1.0)) < 0.01, "between the second and third: {found}");
    // Each strand has its own colour where each has its own place.
    let groom = folder.edit(&["--set", "root_uv=0.5~0.4,0.25", "--color-from-texture", "p.png"]);
    let uvs = folder.primvar("st", &["--set", "root_uv=0.5~0.4,0.25"]);
    for strand in 0..120 {
        let at = uvs[strand * 2] * 256.0 - 0.5;
        let (low, high) = (linear(at.floor() / 255.0), linear(at.ceil() / 255.0));
        let red = f64::from(groom.colors().unwrap().get(strand, strand * 30).x);
        assert!((low - 1e-5..=high + 1e-5).contains(&red), "{low} {red} {high}");
    }
    assert!(folder.refused(&["--color-from-texture", "p.png"]).contains("`root_uv` is not there"));
    std::fs::write(folder.path("bad.png"), b"\x89PNG\r\n\x1a\n and no more").unwrap();
    for (picture, told) in
        [("in.txt", "expected a .png or .hdr"), ("no.png", "no.png: "), ("bad.png", "bad.png: ")]
    {
        let said = folder.refused(&["--set", "root_uv=0,0", "--color-from-texture", picture]);
        assert!(said.contains(told), "{said}");
    }
}

#[test]
fn random_values_belong_to_their_strand() {
    let folder = Folder::new();
    let all = folder.primvar("melanin", &["--melanin", "0.6~0.1", "--seed", "5"]);
    assert_eq!(all.len(), 120);
    assert!(all.iter().all(|v| (0.5..=0.7001).contains(v)));
    let mean = all.iter().sum::<f64>() / 120.0;
    // The deviation of the mean is 0.1 / sqrt(3 * 120) = 0.005.
    assert!((mean - 0.6).abs() < 0.02, "{mean}");
    assert!(all.iter().any(|&v| v < 0.52) && all.iter().any(|&v| v > 0.68));
    let thinned = folder.primvar("melanin", &["--melanin", "0.6~0.1", "--seed", "5", "--stride", "7"]);
    assert_eq!(thinned, all.iter().copied().step_by(7).collect::<Vec<_>>());
    let by_set = folder.primvar("melanin", &["--set", "melanin=0.6~0.1", "--seed", "5", "--reverse"]);
    assert_eq!(by_set, all);
    assert_ne!(folder.primvar("melanin", &["--melanin", "0.6~0.1", "--seed", "6"]), all);
    let widths = folder.edit(&["--set", "width=0.6~0.2"]);
    let widths: Vec<f32> = (0..120).map(|s| widths.radii().get(s, s * 30) * 2.0).collect();
    assert!(widths.iter().all(|w| (0.4..=0.8001).contains(w)) && widths.iter().any(|&w| w > 0.7));
}

#[test]
fn attributes_are_set_with_their_types() {
    let folder = Folder::new();
    assert_eq!(folder.primvar("curl", &["--set", "curl=2.5"]), [2.5]);
    assert_eq!(folder.primvar("wind", &["--set", "wind=1,-2,3"]), [1.0, -2.0, 3.0]);
    assert_eq!(folder.primvar("layer", &["--set", "layer=int:-3"]), [-3.0]);
    assert_eq!(folder.primvar("redness", &["--redness", "0.25", "--set", "a=1"]), [0.25]);
    for (options, told) in [
        (["--set", "curl"], "name=value"),
        (["--set", "a b=1"], "letters, digits and _"),
        (["--set", "curl=1,2,3,4"], "a~b"),
        (["--set", "color=0.5"], "--set color: attribute `color` holds float values, expected vec3"),
        (["--set", "width=0.1~0.2"], "--set width: width is 0.1~0.2, expected 0 or more"),
        (["--melanin", "0.95~0.1"], "--melanin: melanin is 0.95~0.1, expected 0 to 1"),
        (["--width-ramp", "0:2,0:1"], "--width-ramp"),
    ] {
        let said = folder.refused(&options);
        assert!(said.contains(told), "{options:?}: {said}");
    }
}

#[test]
fn grooms_are_moved_as_asked() {
    let folder = Folder::new();
    let before = folder.read("in.txt");
    let check = |options: &[&str], moved: &dyn Fn(Vec3) -> Vec3, width: f32| {
        let after = folder.edit(options);
        for (old, new) in before.positions().iter().zip(after.positions()) {
            assert!(new.distance(moved(*old)) < 1e-4, "{options:?}: {old} {new}");
        }
        assert!((after.radii().get(0, 0) * 2.0 / width - 1.0).abs() < 1e-5, "{options:?}");
    };
    let offset = Vec3::new(-1.0, 2.5, 1e3);
    check(&["--translate", "-1,2.5,1e3"], &|p| p + offset, 0.02);
    check(&["--rotate", "z:90"], &|p| Vec3::new(-p.y, p.x, p.z), 0.02);
    check(&["--rotate", "-1,0,0:90"], &|p| Vec3::new(p.x, p.z, -p.y), 0.02);
    // One after the other, then the move, whatever the order on the line.
    let turned = |p: Vec3| Vec3::new(p.z, p.x, p.y);
    check(
        &["--translate", "-1,2.5,1e3", "--rotate", "z:90", "--rotate", "y:90"],
        &|p| Vec3::new(p.z, p.x, p.y) + offset,
        0.02,
    );
    check(
        &["--matrix", "0,0,2,1, 2,0,0,2, 0,2,0,3, 0,0,0,1"],
        &|p| turned(p) * 2.0 + Vec3::new(1.0, 2.0, 3.0),
        0.04,
    );
    check(&["--matrix", "-1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1"], &|p| p * Vec3::new(-1.0, 1.0, 1.0), 0.02);
    for (options, told) in [
        (vec!["--matrix", "1,0,0,0,0,1,0,0,0,0,1,0,5,0,0,1"], "transpose"),
        (vec!["--matrix", "1,0,0,0,0,1,0,0,0,0,0,0,0,0,0,1"], "inverted"),
        (vec!["--matrix", "1,2,3"], "16 numbers"),
        (vec!["--matrix", "1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1", "--scale", "2"], "--scale"),
        (vec!["--rotate", "90"], "z:90"),
        (vec!["--translate", "1,2"], "three numbers"),
    ] {
        let said = folder.refused(&options);
        assert!(said.contains(told), "{options:?}: {said}");
    }
}

#[test]
fn strands_are_chosen_by_length() {
    let folder = Folder::new();
    let before = folder.read("in.txt");
    let lengths: Vec<f64> = before.strands().map(length).collect();
    let wanted = lengths.iter().filter(|l| (9.0..=11.0).contains(*l)).count();
    let after = folder.edit(&["--min-length", "9", "--max-length", "11"]);
    assert!(wanted > 0 && wanted < 120);
    assert_eq!(after.strand_count(), wanted);
    assert!(after.strands().all(|strand| (9.0..=11.0).contains(&length(strand))));
    // In the output's numbers, and before strands are counted.
    let options = ["--min-length", "90", "--max-length", "110", "--scale", "10", "--max-strands", "5"];
    let few = folder.edit(&options);
    assert_eq!(few.strand_count(), 5);
    assert!(few.strands().all(|strand| (89.99..=110.01).contains(&length(strand))));
    let said = folder.refused(&["--min-length", "1000"]);
    assert!(said.contains("--min-length") && said.contains("no strand"), "{said}");
    assert!(folder.refused(&["--min-length", "3", "--max-length", "2"]).contains("--max-length"));
}

#[test]
fn strands_are_reshaped() {
    let folder = Folder::new();
    let before = folder.read("in.txt");
    let reversed = folder.edit(&["--reverse"]);
    assert!(before.strands().zip(reversed.strands()).all(|(a, b)| a.iter().eq(b.iter().rev())));
    let bend = |groom: &Groom| -> f32 {
        let bends = |w: &[Vec3]| (w[0] - 2.0 * w[1] + w[2]).length();
        groom.strands().flat_map(|strand| strand.windows(3).map(bends)).sum()
    };
    let (little, much) = (folder.edit(&["--smooth", "5:0.5"]), folder.edit(&["--smooth", "50:1"]));
    assert!(bend(&before) > bend(&little) && bend(&little) > 2.0 * bend(&much));
    let ends = |groom: &Groom| groom.strands().map(|s| (s[0], s[29])).collect::<Vec<_>>();
    assert_eq!(ends(&much), ends(&before));
    let kept = folder.edit(&["--smooth", "50:1", "--keep-length"]);
    for ((old, new), short) in before.strands().zip(kept.strands()).zip(much.strands()) {
        assert!((length(old) - length(new)).abs() < 1e-4 && length(short) < length(old));
    }
    let stepped = folder.edit(&["--resample-step", "0.5"]);
    for (old, new) in before.strands().zip(stepped.strands()) {
        assert_eq!(new.len(), (length(old) / 0.5).ceil() as usize + 1);
        assert!(new.windows(2).all(|pair| pair[0].distance(pair[1]) <= 0.5001));
    }
    for (options, told) in [
        (vec!["--smooth", "5:2"], "--smooth"),
        (vec!["--keep-length"], "--smooth"),
        (vec!["--resample-step", "0"], "--resample-step"),
        (vec!["--resample-step", "1", "--resample", "5"], "--resample"),
        (vec!["--tolerance", "-1"], "--tolerance"),
        (vec!["--quantize", "25"], "4..=24"),
    ] {
        assert!(folder.refused(&options).contains(told), "{options:?}");
    }
}

#[test]
fn guides_are_marked_or_kept() {
    let folder = Folder::new();
    let before = folder.read("in.txt");
    let marks = folder.primvar("guide", &["--guides", "12"]);
    assert_eq!((marks.len(), marks.iter().sum::<f64>()), (120, 12.0));
    let closest = folder.primvar("closest_guide", &["--guides", "12", "--closest-guide"]);
    assert!(closest.iter().all(|&guide| marks[guide as usize] == 1.0));
    let kept = folder.edit(&["--guides", "12", "--guides-only"]);
    let marked = before.strands().zip(&marks).filter(|(_, mark)| **mark == 1.0).map(|(strand, _)| strand);
    assert!(kept.strands().eq(marked), "the marked strands are the kept ones");
    assert_ne!(folder.primvar("guide", &["--guides", "12", "--seed", "1"]), marks);
    assert!(folder.refused(&["--guides-only"]).contains("--guides N"));
    assert!(folder.refused(&["--closest-guide"]).contains("--guides"));
}
