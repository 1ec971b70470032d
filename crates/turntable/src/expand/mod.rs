//! From a pipeline file to what is rendered: every variant a whole pipeline.

mod axis;
mod exclude;
mod matrix;
mod told;
mod variant;

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use strict_yaml::{Document, DocumentError, Setting, nearest};

use crate::schema::Pipeline;
use crate::{Fault, Options, TurntableError, only, outputs};
use matrix::{Combination, Matrix};
use told::Told;

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

impl Variant {
    /// The variant's pipeline in YAML, its defaults said too: it reads back to the same. Paths
    /// count from the folder of the pipeline file it came from.
    ///
    /// # Errors
    /// Words, where a value cannot be written in YAML.
    pub fn to_yaml(&self) -> Result<String, String> {
        strict_yaml::write_brief(&self.pipeline)
    }
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
    let document = Document::open(file).map_err(|error| match error {
        DocumentError::Io { file, source } => TurntableError::io(&file, "read", source),
        DocumentError::Faults(faults) => TurntableError::Pipeline(faults),
    })?;
    let inputs = document.files().to_vec();
    let variants = variants(document, file, options).map_err(TurntableError::Pipeline)?;
    let stem = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    // What is said of all together is the same in each.
    let first = variants.first().map(|variant| &variant.pipeline);
    let name = first.and_then(|pipeline| pipeline.name.clone()).unwrap_or_else(|| stem.clone());
    let asked = options.output.clone().or_else(|| first.and_then(|pipeline| pipeline.output.clone()));
    let output = asked.unwrap_or_else(|| Path::new("out").join(stem));
    Ok(Expanded { name, output, variants, inputs })
}

/// What checking a pipeline file came to.
#[derive(Debug)]
pub struct Checked {
    /// Everything wrong with it, each told once; empty for a good one.
    pub faults: Vec<Fault>,
    /// What it comes to, if nothing is wrong with it.
    pub variants: Vec<Variant>,
}

/// Checks a pipeline file: what it says, and that the files it names are there. Nothing that is made of it is
/// looked at. All variants are checked, and those that [`Options::only`] asks for handed out.
///
/// # Errors
/// [`TurntableError::Io`] when the file itself cannot be read, [`TurntableError::NoSuchVariant`].
pub fn check_pipeline(file: &Path, options: &Options) -> Result<Checked, TurntableError> {
    match expand(file, options) {
        Ok(Expanded { mut variants, .. }) => {
            let mut asked = only::asked(&options.only, &variants)?.into_iter();
            variants.retain(|_| asked.next().unwrap_or(true));
            Ok(Checked { faults: Vec::new(), variants })
        }
        Err(TurntableError::Pipeline(faults)) => Ok(Checked { faults, variants: Vec::new() }),
        Err(error) => Err(error),
    }
}

/// More values than this in all variants together are an attack.
const MOST_VALUES: usize = 1_000_000;

/// Every variant of a document, checked; never none.
fn variants(mut document: Document, file: &Path, options: &Options) -> Result<Vec<Variant>, Vec<Fault>> {
    let variables = options.variables.iter().map(|text| Setting::variable(text));
    let settings: Vec<Setting> =
        variables.chain(options.settings.iter().map(|text| Setting::set(text))).collect();
    let declared = names_of_variables(&document);
    let faults: Vec<Fault> = settings.iter().filter_map(|setting| document.lay(setting).err()).collect();
    if !faults.is_empty() {
        return Err(faults);
    }
    let matrix = Matrix::of(&mut document)?;
    let combinations = matrix.combinations(&document)?;
    let (count, values) = (combinations.len(), document.values());
    if count.saturating_mul(values) > MOST_VALUES {
        let message =
            format!("comes to {count} variants of {values} values, expected at most {MOST_VALUES} in all");
        return Err(vec![document.fault("matrix", message)]);
    }
    let mut told = Told::default();
    let mut used = declared;
    let mut variants: Vec<Variant> = Vec::new();
    for combination in &combinations {
        let Combination { id, axes, patches } = combination;
        let mut document = document.clone();
        for patch in patches {
            document.lay_over(patch);
            used.extend(
                patch.child("variables").into_iter().flat_map(|names| names.keys()).map(str::to_owned),
            );
        }
        if !patches.is_empty() {
            // Settings lie over what the matrix says, too; those for the matrix itself have done their work.
            let below = settings.iter().filter(|setting| !setting.is_below("matrix"));
            told.add(id, below.filter_map(|setting| document.lay(setting).err()));
        }
        match variant::read(document, file) {
            Ok(read) => {
                used.extend(read.used);
                told.add(id, read.faults);
                let (id, axes) = (id.clone(), axes.clone());
                variants.extend(read.pipeline.map(|pipeline| Variant { id, axes, pipeline }));
            }
            Err(faults) => told.add(id, faults),
        }
        if told.is_enough() {
            break;
        }
    }
    let mut faults = told.faults(combinations.len());
    if faults.is_empty() {
        faults.extend(settings.iter().filter_map(|setting| unused(setting, &used, file)));
        faults.extend(outputs_together(&document, &variants));
    }
    if faults.is_empty() { Ok(variants) } else { Err(faults) }
}

/// The names that the files themselves give to variables.
fn names_of_variables(document: &Document) -> BTreeSet<String> {
    let told = document.root().child("variables");
    told.into_iter().flat_map(|names| names.keys()).map(str::to_owned).collect()
}

/// A value for a variable that nobody uses: most likely its name is mistyped.
fn unused(setting: &Setting, used: &BTreeSet<String>, file: &Path) -> Option<Fault> {
    let name = setting.variable_name().filter(|name| !used.contains(*name))?;
    let meant = nearest(name, used.iter().map(String::as_str));
    let meant = meant.map_or_else(String::new, |meant| format!(", did you mean `{meant}`?"));
    let message = format!("no `${{{name}}}` is used{meant} (from `{}`)", setting.words());
    Some(Fault { file: file.to_owned(), place: None, key: format!("variables.{name}"), message })
}

/// What is too much only when all variants are shown together.
fn outputs_together(document: &Document, variants: &[Variant]) -> Option<Fault> {
    let Pipeline { sheet, render, .. } = &variants.first()?.pipeline;
    let pictures = variants.iter().map(|v| v.pipeline.turntable.frames).fold(0, u32::saturating_add);
    let (width, height) = outputs::sheet_layout(sheet.as_ref()?, render).size(pictures);
    let words = crate::check::too_many_pixels(width, height)?;
    Some(document.fault("sheet", words))
}

/// The variants of a text that is called `turn.yaml`.
#[cfg(test)]
pub(crate) fn of_text(text: &str, settings: &[&str]) -> Result<Vec<Variant>, Vec<Fault>> {
    of_texts(&[("turn.yaml", text)], settings)
}

/// The variants of the first of some texts, which may include the others.
#[cfg(test)]
fn of_texts(texts: &[(&str, &str)], settings: &[&str]) -> Result<Vec<Variant>, Vec<Fault>> {
    let load = |path: &Path| {
        let text = texts.iter().find(|(name, _)| path == Path::new(name));
        text.map(|(_, text)| text.as_bytes().to_vec()).ok_or(std::io::ErrorKind::NotFound.into())
    };
    let file = Path::new(texts[0].0);
    let settings = settings.iter().map(|s| (*s).to_owned()).collect();
    match Document::open_with(file, &load) {
        Ok(document) => variants(document, file, &Options { settings, ..Options::default() }),
        Err(DocumentError::Faults(faults)) => Err(faults),
        Err(error) => panic!("{error}"),
    }
}

#[cfg(test)]
mod tests;
