//! Helpers for the end-to-end tests, which live in `tests/`: where the programs, the samples and the
//! real inputs are.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The workspace's root folder.
#[must_use]
pub fn workspace() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap_or_else(|| Path::new(".."))
}

/// The built program `name`, next to the folder this test runs from (`target/<profile>/`).
///
/// # Panics
/// When it has not been built; the message says how.
#[must_use]
#[allow(clippy::panic)] // a test without its program can only stop
pub fn program(name: &str) -> PathBuf {
    let folder = std::env::current_exe().ok().and_then(|test| Some(test.parent()?.parent()?.to_owned()));
    let path = folder.unwrap_or_default().join(format!("{name}{}", std::env::consts::EXE_SUFFIX));
    assert!(path.is_file(), "{} is not built: run `cargo build --workspace` first", path.display());
    path
}

/// Runs the program `name` with `arguments` and waits for it.
///
/// # Panics
/// When the program cannot be started.
#[must_use]
#[allow(clippy::panic)]
pub fn run<S: AsRef<std::ffi::OsStr>>(name: &str, arguments: &[S]) -> Output {
    match Command::new(program(name)).args(arguments).output() {
        Ok(output) => output,
        Err(error) => panic!("{name} could not be started: {error}"),
    }
}

/// The committed samples.
#[must_use]
pub fn samples_dir() -> PathBuf {
    workspace().join("samples")
}

/// The folder of real inputs (`$GROOMKIT_DATA`, or `../shared/data` beside the checkout), or `None`.
#[must_use]
pub fn data_dir() -> Option<PathBuf> {
    let asked = std::env::var_os("GROOMKIT_DATA").map(PathBuf::from);
    asked.or_else(|| Some(workspace().parent()?.join("shared/data"))).filter(|folder| folder.is_dir())
}

/// A file among the real inputs; when it is missing, says so in a line starting `skipped:`.
#[must_use]
pub fn data_file(name: &str) -> Option<PathBuf> {
    let found = data_dir().map(|folder| folder.join(name)).filter(|path| path.is_file());
    if found.is_none() {
        say_skipped(&format!("{name} is not there; set GROOMKIT_DATA to the folder of real inputs"));
    }
    found
}

/// Says on the real stderr that something was not tested: the test harness hides what `eprintln!` prints.
pub fn say_skipped(what: &str) {
    let _ = writeln!(std::io::stderr(), "skipped: {what}");
}

/// Other people's programs, installed by `cargo xtask setup`.
pub mod validators {
    use std::path::PathBuf;

    /// The Python of `target/venv`, which has usd-core; `None` only when skipping was asked for.
    ///
    /// # Panics
    /// When it is missing and `GROOMKIT_SKIP_VALIDATORS` is not `1`.
    #[must_use]
    pub fn python() -> Option<PathBuf> {
        let folder = if cfg!(windows) { "Scripts/python.exe" } else { "bin/python" };
        wanted(super::workspace().join("target/venv").join(folder))
    }

    /// The folder whose `node_modules` holds the Khronos validator; `None` only when skipping was asked for.
    ///
    /// # Panics
    /// When it is missing and `GROOMKIT_SKIP_VALIDATORS` is not `1`.
    #[must_use]
    pub fn gltf() -> Option<PathBuf> {
        let folder = std::env::var_os("GLTF_VALIDATOR_DIR").map(PathBuf::from);
        let folder = folder.unwrap_or_else(|| super::workspace().join("target/npm"));
        wanted(folder.join("node_modules/gltf-validator")).map(|_| folder)
    }

    /// Node: the one in `PATH`, else the one installed into `target/venv` for machines that have none;
    /// `None` only when skipping was asked for.
    ///
    /// # Panics
    /// When it is missing and `GROOMKIT_SKIP_VALIDATORS` is not `1`.
    #[must_use]
    pub fn node() -> Option<PathBuf> {
        let program = PathBuf::from(format!("node{}", std::env::consts::EXE_SUFFIX));
        let folders = std::env::var_os("PATH").unwrap_or_default();
        let in_path = std::env::split_paths(&folders).map(|folder| folder.join(&program));
        let folder = if cfg!(windows) { "Scripts" } else { "bin" };
        let installed = super::workspace().join("target/venv").join(folder).join(&program);
        wanted(in_path.into_iter().find(|path| path.is_file()).unwrap_or(installed))
    }

    fn wanted(path: PathBuf) -> Option<PathBuf> {
        if path.exists() {
            return Some(path);
        }
        let skip = std::env::var("GROOMKIT_SKIP_VALIDATORS").is_ok_and(|value| value == "1");
        assert!(
            skip,
            "{} is missing: run `cargo xtask setup`, or set GROOMKIT_SKIP_VALIDATORS=1",
            path.display()
        );
        super::say_skipped(&format!("{} is missing and GROOMKIT_SKIP_VALIDATORS=1", path.display()));
        None
    }
}
