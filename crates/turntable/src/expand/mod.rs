//! From a pipeline file to what is rendered: every variant a whole pipeline.

pub(crate) mod yaml;

use std::path::{Path, PathBuf};

use crate::schema::Pipeline;
use crate::{Fault, Options, TurntableError, check};

/// One way to read a pipeline: a setting of every axis of its `matrix` chosen. A pipeline without one has one
/// variant.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Variant {
    /// The names of its settings, joined by `/` in the order of the axes; empty where there is no `matrix`.
    pub id: String,
    /// Axis and name of each setting.
    pub axes: Vec<(String, String)>,
    /// What holds for it, all of it said.
    pub pipeline: Pipeline,
}

/// A pipeline file, read and checked.
#[derive(Debug)]
pub(crate) struct Expanded {
    /// What the pipeline is called.
    pub name: String,
    /// The output folder.
    pub output: PathBuf,
    /// What is rendered; never empty. What is said of all together (`sheet`, `page`) is the first one's.
    pub variants: Vec<Variant>,
    /// The files that were read for it: the pipeline itself first.
    pub inputs: Vec<PathBuf>,
}

/// Reads a pipeline file.
pub(crate) fn expand(file: &Path, options: &Options) -> Result<Expanded, TurntableError> {
    let text = text_of(file)?;
    let pipeline = yaml::parse_with(&text, &options.settings).map_err(|fault| {
        let place = fault.place.map(|p| (p.line, p.column));
        let (file, message) = (file.to_owned(), fault.message);
        TurntableError::Pipeline(vec![Fault { file, place, key: String::new(), message }])
    })?;
    let mut faults = check::faults(&pipeline, file, &text);
    faults.iter_mut().for_each(|fault| name_flag(fault, &options.settings));
    if !faults.is_empty() {
        return Err(TurntableError::Pipeline(faults));
    }
    let stem = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let name = pipeline.name.clone().unwrap_or_else(|| stem.clone());
    let asked = options.output.clone().or_else(|| pipeline.output.clone());
    let output = asked.unwrap_or_else(|| Path::new("out").join(stem));
    let variants = vec![Variant { pipeline, ..Variant::default() }];
    Ok(Expanded { name, output, variants, inputs: vec![file.to_owned()] })
}

/// The text of a pipeline file.
fn text_of(file: &Path) -> Result<String, TurntableError> {
    let bytes = std::fs::read(file).map_err(|e| TurntableError::io(file, "read", e))?;
    String::from_utf8(bytes).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let lines = before.split(|&b| b == b'\n');
        let column = |last| String::from_utf8_lossy(last).chars().count() + 1;
        let place = lines.clone().next_back().map(|last| (lines.count(), column(last)));
        let message = format!("byte {} is not UTF-8, as YAML has to be", before.len());
        TurntableError::Pipeline(vec![Fault { file: file.to_owned(), place, key: String::new(), message }])
    })
}

/// Names the flag that brought a fault in: the file is not to blame, and its place would mislead.
fn name_flag(fault: &mut Fault, settings: &[String]) {
    let within = |inner: &str, outer: &str| {
        inner.strip_prefix(outer).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    let path = |setting: &str| setting.split('=').next().unwrap_or_default().trim().to_owned();
    // The last one laid over counts.
    let Some(setting) = settings.iter().rev().find(|s| {
        let path = path(s);
        within(&fault.key, &path) || within(&path, &fault.key)
    }) else {
        return;
    };
    if within(&fault.key, &path(setting)) {
        fault.place = None;
    }
    fault.message += &format!(" (from `--set {setting}`)");
}
