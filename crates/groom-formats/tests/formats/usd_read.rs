//! Curves in USD become the strands they stand for.

#![cfg(feature = "usda")]
#![allow(clippy::unwrap_used, clippy::expect_used, missing_docs)]

use std::fmt::Write as _;

use glam::{DVec3, Vec2, Vec3};
use groom::{Attribute, Domain, Groom, UpAxis, Values};
use groom_formats::{Format, FormatError, Loaded, ReadOptions, Warning, read_frames, read_from};
use proptest::prelude::*;

fn read_with(text: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    read_from(Format::Usda, text.as_bytes(), "a.usda", options)
}

fn read(text: &str) -> Loaded {
    read_with(text, &ReadOptions::default()).unwrap()
}

/// A layer with one prim of curves.
fn curves(inside: &str) -> String {
    format!("#usda 1.0\ndef BasisCurves \"C\"\n{{\n{inside}\n}}\n")
}

fn two_lines(more: &str) -> String {
    curves(&format!(
        "uniform token type = \"linear\"\nint[] curveVertexCounts = [2, 3]\n\
         point3f[] points = [(0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (1, 2, 0)]\n{more}"
    ))
}

fn told(text: &str) -> String {
    read_with(text, &ReadOptions::default()).unwrap_err().to_string()
}

#[test]
fn lines_keep_their_bits_and_attributes_their_places() {
    let loaded = read(&two_lines(
        "float[] widths = [0.5, 0.25] (interpolation = \"uniform\")\n\
         color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0)] (interpolation = \"uniform\")\n\
         int[] primvars:displayColor:indices = [1, 0]\n\
         float[] primvars:displayOpacity = [0.25]\n\
         int[] primvars:id = [7, 5] (interpolation = \"uniform\")\n\
         texCoord2f[] primvars:st = [(0.1, 0.2), (0.3, 0.4)] (interpolation = \"uniform\")\n\
         vector3f[] velocities = [(1, 0, 0), (2, 0, 0), (3, 0, 0), (4, 0, 0), (5, 0, 0)]\n\
         float[] primvars:curl = [1, 2, 3, 4, 5] (interpolation = \"varying\")\n\
         string primvars:words = \"not for a groom\"",
    ));
    let groom = &loaded.groom;
    assert_eq!(groom.offsets(), [0, 2, 5]);
    assert_eq!(groom.positions()[4], Vec3::new(1.0, 2.0, 0.0));
    let check = |name: &str, domain, values: Values| {
        assert_eq!(groom.attribute(name), Some(&Attribute { domain, values }), "{name}");
    };
    check("radius", Domain::Strand, Values::Float(vec![0.25, 0.125]));
    check("color", Domain::Strand, Values::Vec3(vec![Vec3::Y, Vec3::X]));
    check("transparency", Domain::Groom, Values::Float(vec![0.75]));
    check("id", Domain::Strand, Values::Int(vec![7, 5]));
    check("root_uv", Domain::Strand, Values::Vec2(vec![Vec2::new(0.1, 0.2), Vec2::new(0.3, 0.4)]));
    check("curl", Domain::Vertex, Values::Float(vec![1.0, 2.0, 3.0, 4.0, 5.0]));
    let velocity = (1..6).map(|x| Vec3::X * x as f32).collect();
    check("velocity", Domain::Vertex, Values::Vec3(velocity));
    assert_eq!((groom.up_axis, groom.meters_per_unit), (UpAxis::Y, 0.01));
    assert!(
        matches!(&loaded.warnings[..], [Warning::AttributeNotRead { name, .. }] if name == "primvars:words")
    );
}

#[test]
fn primvars_widths_win_and_options_win_over_metadata() {
    let text = two_lines("float[] widths = [1, 1, 1, 1, 1]\nfloat[] primvars:widths = [0.5]");
    assert_eq!(read(&text).groom.attribute("radius"), Some(&Attribute::constant_float(0.25)));
    let text = text.replacen("#usda 1.0", "#usda 1.0\n(upAxis = \"Z\"\nmetersPerUnit = 2)", 1);
    let groom = read(&text).groom;
    assert_eq!((groom.up_axis, groom.meters_per_unit), (UpAxis::Z, 2.0));
    let options =
        ReadOptions { up_axis: Some(UpAxis::Y), meters_per_unit: Some(0.5), ..ReadOptions::default() };
    let groom = read_with(&text, &options).unwrap().groom;
    assert_eq!((groom.up_axis, groom.meters_per_unit), (UpAxis::Y, 0.5));
}

#[test]
fn prims_are_moved_and_merged() {
    let line = |points: &str| {
        format!(
            "uniform token type = \"linear\"\nint[] curveVertexCounts = [2]\npoint3f[] points = {points}\nfloat[] widths = [1] (interpolation = \"constant\")\n"
        )
    };
    let a = line("[(0, 0, 0), (1, 0, 0)]");
    let text = format!(
        "#usda 1.0\n\
         class BasisCurves \"K\" {{\n{a}}}\n\
         def Xform \"W\" {{\n\
           float xformOp:rotateZ = 90\ndouble3 xformOp:translate = (0, 0, 5)\nfloat3 xformOp:scale = (2, 2, 2)\n\
           uniform token[] xformOpOrder = [\"xformOp:translate\", \"xformOp:rotateZ\", \"xformOp:scale\"]\n\
           def BasisCurves \"A\" {{\n{a}}}\n\
           def BasisCurves \"B\" {{\n{a}uniform token[] xformOpOrder = [\"!resetXformStack!\"]\n}}\n\
           def BasisCurves \"Off\" (active = false) {{\n{a}}}\n\
           over BasisCurves \"Over\" {{\n{a}}}\n\
           def BasisCurves \"Guide\" {{\n{a}uniform token purpose = \"guide\"\n}}\n\
           def BasisCurves \"Back\" {{\n{a}float3 xformOp:scale = (2, 2, 2)\n\
             uniform token[] xformOpOrder = [\"!invert!xformOp:scale\"]\n}}\n\
         }}\n"
    );
    let groom = read(&text).groom;
    let points: Vec<Vec3> = groom.positions().iter().map(|p| (p * 1e5).round() / 1e5).collect();
    let up = Vec3::new(0.0, 0.0, 5.0);
    assert_eq!(points, [up, up + 2.0 * Vec3::Y, Vec3::ZERO, Vec3::X, up, up + Vec3::Y]);
    let values = |name| &groom.attribute(name).unwrap().values;
    assert_eq!(*values("group"), Values::Int(vec![0, 1, 2]));
    assert_eq!(*values("radius"), Values::Float(vec![1.0, 0.5, 0.5]));
}

#[test]
fn faults_are_named_with_their_prim() {
    let check = |text: &str, expected: &str| assert!(told(text).contains(expected), "{}", told(text));
    check(
        &two_lines("").replace("[2, 3]", "[2, 4]"),
        "a.usda: /C.curveVertexCounts: found counts that add up to 6, expected 5",
    );
    check(&two_lines("").replace("[2, 3]", "[2, -3]"), "-3 points of curve 1");
    check(&two_lines("").replace("linear", "wavy"), "/C.type: found `wavy`, expected linear or cubic");
    check(&two_lines("uniform token wrap = \"on\""), "/C.wrap: found `on`");
    check(
        &two_lines("").replace("(1, 2, 0)", "(1, x, 0)"),
        "/C.points, line 6, column 69: found `x, 0)`, expected a number",
    );
    let text = two_lines("uniform token basis = \"hermite\"").replace("linear", "cubic");
    check(&text, "/C.basis: found `hermite`, expected bezier, bspline or catmullRom");
    let indices = "int[] primvars:x:indices = [0, 9]\nint[] primvars:x = [1] (interpolation = \"uniform\")";
    check(&two_lines(indices), "/C.primvars:x:indices: found index 9");
    check("#usda 1.0\ndef Xform \"A\" {}", "found no BasisCurves prim");
    check(
        "#usda 1.0\ndef Xform \"A\" (references = @b.usda@) {}",
        "composition is not followed; flatten it: tools/usd/bake.py",
    );
    let also = two_lines("").replacen("\"C\"\n", "\"C\" (prepend payload = @b.usda@)\n", 1);
    assert!(read(&also).warnings.contains(&Warning::CompositionNotFollowed { prims: 1 }));
    let many = two_lines("float[] widths = [1, 2, 3]");
    assert!(
        matches!(&read(&many).warnings[..], [Warning::AttributeNotRead { name, .. }, Warning::NoRadius { .. }] if name == "widths")
    );
}

/// A point on a curve of four points by repeated mixing, which is how these curves are defined.
fn on_curve(basis: &str, p: [DVec3; 4], t: f64) -> DVec3 {
    match basis {
        "bezier" => {
            let [a, b, c] = [p[0].lerp(p[1], t), p[1].lerp(p[2], t), p[2].lerp(p[3], t)];
            a.lerp(b, t).lerp(b.lerp(c, t), t)
        }
        // de Boor on the knots -2..3.
        "bspline" => {
            let a = [0, 1, 2].map(|i| p[i].lerp(p[i + 1], (t + 2.0 - i as f64) / 3.0));
            let b = [0, 1].map(|i| a[i].lerp(a[i + 1], (t + 1.0 - i as f64) / 2.0));
            b[0].lerp(b[1], t)
        }
        // Barry and Goldman's pyramid on the knots -1..2.
        _ => {
            let knot = |i: usize| i as f64 - 1.0;
            let a = [0, 1, 2].map(|i| p[i].lerp(p[i + 1], t - knot(i)));
            let b = [0, 1].map(|i| a[i].lerp(a[i + 1], (t - knot(i)) / 2.0));
            b[0].lerp(b[1], t)
        }
    }
}

/// The spans of a curve as fours of points, from UsdGeomBasisCurves' tables.
fn spans(basis: &str, wrap: &str, points: &[DVec3]) -> Vec<[DVec3; 4]> {
    let n = points.len();
    let mut p = points.to_vec();
    let step = if basis == "bezier" { 3 } else { 1 };
    match (wrap, basis) {
        ("periodic", "bezier") => p.push(points[0]),
        ("periodic", _) => p.extend_from_slice(&points[..3]),
        ("pinned", "bspline" | "catmullRom") => {
            p.insert(0, 2.0 * points[0] - points[1]);
            p.push(2.0 * points[n - 1] - points[n - 2]);
        }
        _ => {}
    }
    let fours = p.windows(4).step_by(step);
    fours.map(|four| four.try_into().unwrap()).collect()
}

fn distance(point: DVec3, line: &[Vec3]) -> f64 {
    let segments = line.windows(2).map(|pair| {
        let (a, b) = (pair[0].as_dvec3(), pair[1].as_dvec3());
        let along = b - a;
        let t = if along == DVec3::ZERO {
            0.0
        } else {
            ((point - a).dot(along) / along.length_squared()).clamp(0.0, 1.0)
        };
        point.distance(a + along * t)
    });
    segments.fold(f64::INFINITY, f64::min)
}

fn written(points: &[Vec3]) -> String {
    points.iter().fold(String::new(), |mut text, p| {
        write!(text, "({}, {}, {}), ", p.x, p.y, p.z).unwrap();
        text
    })
}

fn point() -> impl Strategy<Value = Vec3> {
    [-10.0_f32..10.0, -10.0_f32..10.0, -10.0_f32..10.0].prop_map(Vec3::from)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    /// The polyline is as near to the curve as asked, starts and ends where the curve does, and what is given per
    /// point follows it.
    #[test]
    fn cubic_curves_are_sampled_within_the_error(
        basis in prop::sample::select(vec!["bezier", "bspline", "catmullRom"]),
        wrap in prop::sample::select(vec!["nonperiodic", "periodic", "pinned"]),
        all in proptest::collection::vec(point(), 2..5),
        more in proptest::collection::vec(point(), 13),
        count in 1_usize..5,
        error in prop::sample::select(vec![None, Some(1.0_f32), Some(0.01)]),
    ) {
        let count = match (basis, wrap) {
            ("bezier", "periodic") => 3 * count,
            ("bezier", _) => 3 * count + 1,
            _ => count + 3,
        };
        let points: Vec<Vec3> = all.into_iter().chain(more).take(count).collect();
        let text = curves(&format!(
            "uniform token basis = \"{basis}\"\nuniform token wrap = \"{wrap}\"\nint[] curveVertexCounts = [{count}]\n\
             point3f[] points = [{p}]\ncolor3f[] primvars:displayColor = [{p}] (interpolation = \"vertex\")\n",
            p = written(&points),
        ));
        let groom = read_with(&text, &ReadOptions { curve_error: error, ..ReadOptions::default() }).unwrap().groom;
        let wide: Vec<DVec3> = points.iter().map(|p| p.as_dvec3()).collect();
        let spans = spans(basis, wrap, &wide);
        let dense: Vec<DVec3> = spans.iter().flat_map(|&span| (0..=64).map(move |i| on_curve(basis, span, f64::from(i) / 64.0))).collect();
        let length: f64 = dense.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        let bound = error.map_or(1e-3 * length, f64::from) + 1e-5;
        for &point in &dense {
            prop_assert!(distance(point, groom.positions()) <= bound, "{} > {bound}", distance(point, groom.positions()));
        }
        let (first, last) = (dense[0].as_vec3(), dense[dense.len() - 1].as_vec3());
        let strand = groom.strand(0);
        prop_assert!(strand[0].distance(first) < 1e-5 && strand[strand.len() - 1].distance(last) < 1e-5);
        prop_assert_eq!(&groom.attribute("color").unwrap().values, &Values::Vec3(groom.positions().to_vec()));
        if basis != "bspline" && wrap == "nonperiodic" || wrap == "pinned" && basis != "bezier" {
            let lead = usize::from(basis == "catmullRom" && wrap == "nonperiodic");
            prop_assert!(strand[0].distance(points[lead]) < 1e-5);
        }
    }
}

#[test]
fn a_finer_error_makes_more_points_and_straight_curves_few() {
    let points = |curve: &str, error| {
        let text = curves(&format!("int[] curveVertexCounts = [4]\npoint3f[] points = [{curve}]"));
        read_with(&text, &ReadOptions { curve_error: Some(error), ..ReadOptions::default() })
            .unwrap()
            .groom
            .point_count()
    };
    assert_eq!(points("(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0)", 1e-6), 2);
    let bent = "(0, 0, 0), (1, 3, 0), (2, 3, 0), (3, 0, 0)";
    assert_eq!([1.0, 0.1, 0.001, 0.0].map(|error| points(bent, error)), [3, 6, 49, 257]);
}

#[test]
fn varying_values_are_at_the_ends_of_spans() {
    let text = curves(
        "uniform token basis = \"catmullRom\"\nint[] curveVertexCounts = [5]\n\
         point3f[] points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0), (4, 0, 0)]\n\
         float[] widths = [2, 4, 8] (interpolation = \"varying\")",
    );
    let groom = read(&text).groom;
    assert_eq!(groom.positions(), [Vec3::X, 2.0 * Vec3::X, 3.0 * Vec3::X]);
    assert_eq!(groom.attribute("radius").unwrap().values, Values::Float(vec![1.0, 2.0, 4.0]));
}

#[test]
fn a_periodic_line_ends_where_it_starts() {
    let groom = read(&two_lines("uniform token wrap = \"periodic\"\nfloat[] widths = [1, 2, 3, 4, 5]")).groom;
    assert_eq!(groom.offsets(), [0, 3, 7]);
    assert_eq!(groom.positions()[6], Vec3::X);
    assert_eq!(
        groom.attribute("radius").unwrap().values,
        Values::Float(vec![0.5, 1.0, 0.5, 1.5, 2.0, 2.5, 1.5])
    );
}

const MOVING: &str = "point3f[] points.timeSamples = {\n1: [(0, 0, 0), (0, 1, 0), (1, 0, 0), (1, 1, 0), (1, 2, 0)],\n\
    3: [(0, 0, 2), (0, 1, 2), (1, 0, 2), (1, 1, 2), (1, 2, 2)],\n}\n";

#[test]
fn times_are_read_and_linear_between() {
    let text = two_lines(MOVING).replacen("#usda 1.0", "#usda 1.0\n(timeCodesPerSecond = 30)", 1);
    let z = |time| {
        let loaded = read_with(&text, &ReadOptions { time, ..ReadOptions::default() }).unwrap();
        assert_eq!((&loaded.times[..], loaded.frame_rate), (&[1.0, 3.0][..], Some(30.0)));
        loaded.groom.positions()[4].z
    };
    assert_eq!(
        [None, Some(0.0), Some(1.0), Some(1.5), Some(2.0), Some(9.0)].map(z),
        [0.0, 0.0, 0.0, 0.5, 1.0, 2.0]
    );
}

#[test]
fn frames_come_one_by_one_and_keep_their_strands() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.usda");
    let options = ReadOptions::default();
    std::fs::write(&path, two_lines(MOVING)).unwrap();
    let (loaded, frames) = read_frames(&path, &options).unwrap();
    let frames: Vec<_> = frames.map(Result::unwrap).collect();
    assert_eq!(
        frames.iter().map(|frame| (frame.time, frame.positions[0].z)).collect::<Vec<_>>(),
        [(1.0, 0.0), (3.0, 2.0)]
    );
    assert_eq!(loaded.groom.positions(), frames[0].positions);
    let counts = "int[] curveVertexCounts.timeSamples = { 1: [2, 3], 3: [3, 2] }";
    std::fs::write(&path, two_lines(&format!("{MOVING}{counts}"))).unwrap();
    let mut frames = read_frames(&path, &options).unwrap().1;
    assert!(frames.next().unwrap().is_ok());
    let error = frames.next().unwrap().unwrap_err().to_string();
    assert!(error.contains("/C.curveVertexCounts: found 2 curves of 5 points at time 3"), "{error}");
    assert!(frames.next().is_none());
    std::fs::write(&path, two_lines("")).unwrap();
    assert_eq!(read_frames(&path, &options).unwrap().1.count(), 0);
}

/// A groom of three strands with everything.
fn groom() -> Groom {
    let positions: Vec<Vec3> =
        (0..9).map(|i| Vec3::new(i as f32 * 0.37, (i * i) as f32 / 3.0, -0.1)).collect();
    let mut groom = Groom::new(vec![0, 2, 5, 9], positions).unwrap();
    groom.meters_per_unit = 0.00254;
    groom.up_axis = UpAxis::Z;
    let mut set =
        |name: &str, domain, values| groom.set_attribute(name, Attribute { domain, values }).unwrap();
    set("radius", Domain::Vertex, Values::Float((1..10).map(|i| i as f32 / 7.0).collect()));
    set("color", Domain::Strand, Values::Vec3(vec![Vec3::X, Vec3::Y, Vec3::splat(0.3)]));
    set("id", Domain::Strand, Values::Int(vec![5, -6, 7]));
    set("root_uv", Domain::Strand, Values::Vec2(vec![Vec2::new(0.1, 0.7); 3]));
    set("group", Domain::Strand, Values::Int(vec![1, 0, 1]));
    set("curl", Domain::Vertex, Values::Float((0..9).map(|i| i as f32).collect()));
    groom
}

#[cfg(all(feature = "usdc", feature = "usdz"))]
#[test]
fn what_is_written_is_read_back_to_the_bit() {
    use groom_formats::{Frame, MotionOptions, WriteOptions, write, write_animation};
    let folder = tempfile::tempdir().unwrap();
    let groom = groom();
    for ending in ["usda", "usdc", "usdz"] {
        let path = folder.path().join(format!("a.{ending}"));
        write(&groom, &path, &WriteOptions::default()).unwrap();
        let read = groom_formats::read(&path, &ReadOptions::default()).unwrap();
        assert_eq!(read.groom, groom, "{ending}");
        assert_eq!((read.warnings, read.times), (vec![], vec![]));
        let frames: Vec<Frame> = (0..4)
            .map(|frame| {
                let positions = groom.positions().iter().map(|p| p * (1.0 + frame as f32 / 3.0)).collect();
                let velocities = Some(groom.positions().iter().map(|p| p * 8.0).collect());
                Frame { time: 10.0 + f64::from(frame) / 2.0, positions, velocities, ..Frame::default() }
            })
            .collect();
        let mut given = frames.iter().cloned().map(Ok);
        write_animation(&groom, &mut given, &MotionOptions::at_rate(24.0), &path, &WriteOptions::default())
            .unwrap();
        let (loaded, read) = read_frames(&path, &ReadOptions::default()).unwrap();
        assert_eq!(read.map(Result::unwrap).collect::<Vec<_>>(), frames, "{ending}");
        assert_eq!((loaded.times, loaded.frame_rate), (vec![10.0, 10.5, 11.0, 11.5], Some(24.0)));
    }
}

#[test]
fn every_shorter_file_is_refused() {
    let text = two_lines(MOVING);
    let last = text.rfind('}').unwrap();
    for len in 0..last {
        assert!(read_with(&text[..len], &ReadOptions::default()).is_err(), "{len}");
    }
}

#[test]
fn curves_without_an_error_asked_for_stay_within_four_times_their_points() {
    // Loops: a thousandth of their length would be 40 lines a curve.
    let loops = 20_000;
    let text = curves(&format!(
        "int[] curveVertexCounts = [{}]\npoint3f[] points = [{}]\nfloat[] widths = [1] (interpolation = \"constant\")",
        "4, ".repeat(loops),
        "(0, 0, 0), (1, 3, 0), (-1, 3, 0), (0, 0, 0), ".repeat(loops)
    ));
    let loaded = read(&text);
    assert_eq!(loaded.groom.strand_count(), loops);
    assert!(loaded.groom.point_count() <= 16 * loops, "{}", loaded.groom.point_count());
    let [Warning::CurvesCoarser { error }] = loaded.warnings[..] else {
        unreachable!("{:?}", loaded.warnings)
    };
    assert!(error > 1e-3 && error < 0.02, "{error}");
    // What is asked for is kept.
    let asked = ReadOptions { curve_error: Some(0.005), ..ReadOptions::default() };
    let asked = read_with(&text, &asked).unwrap();
    assert!(asked.groom.point_count() > 16 * loops && asked.warnings.is_empty());
}

/// A crate holds equal arrays once: prims with the same points, and the same primvar under many names.
#[cfg(feature = "usdc")]
fn shared(prims: usize, primvars: usize) -> Vec<u8> {
    use usd_layer::write::{Attribute, Content, CrateWriter, Value};
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut layer = CrateWriter::new(&mut bytes).unwrap();
    let points = vec![[1.0, 2.0, 3.0]; 10_000];
    for index in 0..prims {
        let prim = layer.prim(&format!("/C{index}"), "BasisCurves").unwrap();
        let mut set = |name: &str, type_name, interpolation, value: Value<'_>| {
            let content = Content::Value(layer.store(value).unwrap());
            let attribute =
                Attribute { name, type_name, uniform: false, interpolation, element_size: None, content };
            layer.attribute(prim, attribute).unwrap();
        };
        set("type", "token", None, Value::Token("linear"));
        set("curveVertexCounts", "int[]", None, Value::Ints(&[10_000]));
        set("points", "point3f[]", None, Value::Float3s(&points));
        for number in 0..primvars {
            set(&format!("primvars:p{number}"), "float3[]", Some("vertex"), Value::Float3s(&points));
        }
    }
    layer.finish().unwrap();
    bytes.into_inner()
}

#[cfg(feature = "usdc")]
#[test]
fn arrays_that_are_stored_once_are_not_read_without_end() {
    let read = |bytes: &[u8]| read_from(Format::Usdc, bytes, "a.usdc", &ReadOptions::default());
    assert_eq!(read(&shared(3, 1)).unwrap().groom.point_count(), 30_000);
    for (prims, primvars) in [(100, 0), (1, 100)] {
        let bytes = shared(prims, primvars);
        assert!(bytes.len() < 200_000);
        let error = read(&bytes).unwrap_err().to_string();
        assert!(error.contains("no more than four times the file's size"), "{error}");
    }
    // Constants of one prim, one a strand of another.
    let mut text = String::from("#usda 1.0\ndef BasisCurves \"A\"\n{\n");
    for number in 0..100 {
        writeln!(text, "int primvars:p{number} = 7").unwrap();
    }
    let strands = 40_000;
    let points = "(0,0,0),".repeat(strands);
    writeln!(text, "}}\ndef BasisCurves \"B\"\n{{\nuniform token type = \"linear\"").unwrap();
    writeln!(text, "int[] curveVertexCounts = [{}]\npoint3f[] points = [{points}]\n}}", "1,".repeat(strands))
        .unwrap();
    let error = told(&text);
    assert!(error.contains("attribute `p") && error.contains("no more than four times"), "{error}");
}
