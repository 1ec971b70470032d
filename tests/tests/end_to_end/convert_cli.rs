//! cyhair-convert as a user runs it.

use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::{Duration, SystemTime};

use end_to_end_tests::{data_file, program, run};
use groom_formats::{Format, ReadOptions, WriteOptions};
use serde_json::Value;

const TEXT: &str = "0 0 0 0.5\n0 0 1 0.25\n0 0.5 2 0.125\n\n1 0 0 0.5\n1 0 1 0.5\n";

struct Folder(tempfile::TempDir);

impl Folder {
    fn new() -> Self {
        let folder = Folder(tempfile::tempdir().unwrap());
        std::fs::write(folder.path("in.txt"), TEXT).unwrap();
        folder
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Runs the program in the folder.
    fn convert(&self, arguments: &[&str]) -> Output {
        Command::new(program("cyhair-convert")).current_dir(self.0.path()).args(arguments).output().unwrap()
    }

    fn good(&self, arguments: &[&str]) -> Output {
        let run = self.convert(arguments);
        assert_eq!(run.status.code(), Some(0), "{arguments:?}: {}", words(&run));
        run
    }

    fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.0.path()).unwrap();
        let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }
}

fn words(run: &Output) -> String {
    String::from_utf8_lossy(&run.stderr).into_owned()
}

fn groom(path: &Path) -> groom::Groom {
    groom_formats::read(path, &ReadOptions::default()).unwrap().groom
}

#[test]
fn text_survives_hair_and_streams() {
    let folder = Folder::new();
    folder.good(&["in.txt", "a.hair"]);
    // HAIR always has a colour and a transparency: white and opaque.
    folder.good(&["a.hair", "b.txt"]);
    let text = std::fs::read_to_string(folder.path("b.txt")).unwrap();
    let white: String =
        TEXT.lines().map(|l| if l.is_empty() { "\n".into() } else { format!("{l} 1 1 1\n") }).collect();
    assert_eq!(text, white);
    let mut child = Command::new(program("cyhair-convert"))
        .args(["-", "-", "--from", "txt", "--to", "hair"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(TEXT.as_bytes()).unwrap();
    let run = child.wait_with_output().unwrap();
    assert_eq!(run.status.code(), Some(0), "{}", words(&run));
    assert_eq!(run.stdout, std::fs::read(folder.path("a.hair")).unwrap());
}

#[test]
fn info_says_what_is_there() {
    let folder = Folder::new();
    folder.good(&["in.txt", "a.hair"]);
    let report: Value = serde_json::from_slice(&folder.good(&["a.hair", "--info", "--json"]).stdout).unwrap();
    assert_eq!(
        (&report["strands"], &report["points"], &report["format"]),
        (&2.into(), &5.into(), &"hair".into())
    );
    assert_eq!(report["strand_points"], serde_json::json!({ "min": 2, "max": 3 }));
    assert_eq!(report["bounds"]["max"], serde_json::json!([1.0, 0.5, 2.0]));
    assert_eq!(report["hair"]["arrays"], serde_json::json!(["segments", "points", "thickness"]));
    assert_eq!(report["up_axis"], "z");
    folder.good(&["in.txt", "thin.hair", "--width", "0.1"]);
    let thin = String::from_utf8(folder.good(&["thin.hair", "--info", "--json"]).stdout).unwrap();
    assert!(thin.contains("\"default_thickness\": 0.1,") && thin.contains("\"max\": 0.05,"), "{thin}");
    assert_eq!(report["bytes"], std::fs::metadata(folder.path("a.hair")).unwrap().len());
    let text = String::from_utf8(folder.good(&["a.hair", "--info"]).stdout).unwrap();
    assert!(text.contains("strands          2\n") && text.contains("thickness"), "{text}");
}

#[test]
fn options_change_the_groom() {
    let folder = Folder::new();
    let edited = |options: &[&str]| {
        folder.good(&[&["in.txt", "out.txt"], options].concat());
        groom(&folder.path("out.txt"))
    };
    assert_eq!(edited(&["--stride", "2"]).strand_count(), 1);
    assert_eq!(edited(&["--max-strands", "1"]).strand_count(), 1);
    assert_eq!(edited(&["--resample", "4"]).point_count(), 8);
    let scaled = edited(&["--scale", "2"]);
    assert_eq!((scaled.positions()[2].to_array(), scaled.radii().get(0, 2)), ([0.0, 1.0, 4.0], 0.25));
    assert_eq!(edited(&["--up", "y"]).positions()[2].to_array(), [0.0, 2.0, -0.5]);
    assert_eq!(edited(&["--width", "3"]).radii().get(1, 4), 1.5);
    assert_eq!(edited(&["--root-width", "2", "--tip-width", "0"]).radii().get(1, 4), 0.0);
    assert_eq!(edited(&["--color", "1,0.5,0"]).colors().unwrap().get(1, 4).to_array(), [1.0, 0.5, 0.0]);
    let ramp = edited(&["--root-color", "0,0,0", "--tip-color", "1,1,1"]);
    assert_eq!(ramp.colors().unwrap().get(1, 4).to_array(), [1.0; 3]);
}

/// A material file or preset says all of the fibre; what no format holds of it is told.
#[test]
fn materials_come_from_files_and_presets() {
    let folder = Folder::new();
    std::fs::write(folder.path("own.yaml"), "preset: human-red\nbeta_m: 0.4\nwet: true\n").unwrap();
    let written = |options: &[&str]| {
        let run = folder.good(&[&["in.txt", "out.usda"], options].concat());
        (std::fs::read_to_string(folder.path("out.usda")).unwrap(), words(&run))
    };
    let (plain, said) = written(&["--material", "melanin:0.5,1"]);
    assert!(!said.contains("left out of the material"), "{said}");
    assert_eq!(written(&["--material", "preset:human-red"]).0, plain);
    let (own, said) = written(&["--material", "file:own.yaml"]);
    assert!(own != plain && said.contains("left out of the material: its film of water\n"), "{said}");
    let rough = written(&["--material", "preset:human-red", "--beta-m", "0.4"]).0;
    assert_eq!(rough, own, "but for the film");
}

#[test]
fn report_as_json_counts_what_was_done() {
    let folder = Folder::new();
    let run = folder.good(&["in.txt", "out.gltf", "--json"]);
    let report: Value = serde_json::from_slice(&run.stdout).unwrap();
    assert!(run.stderr.is_empty(), "{}", words(&run));
    let size = |name| std::fs::metadata(folder.path(name)).unwrap().len();
    assert_eq!(report["output_bytes"], size("out.gltf") + size("out.bin"));
    assert_eq!((&report["input_bytes"], &report["points"]), (&(TEXT.len() as u64).into(), &5.into()));
    assert!(report["seconds"].as_f64().unwrap() >= 0.0);
}

#[test]
fn what_cannot_be_done_exits_with_2_and_leaves_nothing() {
    let folder = Folder::new();
    std::fs::write(folder.path("bad.hair"), b"HAIR but no more").unwrap();
    std::fs::write(folder.path("bad.txt"), "0 0 0 1\n0 x 0 1\n").unwrap();
    std::fs::write(folder.path("bad.yaml"), "melanin: 0.5\nbeta_m: 7\n").unwrap();
    std::fs::write(folder.path("dots.txt"), "0 0 0 1\n").unwrap();
    std::fs::write(folder.path("old.usda"), "old").unwrap();
    std::fs::write(folder.path("hair.bin"), TEXT).unwrap();
    std::fs::create_dir(folder.path("folder.txt")).unwrap();
    let before = folder.names();
    let cases: [(&[&str], &str); 50] = [
        (&["missing.hair", "out.txt"], "missing.hair"),
        (&["bad.hair", "out.txt"], "bad.hair"),
        (&["bad.txt", "out.hair"], "bad.txt: line 2, column 3: found `x`"),
        (&["dots.txt", "old.usda"], "old.usda: usda needs at least one strand of two points"),
        (&["in.txt", "no such folder/out.txt"], "no such folder"),
        (&["in.txt", "out.fbx"], "expected one of hair, txt, usda, usdc"),
        (&["in.txt"], "<OUTPUT>"),
        (&["folder.txt", "out.hair"], "folder.txt: "),
        (&["in.txt", "folder.txt"], "folder.txt: could not replace a folder"),
        (&["in.txt", "out", "--to", "gltf"], "ends with .gltf"),
        (&["hair.bin", "hair.gltf", "--from", "txt"], "hair.bin would be written over the input"),
        (&["old.usda", "out.txt"], "old.usda: "),
        (&["in.pbrt", "out.txt"], "pbrt can be written and not read"),
        (&["in.txt", "out.tfx"], "tfx can be read and not written"),
        (&["in.##.txt", "out.usdc"], "no file of this sequence is there"),
        (&["in.##.txt", "out.txt"], "txt holds no motion"),
        (&["in.txt", "out.txt", "--check"], "--check is for USD"),
        (&["in.txt", "out.usda", "--bake"], "--bake is for USD"),
        (&["in.txt", "out.txt", "--for", "unreal"], "--for is for USD and Alembic, and out.txt is txt"),
        (&["in.txt", "out.ply", "--as-mesh", "tubes"], "--as-mesh is for glTF"),
        (&["in.txt", "out.usda", "--all-attributes"], "--all-attributes is for glTF"),
        (&["in.txt", "out.abc", "--material", "groom"], "--material is for USD and pbrt"),
        (&["in.txt", "out.glb", "--fps", "30"], "--fps is for outputs that move"),
        (&["in.txt", "out.glb", "--frames", "1-3"], "--frames is for outputs that move"),
        (&["in.txt", "out.usda", "--frames", "1-3"], "--frames is for inputs that move"),
        (&["in.txt", "out.usda", "--points-per-strand", "2"], "--points-per-strand is for ply"),
        (&["in.txt", "out.usda", "--curve-error", "1"], "--curve-error is for USD and Alembic"),
        (&["in.txt", "--info", "--time", "3"], "--time is for USD and Alembic, and in.txt is txt"),
        (&["in.txt", "--info", "--fps", "24"], "--fps"),
        (&["in.txt", "out.usda", "--beta-m", "0.2"], "--material"),
        (&["in.txt", "out.usda", "--material", "color:1,1"], "--material"),
        (&["in.txt", "out.usda", "--material", "groom", "--eta", "9"], "9"),
        (&["in.txt", "out.usda", "--material", "preset:human-rd"], "did you mean `human-red`?"),
        (
            &["in.txt", "out.usda", "--material", "file:bad.yaml"],
            "bad.yaml:2:9: beta_m: must lie in [0.001, 1], found 7",
        ),
        (&["in.txt", "out.glb", "--as-mesh", "tubes:2"], "--as-mesh"),
        (&["in.txt", "out.usda", "--for", "paint"], "--for"),
        (&["-", "out.txt"], "--from"),
        (&["in.txt", "-"], "--to"),
        (&["in.txt", "-", "--to", "gltf"], "--to glb"),
        (&["in.txt", "-", "--to", "txt", "--json"], "--json"),
        (&["in.txt", "out.txt", "--to", "hair"], "contradict"),
        (&["in.txt", "out.txt", "--info"], "--info"),
        (&["in.txt", "--info", "--stride", "2"], "--stride"),
        (&["in.txt", "out.glb", "--up", "z"], "--up z"),
        (&["in.txt", "out.txt", "--stride", "0"], "--stride"),
        (&["in.txt", "out.txt", "--scale", "0"], "--scale"),
        (&["in.txt", "out.txt", "--color", "1,1"], "--color"),
        (&["in.txt", "out.txt", "--width", "1", "--root-width", "1", "--tip-width", "1"], "--width"),
        (&["in.txt", "out.txt", "--root-color", "0,0,0"], "--tip-color"),
        (&["in.txt", "out.txt", "--resample", "1"], "--resample"),
    ];
    for (arguments, told) in cases {
        let run = folder.convert(arguments);
        assert_eq!(run.status.code(), Some(2), "{arguments:?}: {}", words(&run));
        assert!(words(&run).contains(told), "{arguments:?}: {}", words(&run));
        assert!(run.stdout.is_empty(), "{arguments:?}");
    }
    assert_eq!(folder.names(), before);
    assert_eq!(std::fs::read(folder.path("old.usda")).unwrap(), b"old");
}

#[test]
fn the_input_may_be_the_output() {
    let folder = Folder::new();
    folder.good(&["in.txt", "in.txt", "--scale", "2"]);
    assert!(std::fs::read_to_string(folder.path("in.txt")).unwrap().starts_with("0 0 0 1\n0 0 2 0.5\n"));
    assert_eq!(folder.names(), ["in.txt"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let folder = Folder::new();
    let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let run = Command::new(program("cyhair-convert"))
        .current_dir(folder.0.path())
        .args(["in.txt", "-", "--to", "hair"])
        .stdout(full)
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(2));
    assert!(words(&run).contains("standard output: No space left"), "{}", words(&run));
}

#[cfg(target_os = "linux")]
#[test]
fn what_a_killed_run_left_is_cleared_away() {
    let folder = Folder::new();
    let days_ago = SystemTime::now() - Duration::from_secs(3 * 24 * 60 * 60);
    for name in [".out.gltf.elsewhere.41.a1.tmp", ".out.bin.elsewhere.41.a1.tmp"] {
        std::fs::write(folder.path(name), "half").unwrap();
        let file = std::fs::File::options().write(true).open(folder.path(name)).unwrap();
        file.set_modified(days_ago).unwrap();
    }
    folder.good(&["in.txt", "out.gltf"]);
    assert_eq!(folder.names(), ["in.txt", "out.bin", "out.gltf"]);
}

#[cfg(unix)]
#[test]
fn a_named_pipe_is_written_to_and_stays_one() {
    use std::os::unix::fs::FileTypeExt;
    let folder = Folder::new();
    let path = folder.path("pipe.txt");
    assert!(Command::new("mkfifo").arg(&path).status().unwrap().success());
    let reader = std::thread::spawn({
        let path = path.clone();
        move || std::fs::read_to_string(path).unwrap()
    });
    folder.good(&["in.txt", "pipe.txt"]);
    assert!(path.metadata().unwrap().file_type().is_fifo());
    assert_eq!(reader.join().unwrap(), TEXT);
}

#[test]
fn repair_says_what_it_did() {
    let folder = Folder::new();
    folder.good(&["in.txt", "a.hair"]);
    let mut bytes = std::fs::read(folder.path("a.hair")).unwrap();
    bytes.extend(b"trailing");
    std::fs::write(folder.path("a.hair"), bytes).unwrap();
    assert!(words(&folder.good(&["a.hair", "b.txt"])).contains("warning: "));
    let told = words(&folder.good(&["a.hair", "b.txt", "--repair"]));
    assert!(told.contains("repaired: ") && !told.contains("warning: "), "{told}");
}

#[test]
fn what_a_format_cannot_hold_is_told() {
    let folder = Folder::new();
    let told = words(&folder.good(&["in.txt", "a.txt", "--meters-per-unit", "0.01", "--up", "y"]));
    assert!(told.contains("0.01 m") && told.contains("which way is up"), "{told}");
    let told = words(&folder.good(&["in.txt", "a.txt", "--stride", "2"]));
    assert!(!told.contains("warning"), "{told}");
}

#[test]
fn a_reader_that_leaves_early_is_no_error() {
    let folder = Folder::new();
    let strand = "0 0 0 1\n0 0 1 1\n\n".repeat(200_000);
    std::fs::write(folder.path("many.txt"), strand).unwrap();
    let mut child = Command::new(program("cyhair-convert"))
        .current_dir(folder.0.path())
        .args(["many.txt", "-", "--to", "txt"])
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = [0; 8];
    let mut stdout = child.stdout.take().unwrap();
    stdout.read_exact(&mut first).unwrap();
    drop(stdout);
    let run = child.wait_with_output().unwrap();
    assert_eq!((run.status.code(), words(&run).as_str(), &first), (Some(0), "", b"0 0 0 1\n"));
}

#[test]
fn formats_are_listed_with_what_they_hold() {
    let listed = run("cyhair-convert", &["--formats", "--json"]);
    let listed: serde_json::Value = serde_json::from_slice(&listed.stdout).unwrap();
    let table = String::from_utf8(run("cyhair-convert", &["--formats"]).stdout).unwrap();
    for format in Format::ALL {
        let entry = listed.as_array().unwrap().iter().find(|entry| entry["name"] == format.name()).unwrap();
        assert_eq!(entry["read"], format.can_read());
        assert_eq!(entry["written"], format.can_write());
        assert!(table.lines().any(|line| line.split_whitespace().next() == Some(format.name())), "{format}");
    }
}

#[test]
fn help_names_defaults_and_groups() {
    let help = String::from_utf8(run("cyhair-convert", &["--help"]).stdout).unwrap();
    for word in ["Reading:", "Strands:", "Look:", "Writing:", "Material", "[default: z", "Exit status: 0"] {
        assert!(help.contains(word), "{word} is not in\n{help}");
    }
}

#[test]
fn the_real_head_survives_every_format_that_is_read() {
    let Some(input) = data_file("hair/straight.hair") else { return };
    let folder = Folder::new();
    let copy = folder.path("copy.hair");
    folder.good(&[input.to_str().unwrap(), "copy.hair"]);
    assert!(std::fs::read(&copy).unwrap() == std::fs::read(&input).unwrap(), "the bytes differ");
    folder.good(&["copy.hair", "copy.txt"]);
    folder.good(&["copy.txt", "back.txt"]);
    let read = |name| std::fs::read(folder.path(name)).unwrap();
    assert!(read("copy.txt") == read("back.txt"), "the text differs");
    let (original, text) = (groom(&input), groom(&folder.path("copy.txt")));
    let bits = |groom: &groom::Groom| {
        groom.positions().iter().flat_map(|p| p.to_array()).map(f32::to_bits).collect::<Vec<_>>()
    };
    assert!(bits(&original) == bits(&text), "positions differ");
    let mut memory = Vec::new();
    groom_formats::write_to(Format::Text, &original, &mut memory, "memory", &WriteOptions::default())
        .unwrap();
    assert!(memory == read("copy.txt"), "the program and the library write different text");
}
