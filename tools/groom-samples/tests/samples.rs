//! The committed samples are what the program makes, byte for byte.
#![allow(clippy::unwrap_used, clippy::panic)] // helpers of tests count as tests

use std::path::Path;
use std::process::Command;

use cyhair::HairFile;

/// The commands of `samples/README.md`: every line that starts with `groom-samples`.
fn commands() -> Vec<String> {
    let readme = std::fs::read_to_string(samples().join("README.md")).unwrap();
    readme.lines().filter_map(|line| line.strip_prefix("groom-samples ")).map(str::to_owned).collect()
}

fn samples() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../samples"))
}

fn run(arguments: &[&str], folder: &Path) -> std::process::Output {
    Command::new(env!("CARGO_BIN_EXE_groom-samples")).args(arguments).current_dir(folder).output().unwrap()
}

#[test]
fn the_readme_makes_the_committed_files() {
    let folder = std::env::temp_dir().join(format!("groom-samples-test-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("samples/arrays")).unwrap();
    let commands = commands();
    assert!(commands.len() > 5);
    for command in &commands {
        let arguments: Vec<&str> = command.split_whitespace().collect();
        let output = run(&arguments, &folder);
        assert!(output.status.success(), "{command}: {}", String::from_utf8_lossy(&output.stderr));
        let path = arguments.last().unwrap();
        let made = std::fs::read(folder.join(path)).unwrap();
        let committed = std::fs::read(samples().join("..").join(path)).unwrap();
        assert!(made == committed, "{path} is not what `groom-samples {command}` makes");
    }
    std::fs::remove_dir_all(folder).unwrap();
}

#[test]
fn every_committed_hair_file_is_read_with_no_warning_but_that_of_missing_points() {
    for command in commands().iter().filter(|command| command.ends_with(".hair")) {
        let path = samples().join("..").join(command.split_whitespace().last().unwrap());
        let loaded = HairFile::open(&path).unwrap();
        let expected = usize::from(loaded.file.points.is_none());
        assert_eq!(loaded.warnings.len(), expected, "{}: {:?}", path.display(), loaded.warnings);
    }
}

#[test]
fn wrong_options_end_with_2() {
    let folder = std::env::temp_dir();
    for arguments in
        [&["--style", "bald", "-o", "x.hair"][..], &["--strands", "0", "-o", "x.hair"], &["--points", "3"]]
    {
        let output = run(arguments, &folder);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(!output.stderr.is_empty() && output.stdout.is_empty());
    }
}

#[test]
fn fur_grows_on_a_mesh() {
    let folder = std::env::temp_dir().join(format!("groom-samples-fur-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    assert!(run(&["head", "-o", "head.obj"], &folder).status.success());
    let fur = ["fur", "--mesh", "head.obj", "--strands", "200", "--towards", "0,-1,-0.2", "-o", "fur.hair"];
    let output = run(&fur, &folder);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let file = HairFile::open(folder.join("fur.hair")).unwrap().file;
    assert_eq!((file.header.hair_count, file.header.point_count), (200, 1600));
    // The head is about 20 cm tall, and so is its fur: the mesh's own numbers.
    let points = file.points.unwrap();
    let lowest = points.iter().map(|p| p[1]).fold(f32::INFINITY, f32::min);
    assert!((-0.13..-0.1).contains(&lowest), "{lowest}");
    for wrong in [
        &["fur", "--mesh", "none.obj", "-o", "x.hair"][..],
        &["fur", "--mesh", "head.obj", "--towards", "1,2", "-o", "x.hair"],
    ] {
        assert_eq!(run(wrong, &folder).status.code(), Some(2), "{wrong:?}");
    }
    assert!(!folder.join("x.hair").exists());
    std::fs::remove_dir_all(folder).unwrap();
}
