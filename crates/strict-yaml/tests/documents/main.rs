//! Documents put together from several texts.
#![allow(clippy::unwrap_used, clippy::panic)]

mod faults;
mod hostile;
mod includes;
mod laws;
mod variables;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde_json::Value;
use strict_yaml::{Document, DocumentError, Setting};

/// The document of `texts`, the first of which is the file.
fn open(texts: &[(&str, &str)]) -> Result<Document, DocumentError> {
    let files: BTreeMap<PathBuf, &str> = texts.iter().map(|(name, text)| (name.into(), *text)).collect();
    let load = |path: &Path| {
        let text = files.get(path).ok_or_else(|| std::io::Error::from(std::io::ErrorKind::NotFound))?;
        Ok(text.as_bytes().to_vec())
    };
    Document::open_with(Path::new(texts[0].0), &load)
}

fn one(text: &str) -> Document {
    open(&[("a.yaml", text)]).unwrap()
}

fn with(text: &str, settings: &[Setting]) -> Document {
    let mut document = one(text);
    settings.iter().for_each(|setting| document.lay(setting).unwrap());
    document
}

/// What the document says.
fn said(document: &Document) -> Value {
    let reading = document.read::<Value>();
    assert_eq!(reading.faults, []);
    reading.value.unwrap()
}

/// What the document says with its variables put in.
fn put_in(document: &Document) -> Value {
    said(&document.with_variables().unwrap().0)
}

fn lines(faults: &[strict_yaml::Fault]) -> Vec<String> {
    faults.iter().map(ToString::to_string).collect()
}

fn refused(texts: &[(&str, &str)]) -> Vec<String> {
    match open(texts) {
        Err(DocumentError::Faults(faults)) => lines(&faults),
        other => panic!("{other:?}"),
    }
}
