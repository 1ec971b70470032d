//! `matrix`: axes of named settings, and what they come to together.

use strict_yaml::{Document, Node, nearest};

use crate::Fault;

/// More variants than this are taken for a slip: each is a folder of frames.
const MOST_VARIANTS: usize = 1000;
/// A name is that of a folder; with the others on the way to a frame it must stay a path that can be opened.
const LONGEST_NAME: usize = 64;
/// What is said once for all variants, and what puts a pipeline together.
const OF_ALL: [&str; 7] = ["version", "name", "output", "sheet", "page", "matrix", "include"];
/// The key beside the axes that says what is left out.
const EXCLUDE: &str = "exclude";

/// The axes of a pipeline, as they are written.
pub(super) struct Matrix {
    axes: Vec<Axis>,
    exclude: Option<Node>,
}

struct Axis {
    name: String,
    settings: Vec<(String, Node)>,
}

/// A setting of every axis.
pub(super) struct Combination {
    /// Their names, joined by `/`.
    pub id: String,
    /// Axis and name of each.
    pub axes: Vec<(String, String)>,
    /// The keys each lays over the pipeline.
    pub patches: Vec<Node>,
}

impl Matrix {
    /// Takes the matrix out of a document; without one it has no axes.
    pub fn of(document: &mut Document) -> Result<Matrix, Vec<Fault>> {
        let mut matrix = Matrix { axes: Vec::new(), exclude: None };
        let Some(node) = document.take("matrix").filter(|node| !node.is_null()) else { return Ok(matrix) };
        if !node.is_map() {
            let message = format!("is {}, expected axes: names with their settings", node.words());
            return Err(vec![document.fault_at(&node, "matrix", message)]);
        }
        let mut faults = Vec::new();
        for name in node.keys() {
            let Some(child) = node.child(name) else { continue };
            if name == EXCLUDE {
                matrix.exclude = Some(child.clone());
                continue;
            }
            match axis(document, name, child) {
                Ok(settings) => matrix.axes.push(Axis { name: name.to_owned(), settings }),
                Err(found) => faults.extend(found),
            }
        }
        if faults.is_empty() { Ok(matrix) } else { Err(faults) }
    }

    /// Every combination that is not left out, the last axis changing fastest; one without patches where there are
    /// no axes.
    pub fn combinations(&self, document: &Document) -> Result<Vec<Combination>, Vec<Fault>> {
        let excluded = self.excluded(document)?;
        let all = self.axes.iter().try_fold(1_usize, |count, axis| count.checked_mul(axis.settings.len()));
        let count = all.filter(|&count| count <= MOST_VARIANTS).ok_or_else(|| {
            let sizes: Vec<String> = self.axes.iter().map(|axis| axis.settings.len().to_string()).collect();
            let message =
                format!("comes to {} variants, expected at most {MOST_VARIANTS}", sizes.join(" x "));
            vec![document.fault("matrix", message)]
        })?;
        let chosen = |mut index: usize| {
            let mut chosen = vec![0; self.axes.len()];
            for (place, axis) in chosen.iter_mut().zip(&self.axes).rev() {
                *place = index % axis.settings.len();
                index /= axis.settings.len();
            }
            chosen
        };
        let left_out = |chosen: &[usize]| {
            let fits = |rule: &Vec<(usize, Vec<usize>)>| {
                rule.iter().all(|(axis, names)| chosen.get(*axis).is_some_and(|name| names.contains(name)))
            };
            excluded.iter().any(fits)
        };
        let kept = (0..count).map(chosen).filter(|chosen| !left_out(chosen));
        let combinations: Vec<Combination> = kept.map(|chosen| self.combination(&chosen)).collect();
        match (&self.exclude, combinations.is_empty()) {
            (Some(node), true) => {
                Err(vec![document.fault_at(node, "matrix.exclude", "leaves nothing".into())])
            }
            _ => Ok(combinations),
        }
    }

    fn combination(&self, chosen: &[usize]) -> Combination {
        let settings = self.axes.iter().zip(chosen).filter_map(|(axis, &index)| {
            let (name, patch) = axis.settings.get(index)?;
            Some(((axis.name.clone(), name.clone()), patch.clone()))
        });
        let (axes, patches): (Vec<(String, String)>, Vec<Node>) = settings.unzip();
        let names: Vec<&str> = axes.iter().map(|(_, name)| name.as_str()).collect();
        Combination { id: names.join("/"), axes, patches }
    }

    /// What is left out: rules of axes and the settings of theirs it is about, all by number.
    #[allow(clippy::type_complexity)] // rules of (axis, settings), said above
    fn excluded(&self, document: &Document) -> Result<Vec<Vec<(usize, Vec<usize>)>>, Vec<Fault>> {
        let Some(node) = self.exclude.as_ref().filter(|node| !node.is_null()) else { return Ok(Vec::new()) };
        let key = "matrix.exclude";
        let Some(entries) = node.entries() else {
            let message = format!("is {}, expected a list, as `[{{look: dark, light: sky}}]`", node.words());
            return Err(vec![document.fault_at(node, key, message)]);
        };
        let (mut rules, mut faults) = (Vec::new(), Vec::new());
        for (index, entry) in entries.iter().enumerate() {
            let key = format!("{key}.{index}");
            let mut rule = Vec::new();
            if entry.keys().next().is_none() {
                let message = format!("is {}, expected axes with names of their settings", entry.words());
                faults.push(document.fault_at(entry, &key, message));
            }
            for (axis, names) in entry.keys().filter_map(|axis| Some((axis, entry.child(axis)?))) {
                match self.rule(document, &key, axis, names) {
                    Ok(part) => rule.push(part),
                    Err(fault) => faults.push(fault),
                }
            }
            rules.push(rule);
        }
        if faults.is_empty() { Ok(rules) } else { Err(faults) }
    }

    fn rule(
        &self,
        document: &Document,
        key: &str,
        name: &str,
        names: &Node,
    ) -> Result<(usize, Vec<usize>), Fault> {
        let axis = self.axes.iter().position(|axis| axis.name == name).ok_or_else(|| {
            let message = unknown("axis", name, self.axes.iter().map(|axis| axis.name.as_str()));
            document.fault_at_key(names, key, message)
        })?;
        let settings = self.axes.get(axis).map_or(&[][..], |axis| &axis.settings);
        let number = |node: &Node| {
            let written = document.written(node).unwrap_or_default();
            settings.iter().position(|(name, _)| *name == written).ok_or_else(|| {
                let message = unknown("name", &written, settings.iter().map(|(name, _)| name.as_str()));
                document.fault_at(node, &format!("{key}.{name}"), message)
            })
        };
        let nodes = names.entries().unwrap_or(std::slice::from_ref(names));
        Ok((axis, nodes.iter().map(number).collect::<Result<Vec<usize>, Fault>>()?))
    }
}

fn unknown<'a>(kind: &str, name: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    match nearest(name, known.clone()) {
        Some(meant) => format!("unknown {kind} `{name}`, did you mean `{meant}`?"),
        None => {
            format!("unknown {kind} `{name}`, expected one of `{}`", known.collect::<Vec<_>>().join("`, `"))
        }
    }
}

/// The settings of an axis: names with the keys they lay over the pipeline.
fn axis(document: &Document, name: &str, node: &Node) -> Result<Vec<(String, Node)>, Vec<Fault>> {
    let key = format!("matrix.{name}");
    let mut faults = Vec::new();
    if let Err(words) = good_name(name) {
        faults.push(document.fault_at_key(node, "matrix", words));
    }
    let settings = match node.child("key").filter(|key| key.text().is_some()) {
        Some(key_node) => values(document, &key, key_node, node),
        None => patches(document, &key, node),
    };
    let settings = match settings {
        Ok(settings) => settings,
        Err(found) => {
            faults.extend(found);
            return Err(faults);
        }
    };
    let mut seen: Vec<(String, &str)> = Vec::new();
    for (name, patch) in &settings {
        if let Err(words) = good_name(name) {
            faults.push(document.fault_at_key(patch, &key, words));
        }
        // Some systems take `Dark` and `dark` for the same folder.
        let lower = name.to_lowercase();
        if let Some((_, other)) = seen.iter().find(|(seen, _)| *seen == lower) {
            faults.push(document.fault_at_key(
                patch,
                &key,
                format!("`{name}` and `{other}` are the same folder"),
            ));
        }
        seen.push((lower, name));
    }
    if settings.is_empty() {
        let message = format!("is {}, expected names with the keys each changes", node.words());
        faults.push(document.fault_at(node, &key, message));
    }
    if faults.is_empty() { Ok(settings) } else { Err(faults) }
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
    let path = key_node.text().unwrap_or_default();
    let mut faults = Vec::new();
    for (other, child) in node.keys().filter_map(|other| Some((other, node.child(other)?))) {
        if other != "key" && other != "values" {
            let message = unknown("key", other, ["key", "values"].into_iter());
            faults.push(document.fault_at_key(child, key, message));
        }
    }
    let steps: Vec<&str> = path.split('.').collect();
    if steps.iter().any(|step| step.is_empty()) || steps.len() > 16 {
        let message = format!("`{path}` is no key, expected one as `render.spp`");
        faults.push(document.fault_at(key_node, &format!("{key}.key"), message));
    } else if let Some(all) = OF_ALL.into_iter().find(|all| steps.first() == Some(all)) {
        let message = format!("`{all}` is the same for all variants");
        faults.push(document.fault_at(key_node, &format!("{key}.key"), message));
    }
    let mut settings = Vec::new();
    let values = node.child("values");
    let list = values.and_then(Node::entries);
    for (index, value) in list.unwrap_or_default().iter().enumerate() {
        match document.written(value).filter(|name| !name.contains("${")) {
            Some(name) => settings.push((name, document.patch(key_node, value))),
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
    if name.chars().count() > LONGEST_NAME {
        return Err(format!("a name of more than {LONGEST_NAME} letters"));
    }
    if name.eq_ignore_ascii_case("frames") {
        return Err(format!("`{name}` is the folder of all frames"));
    }
    Ok(())
}
