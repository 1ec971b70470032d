//! An Open Job Description bundle: template, parameter values, files that go along.
//!
//! Specification: <https://github.com/OpenJobDescription/openjd-specifications/wiki>, 2023-09, with the extension
//! `TASK_CHUNKING` (RFC 0001). The two files beside the template are those of AWS Deadline Cloud's job bundles.

mod literals;
mod template;

use crate::yaml::{list, quoted};
use crate::{FarmError, FarmJob, range_text};

pub(crate) const FORMAT: &str = "an OpenJD template";

/// The files of a bundle, the one that makes it a bundle last.
pub const BUNDLE_FILES: [&str; 3] = ["asset_references.yaml", "parameter_values.yaml", "template.yaml"];

/// The most characters of a parameter's value.
const MOST_VALUE: usize = 1024;

/// The files of a job bundle by name, in the order of [`BUNDLE_FILES`]: written in that order, a folder is a bundle
/// only when it is whole.
///
/// # Errors
/// [`FarmError`] when the job is incomplete or holds what the specification does not allow.
pub fn openjd(job: &FarmJob) -> Result<[(&'static str, String); 3], FarmError> {
    job.check(FORMAT)?;
    let template = template::template(job)?;
    let [assets, values, name] = BUNDLE_FILES;
    Ok([(assets, asset_references(job)), (values, parameter_values(job)), (name, template)])
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

/// The values the job is exported with; they are the template's defaults as well.
fn parameter_values(job: &FarmJob) -> String {
    let values = template::parameters(job)
        .into_iter()
        .map(|p| format!("- name: {}\n  value: {}\n", p.name, p.default));
    format!(
        "# The values that {} was exported with; change them here or on the command line.\nparameterValues:\n{}",
        quoted(&job.name),
        values.collect::<String>()
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
