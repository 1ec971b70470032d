//! A Python that has usd-core.

use std::env;
use std::ffi::OsString;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use crate::UsdCoreError;

/// Names a Python that has usd-core; nothing else is then tried.
const CHOSEN: &str = "GROOMKIT_PYTHON";

/// Asks whether the package, and numpy that our programs use with it, are there without loading them.
const PROBE: &str =
    "import importlib.util as u, sys; sys.exit(0 if u.find_spec('pxr') and u.find_spec('numpy') else 1)";

/// The first Python that has usd-core: `$GROOMKIT_PYTHON`, the environment `cargo xtask setup` makes beside
/// the program, `python3`, `python`.
pub(crate) fn find() -> Result<PathBuf, UsdCoreError> {
    let candidates = candidates(env::var_os(CHOSEN));
    let found = candidates.iter().find(|python| has_usd(python)).cloned();
    found.ok_or_else(|| UsdCoreError::Missing {
        tried: candidates.iter().map(|python| python.display().to_string()).collect::<Vec<_>>().join(", "),
    })
}

fn candidates(chosen: Option<OsString>) -> Vec<PathBuf> {
    if let Some(chosen) = chosen {
        return vec![chosen.into()];
    }
    let inside = if cfg!(windows) { "venv/Scripts/python.exe" } else { "venv/bin/python" };
    // A program lies in target/PROFILE, a test in target/PROFILE/deps.
    let program = env::current_exe().unwrap_or_default();
    let beside = program.ancestors().skip(2).take(2).map(|folder| folder.join(inside));
    let beside = beside.filter(|python| python.is_file());
    beside.chain(["python3".into(), "python".into()]).collect()
}

fn has_usd(python: &PathBuf) -> bool {
    let mut command = Command::new(python);
    command.args(["-c", PROBE]).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_chosen_python_is_the_only_one_tried() {
        assert_eq!(candidates(Some("/no/python".into())), [PathBuf::from("/no/python")]);
        assert!(candidates(None).len() >= 2);
        assert!(!has_usd(&"/no/python".into()));
    }
}
