//! What groom-formats writes as USD, opened by usd-core: text, crates and packages say the same, bit by bit.

use std::path::{Path, PathBuf};
use std::process::Command;

use end_to_end_tests::{validators, workspace};
use groom::{Attribute, Domain, Groom, UpAxis, Values, names};
use groom_formats::{Dialect, Frame, Look, MotionOptions, WriteOptions, write, write_animation};
use serde_json::{Value, json};

const ENDINGS: [&str; 3] = ["usda", "usdc", "usdz"];
const DIALECTS: [Option<Dialect>; 5] =
    [None, Some(Dialect::Unreal), Some(Dialect::Karma), Some(Dialect::Blender), Some(Dialect::Houdini)];
const FRAMES: usize = 10;
const RATE: f64 = 30.0;

/// Some number, different for every `i`.
fn number(i: usize) -> f32 {
    (i as u32).wrapping_mul(2_654_435_761) as f32 / 2.0_f32.powi(32) - 0.5
}

/// 30 strands of 2 to 9 points with every standard attribute, in every domain there is.
fn groom() -> Groom {
    let offsets: Vec<u32> = std::iter::once(0)
        .chain((0..30).scan(0, |sum, i| {
            *sum += 2 + i * 5 % 8;
            Some(*sum)
        }))
        .collect();
    let points = offsets[30] as usize;
    let triples =
        |scale: f32| (0..points).map(|i| [0, 1, 2].map(|c| scale * number(3 * i + c)).into()).collect();
    let mut groom = Groom::new(offsets, triples(2.0)).unwrap();
    groom.up_axis = UpAxis::Z;
    groom.meters_per_unit = 0.01;
    let mut set =
        |name: &str, domain, values| groom.set_attribute(name, Attribute { domain, values }).unwrap();
    let radii = (0..points).map(|i| 0.01 + number(i).abs() * 0.01).collect();
    set(names::RADIUS, Domain::Vertex, Values::Float(radii));
    set(
        names::COLOR,
        Domain::Strand,
        Values::Vec3((0..30).map(|i| [0.1, number(i).abs(), 0.0].into()).collect()),
    );
    set(names::TRANSPARENCY, Domain::Groom, Values::Float(vec![0.1]));
    set(names::ID, Domain::Strand, Values::Int((0..30).map(|i| i * i - 7).collect()));
    set(names::GROUP, Domain::Strand, Values::Int((0..30).map(|i| i / 10).collect()));
    set(names::GUIDE, Domain::Strand, Values::Int((0..30).map(|i| i32::from(i % 6 == 0)).collect()));
    set(names::ROOT_UV, Domain::Strand, Values::Vec2((0..30).map(|i| [number(i), 0.25].into()).collect()));
    set(names::VELOCITY, Domain::Vertex, Values::Vec3(triples(9.0)));
    set(
        "clump size",
        Domain::Vertex,
        Values::Float((0..points).map(|i| [0.5, -0.0, 1e-30][i % 3]).collect()),
    );
    groom
}

fn look() -> Look {
    Look {
        color: [0.3, 0.15, 0.05],
        absorption: [0.2, 0.5, 1.0],
        beta_m: 0.3,
        beta_n: 0.35,
        roughness: [[0.08, 0.1], [0.02, 0.1], [0.3, 0.1]],
        alpha: 0.035,
        eta: 1.55,
        melanin: Some([0.5, 0.25]),
    }
}

fn frames(groom: &Groom) -> Vec<Frame> {
    let frame = |f: usize| Frame {
        time: 1001.0 + 0.5 * f as f64,
        positions: groom.positions().iter().map(|&p| p * (1.0 + 0.01 * f as f32)).collect(),
        velocities: Some(groom.positions().iter().map(|&p| p * (0.01 * 2.0 * RATE as f32)).collect()),
        accelerations: None,
    };
    (0..FRAMES).map(frame).collect()
}

/// Still and moving grooms in every ending and dialect: groups of files that must say the same.
fn written(folder: &Path) -> Vec<Vec<PathBuf>> {
    let groom = groom();
    let mut groups = Vec::new();
    for (number, dialect) in DIALECTS.into_iter().enumerate() {
        let options = WriteOptions { dialect, look: Some(look()), ..WriteOptions::default() };
        let path = |kind: &str, ending| folder.join(format!("{kind}{number}.{ending}"));
        groups.push(ENDINGS.map(|ending| path("still", ending)).to_vec());
        groups.push(ENDINGS.map(|ending| path("moving", ending)).to_vec());
        for ending in ENDINGS {
            write(&groom, &path("still", ending), &options).unwrap();
            let mut frames = frames(&groom).into_iter().map(Ok);
            write_animation(
                &groom,
                &mut frames,
                &MotionOptions::at_rate(RATE),
                &path("moving", ending),
                &options,
            )
            .unwrap();
        }
    }
    groups
}

fn arrays(python: &Path, files: &[PathBuf]) -> Vec<Value> {
    let script = workspace().join("tests/validators/usd_arrays.py");
    let run = Command::new(python).arg(script).args(files).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    serde_json::from_slice(&run.stdout).unwrap()
}

fn hex<'a>(values: impl IntoIterator<Item = &'a [f32]>) -> String {
    values.into_iter().flatten().map(|v| format!("{:08x}", v.to_bits())).collect()
}

fn strands<'a>(stage: &'a Value, attribute: &str) -> &'a Value {
    &stage["prims"]["/Groom/Strands"]["attributes"][attribute]
}

#[test]
fn every_ending_and_dialect_is_valid_and_says_the_same() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let groups = written(folder.path());
    let files: Vec<PathBuf> = groups.concat();
    let run =
        Command::new(&python).arg(workspace().join("tools/usd/check.py")).args(&files).output().unwrap();
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stdout));
    for (stages, files) in arrays(&python, &files).chunks(ENDINGS.len()).zip(&groups) {
        assert!(stages[1] == stages[0], "{} and its crate differ", files[0].display());
        assert!(stages[2] == stages[0], "{} and its package differ", files[0].display());
    }
}

#[test]
fn usd_core_finds_the_grooms_own_bits_still_and_moving() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let groom = groom();
    let options = WriteOptions::default();
    let (still, moving) = (folder.path().join("still.usdc"), folder.path().join("moving.usdc"));
    write(&groom, &still, &options).unwrap();
    let frames = frames(&groom);
    write_animation(
        &groom,
        &mut frames.clone().into_iter().map(Ok),
        &MotionOptions::at_rate(RATE),
        &moving,
        &options,
    )
    .unwrap();
    let [still, moving] = arrays(&python, &[still, moving]).try_into().unwrap();

    let triples = |values: &[_]| -> String {
        let values: Vec<[f32; 3]> = values.iter().map(|v| <[f32; 3]>::from(*v)).collect();
        hex(values.iter().map(<[f32; 3]>::as_slice))
    };
    let sample = |stage: &Value, attribute: &str| strands(stage, attribute)["samples"][0][1].clone();
    assert_eq!(sample(&still, "points"), triples(groom.positions()));
    let counts: Vec<u32> = groom.strands().map(|points| points.len() as u32).collect();
    let counts: String = counts.iter().map(|count| format!("{count:08x}")).collect();
    assert_eq!(sample(&still, "curveVertexCounts"), counts);
    let values = |name| &groom.attribute(name).unwrap().values;
    let (Values::Float(radii), Values::Vec3(velocities), Values::Float(clumps), Values::Int(ids)) =
        (values(names::RADIUS), values(names::VELOCITY), values("clump size"), values(names::ID))
    else {
        unreachable!()
    };
    let widths: Vec<f32> = radii.iter().map(|r| 2.0 * r).collect();
    assert_eq!(sample(&still, "widths"), hex([&widths[..]]));
    assert_eq!(sample(&still, "velocities"), triples(velocities));
    // Few different values, so packed as a table: -0 must not become 0.
    assert_eq!(sample(&still, "primvars:clump_size"), hex([&clumps[..]]));
    let ids: String = ids.iter().map(|id| format!("{id:08x}")).collect();
    assert_eq!(sample(&still, "primvars:id"), ids);

    let metadata = &moving["metadata"];
    assert_eq!((&metadata["startTimeCode"], &metadata["endTimeCode"]), (&json!(1001.0), &json!(1005.5)));
    assert_eq!((&metadata["timeCodesPerSecond"], &metadata["framesPerSecond"]), (&json!(RATE), &json!(RATE)));
    for name in ["points", "velocities", "extent"] {
        assert_eq!(strands(&moving, name)["samples"].as_array().unwrap().len(), FRAMES, "{name}");
    }
    for (number, frame) in frames.iter().enumerate() {
        let sample = |name| &strands(&moving, name)["samples"][number];
        assert_eq!(sample("points"), &json!([frame.time, triples(&frame.positions)]));
        let velocities = frame.velocities.as_ref().unwrap();
        assert_eq!(sample("velocities"), &json!([frame.time, triples(velocities)]));
    }
    assert_eq!(sample(&moving, "primvars:id"), ids);
}

#[test]
fn dialects_say_what_their_programs_read() {
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let groups = written(folder.path());
    let crates: Vec<PathBuf> = groups.iter().step_by(2).map(|files| files[1].clone()).collect();
    let [plain, unreal, karma, blender, houdini] = arrays(&python, &crates).try_into().unwrap();
    assert_eq!(unreal["prims"]["/Groom"]["schemas"], json!(["GroomAPI"]));
    for (name, kind, interpolation) in [
        ("groom_id", "int[]", "uniform"),
        ("groom_group_id", "int[]", "uniform"),
        ("groom_guide", "int[]", "uniform"),
        ("groom_root_uv", "float2[]", "uniform"),
        ("groom_color", "float3[]", "vertex"),
        ("groom_clump_size", "float[]", "vertex"),
    ] {
        let primvar = strands(&unreal, &format!("primvars:{name}"));
        assert_eq!(
            (&primvar["type"], &primvar["interpolation"]),
            (&json!(kind), &json!(interpolation)),
            "{name}"
        );
    }
    let same = |stage: &Value, name: &str, of: &str| {
        assert_eq!(strands(stage, name)["samples"], strands(&plain, of)["samples"], "{name}");
    };
    same(&unreal, "primvars:groom_id", "primvars:id");
    same(&houdini, "primvars:hairid", "primvars:id");
    same(&houdini, "primvars:width", "widths");
    same(&blender, "primvars:surface_uv_coordinate", "primvars:st");

    let word = |name| strands(&karma, name)["samples"][0][1].clone();
    assert_eq!([word("type"), word("basis"), word("wrap")], ["cubic", "catmullRom", "nonperiodic"]);
    let points = word("points");
    let groom = groom();
    let first = &groom.positions()[..2];
    let phantom: [f32; 3] = (2.0 * first[0] - first[1]).into();
    assert_eq!(points.as_str().unwrap()[..24], hex([&phantom[..]]));
    let more =
        points.as_str().unwrap().len() - strands(&plain, "points")["samples"][0][1].as_str().unwrap().len();
    assert_eq!(more, 2 * 30 * 24, "two points a strand");
}

#[test]
fn every_kind_of_value_comes_back_from_a_crate() {
    use usd_layer::write::{Attribute, Content, CrateWriter, PackageWriter, Value as Held};
    let Some(python) = validators::python() else { return };
    let folder = tempfile::tempdir().unwrap();
    let many: Vec<i32> = (0..5000).map(|i| i * i % 977 - 400 + i32::from(i == 7) * i32::MAX / 2).collect();
    let few: Vec<f32> = (0..5000).map(|i| [0.0, -0.0, 1e-40, f32::INFINITY][i * i % 4]).collect();
    let values: [(&str, &str, Held<'_>, Value); 13] = [
        ("a", "bool", Held::Bool(true), json!(true)),
        ("b", "int", Held::Int(-5), json!(-5)),
        ("c", "float", Held::Float(0.5), json!(0.5)),
        ("d", "double", Held::Double(0.1), json!(0.1)),
        ("e", "token", Held::Token("a word"), json!("a word")),
        ("f", "string", Held::String("words, words"), json!("words, words")),
        ("g", "float2", Held::Float2([1.0, 2.0]), json!(hex([&[1.0, 2.0][..]]))),
        ("h", "int[]", Held::Ints(&many), json!(many.iter().map(|v| format!("{v:08x}")).collect::<String>())),
        ("i", "float[]", Held::Floats(&few), json!(hex([&few[..]]))),
        ("j", "texCoord2f[]", Held::Float2s(&[[0.5, 0.25]]), json!(hex([&[0.5, 0.25][..]]))),
        ("k", "token[]", Held::Tokens(&["x", "y"]), json!(["x", "y"])),
        ("l", "string[]", Held::Strings(&["x", "words"]), json!(["x", "words"])),
        ("m", "float[]", Held::Floats(&[]), json!("")),
    ];
    let fill = |layer: &mut CrateWriter<std::fs::File>| {
        // Children before parents, and a property whose name starts as another one's.
        let child = layer.prim("/Top/Child", "Scope").unwrap();
        let top = layer.prim("/Top", "Xform").unwrap();
        layer.prim("/Top2", "").unwrap();
        for (name, type_name, value, _) in &values {
            let value = Content::Value(layer.store(*value).unwrap());
            layer.attribute(child, Attribute::new(&format!("x:{name}"), type_name, value)).unwrap();
        }
        layer.attribute(top, Attribute::new("x", "int", Content::Connection("/Top/Child.x:b"))).unwrap();
        layer.relationship(top, "to", &["/Top2", "/Top/Child.x:a"]).unwrap();
        layer.metadata("defaultPrim", Held::Token("Top")).unwrap();
    };
    let (alone, packed) = (folder.path().join("a.usdc"), folder.path().join("a.usdz"));
    let mut layer = CrateWriter::new(std::fs::File::create(&alone).unwrap()).unwrap();
    fill(&mut layer);
    layer.finish().unwrap();
    let mut package = PackageWriter::new(std::fs::File::create(&packed).unwrap(), "a.usdc").unwrap();
    fill(package.layer());
    package.finish().unwrap();
    for stage in arrays(&python, &[alone, packed]) {
        let attributes = &stage["prims"]["/Top/Child"]["attributes"];
        for (name, type_name, _, expected) in &values {
            let found = &attributes[format!("x:{name}")];
            assert_eq!((&found["type"], &found["samples"][0][1]), (&json!(type_name), expected), "{name}");
        }
        let top = &stage["prims"]["/Top"];
        assert_eq!(top["attributes"]["x"]["connections"], json!(["/Top/Child.x:b"]));
        assert_eq!(top["relationships"]["to"], json!(["/Top2", "/Top/Child.x:a"]));
        assert_eq!(stage["metadata"]["defaultPrim"], "Top");
    }
}
