//! An Open Job Description bundle: template, parameter values, files that go along.
//!
//! The template holds no path: the specification's own reader refuses defaults outside the template's folder. They
//! are values, once as Deadline Cloud reads them and once as `openjd-cli` does.
//!
//! Specification: <https://github.com/OpenJobDescription/openjd-specifications/wiki>, 2023-09, with the extension
//! `TASK_CHUNKING` (RFC 0001). `asset_references.yaml` and `parameter_values.yaml` are those of AWS Deadline Cloud's job bundles.

mod literals;
mod template;

use crate::yaml::{list, quoted};
use crate::{FarmError, FarmJob, range_text};

pub(crate) const FORMAT: &str = "an OpenJD template";

/// The files of a bundle, the one that makes it a bundle last.
pub const BUNDLE_FILES: [&str; 4] =
    ["asset_references.yaml", "parameter_values.yaml", "values.yaml", "template.yaml"];

/// The most characters of a parameter's value.
const MOST_VALUE: usize = 1024;

/// The files of a job bundle by name, in the order of [`BUNDLE_FILES`]: written in that order, a folder is a bundle
/// only when it is whole.
///
/// # Errors
/// [`FarmError`] when the job is incomplete or holds what the specification does not allow.
pub fn openjd(job: &FarmJob) -> Result<[(&'static str, String); 4], FarmError> {
    job.check(FORMAT)?;
    let template = template::template(job)?;
    let [assets, values, flat, name] = BUNDLE_FILES;
    Ok([
        (assets, asset_references(job)),
        (values, parameter_values(job)),
        (flat, flat_values(job)),
        (name, template),
    ])
}

/// What a farm that copies files has to bring to its machines, and to take back.
fn asset_references(job: &FarmJob) -> String {
    let text = |path: &std::path::PathBuf| path.to_string_lossy().into_owned();
    let files: Vec<String> = [&job.pipeline].into_iter().chain(&job.inputs).map(text).collect();
    let folders: Vec<String> = job.input_folders.iter().map(text).collect();
    format!(
        "# What the job reads and writes, for farms that copy files; those whose machines see the same files need none\n\
         # of it. Files that these files name in turn (textures of a glTF, layers of a USD file) are not looked up.\n\
         assetReferences:\n  \
           inputs:\n    \
             filenames: {}\n    \
             directories: {}\n  \
           outputs:\n    \
             directories: {}\n  \
           referencedPaths: []\n",
        list(&files),
        list(&folders),
        list([&text(&job.output)])
    )
}

/// The values the job is exported with, as AWS Deadline Cloud reads them.
fn parameter_values(job: &FarmJob) -> String {
    let value = |p: template::Parameter| format!("- name: {}\n  value: {}\n", p.name, p.value);
    format!(
        "# The values that {} was exported with, for farms that take job bundles.\nparameterValues:\n{}",
        quoted(&job.name),
        template::parameters(job).into_iter().map(value).collect::<String>()
    )
}

/// Those the template has no defaults for, as `openjd run -p file://` reads them.
fn flat_values(job: &FarmJob) -> String {
    let value = |p: template::Parameter| format!("{}: {}\n", p.name, p.value);
    let needed = template::parameters(job).into_iter().filter(|parameter| !parameter.has_default);
    format!(
        "# The paths that {} was exported with, for `openjd run template.yaml -p file://values.yaml`: a template may\n\
         # name none outside its own folder.\n{}",
        quoted(&job.name),
        needed.map(value).collect::<String>()
    )
}

/// Refuses a text that no parameter can hold.
fn fits(what: &str, text: &str, most: usize, remedy: &'static str) -> Result<(), FarmError> {
    match text.chars().count() {
        found if found > most => {
            Err(FarmError::TooLong { what: what.to_owned(), found, most, format: FORMAT, remedy })
        }
        _ => Ok(()),
    }
}

/// The frames as the parameter holds them.
fn frames(job: &FarmJob) -> String {
    range_text(&job.frames)
}
