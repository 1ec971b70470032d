//! The package, found and ready.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

use crate::{Finding, UsdCoreError, python, scripts};

/// What `check.py` exits with when it found something: its answer is then whole all the same. A Python that stops
/// with an exception of its own exits with it too.
const FOUND_WANTING: i32 = 1;

/// usd-core in a Python of this machine.
#[derive(Debug)]
pub struct UsdCore {
    python: PathBuf,
    scripts: TempDir,
}

/// How an animated stage is baked.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BakeOptions {
    /// Time codes between samples; `None` is 1, less gives sub-frames.
    pub step: Option<f64>,
    /// First and last time code; `None` takes the stage's own.
    pub frames: Option<(f64, f64)>,
    /// A time code that is to be between samples too; the range is widened to it.
    pub hold: Option<f64>,
    /// Keep points in the prims' own spaces, each below one matrix in `f64`, rather than in the stage's.
    pub transforms: bool,
}

impl UsdCore {
    /// Looks for a Python that has the package.
    ///
    /// # Errors
    /// [`UsdCoreError::Missing`], which says how to install it.
    pub fn find() -> Result<UsdCore, UsdCoreError> {
        Ok(UsdCore { python: python::find()?, scripts: scripts::unpack()? })
    }

    /// Runs every validator that usd-core ships and groomkit's rules for hair curves on `file`.
    ///
    /// # Errors
    /// [`UsdCoreError::Failed`] when the file cannot be opened as a stage.
    pub fn check(&self, file: &Path) -> Result<Vec<Finding>, UsdCoreError> {
        const SCRIPT: &str = "check.py";
        let output = self.run(SCRIPT, [OsStr::new("--json"), file.as_os_str()])?;
        let wanting = output.status.code() == Some(FOUND_WANTING) && !output.stdout.is_empty();
        if !wanting {
            succeeded(SCRIPT, file, &output)?;
        }
        let report: Result<BTreeMap<String, Vec<Finding>>, _> = serde_json::from_slice(&output.stdout);
        let name = file.display().to_string();
        let report = report.map_err(|source| UsdCoreError::Answer { script: SCRIPT, file: name, source })?;
        Ok(report.into_values().flatten().collect())
    }

    /// Flattens composition and turns every animation (skins, blend shapes, transforms) of the stage `input` into
    /// plain points a sample, written to `output` (`.usda` or `.usdc`).
    ///
    /// # Errors
    /// [`UsdCoreError::Failed`]; `output` is then as it was.
    pub fn bake(&self, input: &Path, output: &Path, options: BakeOptions) -> Result<(), UsdCoreError> {
        let mut arguments = vec![input.as_os_str().to_owned(), output.as_os_str().to_owned()];
        if let Some(step) = options.step {
            arguments.push(format!("--step={step}").into());
        }
        // In one word: a time below 0 would be taken for an option.
        if let Some((first, last)) = options.frames {
            arguments.push(format!("--frames={first}:{last}").into());
        }
        if let Some(time) = options.hold {
            arguments.push(format!("--hold={time}").into());
        }
        if options.transforms {
            arguments.push("--transforms".into());
        }
        succeeded("bake.py", input, &self.run("bake.py", arguments)?)
    }

    /// Packages the stage `input` and all it refers to as `output`, a `.usdz`.
    ///
    /// # Errors
    /// [`UsdCoreError::Failed`]; `output` is then as it was.
    pub fn package(&self, input: &Path, output: &Path) -> Result<(), UsdCoreError> {
        succeeded("package.py", input, &self.run("package.py", [input, output])?)
    }

    fn run(
        &self,
        script: &'static str,
        arguments: impl IntoIterator<Item = impl AsRef<OsStr>>,
    ) -> Result<Output, UsdCoreError> {
        // -B: nothing is to be compiled into a folder that goes away.
        let mut command = Command::new(&self.python);
        command.arg("-B").arg(self.scripts.path().join(script)).args(arguments).stdin(Stdio::null());
        command.output().map_err(|e| UsdCoreError::io(format!("{} {script}", self.python.display()), e))
    }
}

/// An error with the program's last words unless it did what it was asked for.
fn succeeded(script: &'static str, file: &Path, output: &Output) -> Result<(), UsdCoreError> {
    if output.status.success() {
        return Ok(());
    }
    let told = String::from_utf8_lossy(&output.stderr);
    let told = told.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or("it said nothing");
    let (file, told) = (file.display().to_string(), format!("{told} ({})", output.status));
    Err(UsdCoreError::Failed { script, file, told })
}
