//! The one gate: what every change must pass.

use std::env;
use std::path::PathBuf;
use std::process::Command;

use anyhow::Result;

use crate::setup;
use crate::shell::{cargo, exists, root, step};

/// Pinned, so that a new release cannot turn an old commit red.
const DENY: &str = "cargo-deny@0.20.2";

/// Formats of `groom-formats`, each of which must build alone.
const FORMAT_FEATURES: [&str; 14] = [
    "hair", "text", "gltf", "usda", "usdc", "usdz", "alembic", "ply", "data", "obj", "pbrt", "tfx",
    "monohair", "ct2hair",
];

/// Runs every check, the cheap ones first.
pub fn test() -> Result<()> {
    step("format", cargo().args(["fmt", "--all", "--check"]))?;
    setup::validators()?;
    step("lints", cargo().args(["clippy", "--workspace", "--all-targets", "--", "--deny", "warnings"]))?;
    features()?;
    step(
        "documentation",
        cargo().args(["doc", "--workspace", "--no-deps", "--quiet"]).env("RUSTDOCFLAGS", "--deny warnings"),
    )?;
    fuzz_targets()?;
    licences()?;
    step("programs", cargo().args(["build", "--workspace", "--bins"]))?;
    step("tests", cargo().args(["test", "--workspace", "--no-fail-fast"]))?;
    quickstart()
}

/// The README's first command, at a sample count that shows whether it works and not how it looks.
fn quickstart() -> Result<()> {
    let mut turntable = cargo();
    turntable.args(["run", "--quiet", "--bin", "turntable", "--", "pipelines/quickstart.yaml"]);
    turntable.args(["--out", "target/quickstart", "--set", "render.spp=2"]);
    step("quickstart at two samples a pixel", &mut turntable)
}

fn features() -> Result<()> {
    let check = |package: &str, features: &str| {
        let mut command = cargo();
        command.args([
            "check",
            "--quiet",
            "--package",
            package,
            "--no-default-features",
            "--features",
            features,
        ]);
        step(&format!("{package} with only [{features}]"), &mut command)
    };
    check("cyhair", "")?;
    check("cyhair", "mmap")?;
    check("groom-formats", "")?;
    FORMAT_FEATURES.iter().try_for_each(|feature| check("groom-formats", feature))
}

/// Fuzz targets are built, not run: running is for `cargo fuzz`, for hours.
fn fuzz_targets() -> Result<()> {
    let target = root().join("target/fuzz");
    let mut command = cargo();
    command.args(["check", "--quiet", "--manifest-path", "fuzz/Cargo.toml"]).env("CARGO_TARGET_DIR", target);
    step("fuzz targets", &mut command)
}

/// Advisories need a database from the network; `cargo deny check` looks them up where there is one.
fn licences() -> Result<()> {
    let mut deny = Command::new(deny_program()?);
    deny.current_dir(root()).args([
        "--all-features",
        "--log-level",
        "error",
        "check",
        "licenses",
        "bans",
        "sources",
    ]);
    step("licences, bans and sources of all dependencies", &mut deny)
}

fn deny_program() -> Result<PathBuf> {
    if exists("cargo-deny") {
        return Ok("cargo-deny".into());
    }
    let tools = root().join("target/tools");
    let program = tools.join("bin").join(format!("cargo-deny{}", env::consts::EXE_SUFFIX));
    if !program.exists() {
        let mut install = cargo();
        // A debug build without debug information: it reads some manifests and ends, and builds in half the time.
        install.args(["install", "--quiet", "--locked", "--debug", DENY, "--root"]).arg(&tools);
        install
            .env("CARGO_TARGET_DIR", root().join("target/tools/build"))
            .env("CARGO_PROFILE_DEV_DEBUG", "0");
        step("install cargo-deny into target/tools", &mut install)?;
    }
    Ok(program)
}
