//! Materials from files, texts and presets.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use strict_yaml::Fault;

use crate::file::MaterialFile;
use crate::{Material, MaterialError, Picture, Preset};

/// Material files that begin with each other, at most this many deep.
const DEEPEST: u32 = 8;

/// A material file is no longer; a device, or a file of another kind named by mistake, may have no end.
const LONGEST: u64 = 1 << 20;

impl MaterialFile {
    /// Reads a text; `name` is what messages call it.
    ///
    /// # Errors
    /// [`MaterialError::File`] with the line and the right word for a mistyped one.
    pub fn from_yaml(text: &str, name: &str) -> Result<MaterialFile, MaterialError> {
        strict_yaml::parse(text).map_err(|fault| {
            let (file, key) = (PathBuf::from(name), String::new());
            let place = fault.place.map(|place| (place.line, place.column));
            MaterialError::File(vec![Fault { file, place, key, message: fault.message }])
        })
    }

    /// The file with its `preset` or `file` laid under it and their place taken, and paths that hold from
    /// where the program stands: those in it count from `base`.
    ///
    /// # Errors
    /// [`MaterialError`] for a preset that is none, or a file that cannot be read, or files that begin with
    /// each other in a circle.
    pub fn resolved(self, base: &Path) -> Result<MaterialFile, MaterialError> {
        self.resolved_within(base, DEEPEST)
    }

    fn resolved_within(mut self, base: &Path, depth: u32) -> Result<MaterialFile, MaterialError> {
        if let Some(texture) = &mut self.texture {
            texture.file = base.join(&texture.file);
        }
        if let (Some(import), true) = (self.imports().first(), self.preset.is_some() || self.file.is_some()) {
            let expected = "a fibre to begin with once: from a preset, a file or another program";
            return Err(MaterialError::value(import.key(), "beside `preset` or `file`", expected));
        }
        let under = match (self.preset.take(), self.file.take()) {
            (Some(preset), Some(_)) => {
                let expected = "one of `preset` and `file` to begin with";
                return Err(MaterialError::value("preset", format!("`{preset}` beside a file"), expected));
            }
            (Some(preset), None) => Preset::named(&preset)?.file()?,
            (None, Some(file)) => {
                let path = base.join(file);
                let deeper = depth.checked_sub(1).ok_or_else(|| {
                    let expected = "files that do not begin with each other";
                    MaterialError::value("file", format!("`{}`", path.display()), expected)
                })?;
                let (file, text) = read(&path)?;
                let folder = path.parent().unwrap_or(Path::new(""));
                let under =
                    file.resolved_within(folder, deeper).map_err(|error| begun(error, &path, &text))?;
                // Its faults are told here, where its text is at hand.
                under.checked(&path, &text)?;
                under
            }
            (None, None) => return Ok(self),
        };
        Ok(self.over(under))
    }

    /// The material, with all it begins with and its pictures; paths in the file count from `base`.
    ///
    /// # Errors
    /// As [`MaterialFile::resolved`], or [`MaterialError::File`] with every fault that could be found; without
    /// lines, which [`Material::open`] has.
    pub fn open_all(self, base: &Path) -> Result<Material, MaterialError> {
        self.resolved(base)?.finished(Path::new("material"), "")
    }

    /// The material, its pictures read; `path` and `text` are for messages.
    fn finished(&self, path: &Path, text: &str) -> Result<Material, MaterialError> {
        let load = |path: &Path| Picture::open(path).map(Arc::new);
        self.material(&load).map_err(|faults| placed(faults, path, text))
    }

    /// Checks everything but the pixels of pictures.
    fn checked(&self, path: &Path, text: &str) -> Result<(), MaterialError> {
        self.material(&Picture::unread).map(drop).map_err(|faults| placed(faults, path, text))
    }

    /// Every file that a change of would change this material, the ones it begins with and its picture;
    /// paths in it count from `base`.
    ///
    /// # Errors
    /// As [`MaterialFile::resolved`].
    pub fn files(&self, base: &Path) -> Result<Vec<PathBuf>, MaterialError> {
        let mut files = Vec::new();
        let (mut file, mut base) = (self.clone(), base.to_owned());
        for _ in 0..=DEEPEST {
            files.extend(file.texture.as_ref().map(|texture| base.join(&texture.file)));
            let Some(next) = file.file.take() else { return Ok(files) };
            let path = base.join(next);
            file = read(&path)?.0;
            base = path.parent().unwrap_or(Path::new("")).to_owned();
            files.push(path);
        }
        Ok(files)
    }
}

/// A material file and its text.
fn read(path: &Path) -> Result<(MaterialFile, String), MaterialError> {
    let io = |source| MaterialError::Io { path: path.to_owned(), source };
    let fault = |message| {
        MaterialError::File(vec![Fault { file: path.to_owned(), place: None, key: String::new(), message }])
    };
    let mut bytes = Vec::new();
    File::open(path).map_err(io)?.take(LONGEST + 1).read_to_end(&mut bytes).map_err(io)?;
    if bytes.len() as u64 > LONGEST {
        return Err(fault(format!("more than {LONGEST} bytes, expected a material file")));
    }
    let text = String::from_utf8(bytes).map_err(|error| {
        fault(format!("byte {} is not UTF-8, as YAML has to be", error.utf8_error().valid_up_to()))
    })?;
    Ok((MaterialFile::from_yaml(&text, &path.to_string_lossy())?, text))
}

/// A fault of what a file begins with, told at the key it begins by; one of another file's is told already.
fn begun(error: MaterialError, path: &Path, text: &str) -> MaterialError {
    let (key, message) = match error {
        MaterialError::Value { what, found, expected } => (what, format!("is {found}, expected {expected}")),
        MaterialError::Preset { .. } => ("preset".to_owned(), error.to_string()),
        MaterialError::Io { .. } => ("file".to_owned(), error.to_string()),
        told => return told,
    };
    placed(vec![(key, message)], path, text)
}

/// Faults by key, with the places of their values.
fn placed(faults: Vec<(String, String)>, path: &Path, text: &str) -> MaterialError {
    let place = |key: &str| {
        let keys: Vec<&str> = key.split('.').collect();
        strict_yaml::locate(text, &keys).map(|place| (place.line, place.column))
    };
    let fault = |(key, message): (String, String)| {
        let place = if key.is_empty() { None } else { place(&key) };
        Fault { file: path.to_owned(), place, key, message }
    };
    MaterialError::File(faults.into_iter().map(fault).collect())
}

impl Material {
    /// Reads a material file.
    ///
    /// # Errors
    /// [`MaterialError::Io`], or [`MaterialError::File`] with every fault that could be found.
    pub fn open(path: &Path) -> Result<Material, MaterialError> {
        let (file, text) = read(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        file.resolved(folder).map_err(|error| begun(error, path, &text))?.finished(path, &text)
    }

    /// The material of a text; `name` is what messages call it. Paths in it count from where the program
    /// stands.
    ///
    /// # Errors
    /// As [`Material::open`].
    pub fn from_yaml(text: &str, name: &str) -> Result<Material, MaterialError> {
        let path = Path::new(name);
        let file = MaterialFile::from_yaml(text, name)?.resolved(Path::new(""));
        file.map_err(|error| begun(error, path, text))?.finished(path, text)
    }

    /// The material called `name`, one of [`Material::preset_names`].
    ///
    /// # Errors
    /// [`MaterialError::Preset`] with the name that may have been meant.
    pub fn preset(name: &str) -> Result<Material, MaterialError> {
        let preset = Preset::named(name)?;
        preset.file()?.finished(Path::new(preset.name), preset.keys)
    }

    /// The names of all presets.
    pub fn preset_names() -> impl Iterator<Item = &'static str> {
        Preset::all().iter().map(|preset| preset.name)
    }
}
