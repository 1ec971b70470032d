//! The arrows of ARCHITECTURE.md, held against the manifests.

use std::collections::{BTreeMap, BTreeSet};
use std::process::Command;

use serde_json::Value;

/// Every crate, low to high, with what it may know of the house. A new arrow is added here and in
/// ARCHITECTURE.md, or not at all.
const ARROWS: [(&str, &[&str]); 28] = [
    ("cyhair", &[]),
    ("groom", &[]),
    ("whole-file", &[]),
    ("error-report", &[]),
    ("strict-yaml", &[]),
    ("farm-export", &[]),
    ("fibre-scattering", &[]),
    ("strand-tracing", &[]),
    ("usd-core", &[]),
    ("usd-layer", &[]),
    ("ogawa", &[]),
    ("gltf-bytes", &[]),
    ("video-encode", &["whole-file"]),
    ("flip-page", &["error-report", "whole-file"]),
    ("medulla-tables", &["fibre-scattering", "whole-file"]),
    ("fibre-material", &["fibre-scattering", "groom", "strict-yaml"]),
    ("fibre-verification", &["error-report", "fibre-scattering", "medulla-tables"]),
    ("moving-mesh", &["gltf-bytes", "usd-core", "usd-layer"]),
    ("groom-binding", &["groom", "moving-mesh"]),
    ("groom-samples", &["groom"]),
    ("groom-formats", &["cyhair", "gltf-bytes", "groom", "ogawa", "usd-layer", "whole-file"]),
    (
        "hair-render",
        &[
            "fibre-material",
            "fibre-scattering",
            "groom",
            "medulla-tables",
            "moving-mesh",
            "strand-tracing",
            "whole-file",
        ],
    ),
    ("frame-comp", &["hair-render"]),
    ("moving-scene", &["groom", "groom-binding", "groom-formats", "hair-render", "moving-mesh"]),
    (
        "turntable",
        &[
            "error-report",
            "fibre-material",
            "flip-page",
            "frame-comp",
            "groom",
            "groom-binding",
            "groom-formats",
            "groom-samples",
            "hair-render",
            "moving-mesh",
            "moving-scene",
            "strict-yaml",
            "video-encode",
            "whole-file",
        ],
    ),
    ("look-sweep", &["fibre-material", "fibre-scattering", "groom", "hair-render"]),
    ("command-line", &["whole-file"]),
    ("frame-view", &["command-line", "hair-render"]),
];

/// What a crate must never depend on, whoever wrote it: only programs speak to people.
const PROGRAMS_ONLY: [&str; 4] = ["anyhow", "clap", "ctrlc", "indicatif"];

struct Package {
    name: String,
    is_crate: bool,
    dependencies: BTreeSet<String>,
}

fn packages() -> Vec<Package> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--offline", "--format-version", "1", "--manifest-path"])
        .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let text = |value: &Value| value.as_str().unwrap().to_owned();
    let package = |package: &Value| Package {
        name: text(&package["name"]),
        is_crate: text(&package["manifest_path"]).replace('\\', "/").contains("/crates/"),
        dependencies: package["dependencies"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|dependency| dependency["kind"].is_null()) // tests and benches may look anywhere
            .map(|dependency| text(&dependency["name"]))
            .collect(),
    };
    metadata["packages"].as_array().unwrap().iter().map(package).collect()
}

#[test]
fn arrows_point_down() {
    let allowed: BTreeMap<&str, &[&str]> = ARROWS.into();
    for (i, (name, below)) in ARROWS.iter().enumerate() {
        let lower: Vec<&str> = ARROWS[..i].iter().map(|(name, _)| *name).collect();
        assert!(below.iter().all(|b| lower.contains(b)), "the table itself: {name} knows something above it");
    }
    let packages = packages();
    let house: BTreeSet<&str> = packages.iter().map(|p| p.name.as_str()).collect();
    for package in packages.iter().filter(|p| p.is_crate) {
        let below = allowed.get(package.name.as_str());
        let below = below.unwrap_or_else(|| panic!("crates/{} has no place in the table", package.name));
        for dependency in package.dependencies.iter().filter(|d| house.contains(d.as_str())) {
            assert!(below.contains(&dependency.as_str()), "{} must not know {dependency}", package.name);
        }
    }
    let crates: BTreeSet<&str> = packages.iter().filter(|p| p.is_crate).map(|p| p.name.as_str()).collect();
    assert_eq!(crates, allowed.into_keys().collect(), "the table names the crates that exist");
}

#[test]
fn only_programs_speak_to_people() {
    for package in packages().iter().filter(|p| p.is_crate && p.name != "command-line") {
        for banned in PROGRAMS_ONLY {
            assert!(
                !package.dependencies.contains(banned),
                "{} is a library and uses {banned}",
                package.name
            );
        }
    }
}

#[test]
fn unsafe_is_forbidden_but_for_the_memory_map() {
    for entry in glob_manifests() {
        let (path, text) = entry;
        let inherits = text.contains("[lints]\nworkspace = true");
        assert!(inherits || path.ends_with("crates/cyhair/Cargo.toml"), "{path} does not inherit the lints");
    }
}

fn glob_manifests() -> Vec<(String, String)> {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let mut manifests = vec![format!("{root}/tests/Cargo.toml")];
    for folder in ["crates", "tools"] {
        let entries = std::fs::read_dir(format!("{root}/{folder}")).unwrap();
        let paths = entries.map(|e| e.unwrap().path().join("Cargo.toml"));
        manifests.extend(paths.filter(|p| p.exists()).map(|p| p.to_string_lossy().into_owned()));
    }
    manifests.into_iter().map(|path| (path.clone(), std::fs::read_to_string(path).unwrap())).collect()
}

/// What a build that reads and writes only HAIR and text compiles, beside what those crates need themselves.
const HAIR_AND_TEXT: [&str; 6] = ["bytemuck", "cyhair", "glam", "groom", "whole-file", "zmij"];

/// What only other formats need.
const OTHER_FORMATS: [&str; 12] = [
    "base64",
    "blake3",
    "crc32fast",
    "gltf",
    "gltf-bytes",
    "half",
    "image",
    "lz4_flex",
    "ogawa",
    "serde_json",
    "usd-core",
    "usd-layer",
];

#[test]
fn a_build_with_hair_and_text_compiles_nothing_else() {
    let library = compiled_for_hair_and_text("groom-formats");
    for needed in HAIR_AND_TEXT {
        assert!(library.contains(needed), "{needed} is not in the tree; is this test still right?");
    }
    for other in OTHER_FORMATS {
        assert!(!library.contains(other), "groom-formats compiles {other} for HAIR and text alone");
    }
    let program = compiled_for_hair_and_text("cyhair-convert");
    for other in ["gltf", "gltf-bytes", "lz4_flex", "ogawa", "usd-layer"] {
        assert!(!program.contains(other), "cyhair-convert compiles {other} for HAIR and text alone");
    }
}

/// Every crate that is compiled for `package` when it has those two formats only.
fn compiled_for_hair_and_text(package: &str) -> BTreeSet<String> {
    let output = Command::new(env!("CARGO"))
        .args(["tree", "--offline", "--edges", "normal,build", "--prefix", "none", "--format", "{p}"])
        .args(["--package", package, "--no-default-features", "--features", "hair,text"])
        .arg("--manifest-path")
        .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/../Cargo.toml"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let tree = String::from_utf8(output.stdout).unwrap();
    tree.lines().filter_map(|line| line.split_whitespace().next()).map(str::to_owned).collect()
}
