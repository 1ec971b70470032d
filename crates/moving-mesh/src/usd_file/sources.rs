//! The layers that a stage is composed of, and the pictures they name.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use usd_layer::{Layer, Prim, Value};

/// The layer at `path`, those that it and they pull in (sublayers, references, payloads, clips) and, with `pictures`,
/// the other files they name, where they are there.
pub(crate) fn sources(path: &Path, pictures: bool) -> Vec<PathBuf> {
    let mut files = vec![path.to_owned()];
    // One file may go by many names, and layers may name each other.
    let mut seen: BTreeSet<PathBuf> = path.canonicalize().into_iter().collect();
    let mut next = 0;
    while let Some(file) = files.get(next).cloned() {
        next += 1;
        if !is_layer(&file) {
            continue;
        }
        let Ok(layer) = super::open(&file) else { continue };
        let mut names = Vec::new();
        Names { layer: &layer, pictures, names: &mut names }.of_layer();
        let folder = file.parent().unwrap_or(Path::new(""));
        for name in names {
            // `set.usdz[chair.usda]` is inside a package.
            let named = folder.join(name.split_once('[').map_or(&*name, |(package, _)| package));
            let is_new = named.canonicalize().is_ok_and(|real| real.is_file() && seen.insert(real));
            if is_new {
                files.push(named);
            }
        }
    }
    files
}

fn is_layer(path: &Path) -> bool {
    let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
    ending.is_some_and(|ending| ["usd", "usda", "usdc", "usdz"].contains(&&*ending))
}

/// Names of other files in a layer.
struct Names<'a> {
    layer: &'a Layer<Vec<u8>>,
    pictures: bool,
    names: &'a mut Vec<String>,
}

impl Names<'_> {
    fn of_layer(&mut self) {
        let layer = self.layer;
        layer.metadata.iter().for_each(|(_, value)| self.value(value));
        layer.prims.iter().for_each(|prim| self.prim(prim));
    }

    fn prim(&mut self, prim: &Prim) {
        prim.metadata.iter().for_each(|(_, value)| self.value(value));
        if self.pictures {
            prim.attributes.iter().filter_map(|a| a.default.as_ref()).for_each(|value| self.value(value));
        }
        prim.children.iter().for_each(|child| self.prim(child));
        // A stronger layer may select any of them.
        let variants = prim.variant_sets.iter().flat_map(|set| &set.variants);
        variants.for_each(|variant| self.prim(variant));
    }

    fn value(&mut self, value: &Value) {
        match value {
            Value::Asset(name) => self.names.push(name.to_string()),
            Value::Reference(reference) => self.names.push(reference.asset.to_string()),
            Value::List(list) => list.items().for_each(|item| match item.text() {
                // Sublayers are texts in some files.
                Some(text) => self.names.push(text.to_owned()),
                None => self.value(item),
            }),
            Value::Dictionary(entries) => entries.iter().for_each(|(_, value)| self.value(value)),
            Value::Array(_) => {
                let texts = self.layer.texts(value).unwrap_or_default();
                self.names.extend(texts.iter().map(ToString::to_string));
            }
            _ => {}
        }
    }
}
