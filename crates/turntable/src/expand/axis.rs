//! One axis of a `matrix`: names, and the keys that each lays over the pipeline.

use std::collections::BTreeMap;

use strict_yaml::{Document, Node};

use super::matrix::{MOST_VARIANTS, unknown};
use crate::Fault;

/// What is said once for all variants, and what puts a pipeline together.
const OF_ALL: [&str; 7] = ["version", "name", "output", "sheet", "page", "matrix", "include"];
/// Keys below each other in the short form; the schema has fewer.
const DEEPEST_KEY: usize = 16;
/// A name is that of a folder, and systems know none of more than 255 bytes.
const LONGEST_NAME: usize = 64;

/// An axis; its settings are never none.
pub(super) struct Axis {
    pub name: String,
    /// Names and patches, in their order.
    pub settings: Vec<(String, Node)>,
}

impl Axis {
    /// The axis that `node` holds below `matrix.NAME`.
    pub fn of(document: &Document, name: &str, node: &Node) -> Result<Axis, Vec<Fault>> {
        let key = format!("matrix.{name}");
        let mut faults = Vec::new();
        if let Err(words) = good_name(name) {
            faults.push(document.fault_at_key(node, "matrix", words));
        }
        let settings = match node.child("key").filter(|key| key.text().is_some()) {
            Some(key_node) => values(document, &key, key_node, node),
            None => patches(document, &key, node),
        };
        match settings {
            Ok(settings) => {
                faults.extend(of_settings(document, &key, node, &settings));
                let name = name.to_owned();
                if faults.is_empty() { Ok(Axis { name, settings }) } else { Err(faults) }
            }
            Err(found) => Err(faults.into_iter().chain(found).collect()),
        }
    }

    /// Bytes of its longest name.
    pub fn longest_name(&self) -> usize {
        self.settings.iter().map(|(name, _)| name.len()).max().unwrap_or_default()
    }
}

/// What is wrong with the names, or how many there are.
fn of_settings(document: &Document, key: &str, node: &Node, settings: &[(String, Node)]) -> Vec<Fault> {
    let refuse = |message: String| vec![document.fault_at(node, key, message)];
    if settings.is_empty() {
        return refuse(format!("is {}, expected names with the keys each changes", node.words()));
    }
    if settings.len() > MOST_VARIANTS {
        return refuse(format!("comes to {} variants, expected at most {MOST_VARIANTS}", settings.len()));
    }
    let mut faults = Vec::new();
    // Some systems take `Dark` and `dark` for the same folder.
    let mut seen: BTreeMap<String, &str> = BTreeMap::new();
    for (name, patch) in settings {
        if let Err(words) = good_name(name) {
            faults.push(document.fault_at_key(patch, key, words));
        }
        if let Some(other) = seen.insert(name.to_lowercase(), name) {
            let words = format!("`{name}` and `{other}` are the same folder");
            faults.push(document.fault_at_key(patch, key, words));
        }
    }
    faults
}

/// Names with patches.
fn patches(document: &Document, key: &str, node: &Node) -> Result<Vec<(String, Node)>, Vec<Fault>> {
    let (mut settings, mut faults) = (Vec::new(), Vec::new());
    if !node.is_map() {
        let message = format!(
            "is {}, expected names with the keys each changes, or `key: KEY` with `values: [...]`",
            node.words()
        );
        return Err(vec![document.fault_at(node, key, message)]);
    }
    for (name, patch) in node.keys().filter_map(|name| Some((name, node.child(name)?))) {
        if !patch.is_map() && !patch.is_null() {
            let message =
                format!("is {}, expected the keys it changes, as `render: {{spp: 4}}`", patch.words());
            faults.push(document.fault_at(patch, &format!("{key}.{name}"), message));
            continue;
        }
        faults.extend(OF_ALL.into_iter().filter_map(|all| {
            let message = format!("`{all}` is the same for all variants; say it outside of `matrix`");
            Some(document.fault_at_key(patch.child(all)?, &format!("{key}.{name}"), message))
        }));
        settings.push((name.to_owned(), patch.clone()));
    }
    if faults.is_empty() { Ok(settings) } else { Err(faults) }
}

/// The short form: one key and the values it takes, which are their own names.
fn values(
    document: &Document,
    key: &str,
    key_node: &Node,
    node: &Node,
) -> Result<Vec<(String, Node)>, Vec<Fault>> {
    let mut faults = Vec::new();
    for (other, child) in node.keys().filter_map(|other| Some((other, node.child(other)?))) {
        if other != "key" && other != "values" {
            let message = unknown("key", other, ["key", "values"].into_iter());
            faults.push(document.fault_at_key(child, key, message));
        }
    }
    if let Err(message) = good_key(key_node.text().unwrap_or_default()) {
        faults.push(document.fault_at(key_node, &format!("{key}.key"), message));
    }
    let mut settings = Vec::new();
    let values = node.child("values");
    let list = values.and_then(Node::entries);
    for (index, value) in list.unwrap_or_default().iter().enumerate() {
        match value.written().filter(|name| !name.contains("${")) {
            Some(name) => settings.push((name.to_owned(), document.patch(key_node, value))),
            None => {
                let words = "has no name of its own; give it one: `values: {NAME: ..., ...}`".to_owned();
                faults.push(document.fault_at(value, &format!("{key}.values.{index}"), words));
            }
        }
    }
    let named = values.filter(|values| values.is_map());
    let named =
        named.into_iter().flat_map(|map| map.keys().filter_map(|name| Some((name, map.child(name)?))));
    settings.extend(named.map(|(name, value)| (name.to_owned(), document.patch(key_node, value))));
    if settings.is_empty() && faults.is_empty() {
        let message = match values {
            Some(values) => format!("is {}, expected a list of values, or names with values", values.words()),
            None => "is missing: a list of the values that `key` takes".to_owned(),
        };
        faults.push(document.fault_at(values.unwrap_or(node), &format!("{key}.values"), message));
    }
    if faults.is_empty() { Ok(settings) } else { Err(faults) }
}

/// Whether a text is a key that variants may differ in.
fn good_key(path: &str) -> Result<(), String> {
    let steps: Vec<&str> = path.split('.').collect();
    if steps.iter().any(|step| step.is_empty()) || steps.len() > DEEPEST_KEY {
        return Err(format!("`{path}` is no key, expected one as `render.spp`"));
    }
    match OF_ALL.into_iter().find(|all| steps.first() == Some(all)) {
        Some(all) => Err(format!("`{all}` is the same for all variants")),
        None => Ok(()),
    }
}

/// Whether a name is that of a folder, on every system, and of no file that is made beside it.
fn good_name(name: &str) -> Result<(), String> {
    let letters = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '+' | '.');
    // A point within a number is none of a file's ending.
    let points = name.split('.').skip(1).all(|rest| rest.starts_with(|c: char| c.is_ascii_digit()));
    let good = name.chars().all(letters) && points && !name.is_empty() && !name.starts_with('.');
    if !good {
        return Err(format!(
            "`{name}` is no name for a folder: letters, digits, `-`, `_`, `+`, and `.` before a digit"
        ));
    }
    if name.len() > LONGEST_NAME {
        return Err(format!("`{name}` is a name of {} bytes, expected at most {LONGEST_NAME}", name.len()));
    }
    if name.eq_ignore_ascii_case("frames") {
        return Err(format!("`{name}` is the folder of all frames"));
    }
    if is_device(name) {
        return Err(format!("`{name}` is a device's name on some systems, and none for a folder"));
    }
    Ok(())
}

/// Whether Windows takes a name for a device, whatever comes after a point.
fn is_device(name: &str) -> bool {
    let stem = name.split('.').next().unwrap_or_default().to_ascii_lowercase();
    let port = stem.strip_prefix("com").or_else(|| stem.strip_prefix("lpt"));
    matches!(&*stem, "con" | "prn" | "aux" | "nul")
        || port.is_some_and(|number| matches!(number.as_bytes(), [b'1'..=b'9']))
}
