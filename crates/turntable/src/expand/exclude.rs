//! `matrix.exclude`: combinations that are no variants.

use strict_yaml::{Document, Node};

use super::axis::Axis;
use super::matrix::unknown;
use crate::Fault;

/// What is left out: of every axis that is named, one of the settings named for it.
pub(super) struct Rule(Vec<Part>);

/// An axis and some of its settings, by number.
struct Part {
    axis: usize,
    settings: Vec<usize>,
}

impl Rule {
    /// Whether it leaves out the combination that has these settings, one of each axis.
    pub fn fits(&self, chosen: &[usize]) -> bool {
        let fits = |part: &Part| chosen.get(part.axis).is_some_and(|name| part.settings.contains(name));
        self.0.iter().all(fits)
    }
}

/// The rules that `exclude` holds, about these axes.
pub(super) fn rules(document: &Document, node: &Node, axes: &[Axis]) -> Result<Vec<Rule>, Vec<Fault>> {
    let key = "matrix.exclude";
    let Some(entries) = node.entries() else {
        let message = format!("is {}, expected a list, as `[{{look: dark, light: sky}}]`", node.words());
        return Err(vec![document.fault_at(node, key, message)]);
    };
    let (mut rules, mut faults) = (Vec::new(), Vec::new());
    for (index, entry) in entries.iter().enumerate() {
        let key = format!("{key}.{index}");
        if entry.keys().next().is_none() {
            let message = format!("is {}, expected axes with names of their settings", entry.words());
            faults.push(document.fault_at(entry, &key, message));
        }
        let mut rule = Vec::new();
        for (axis, names) in entry.keys().filter_map(|axis| Some((axis, entry.child(axis)?))) {
            match part(document, &key, axis, names, axes) {
                Ok(part) => rule.push(part),
                Err(fault) => faults.push(fault),
            }
        }
        rules.push(Rule(rule));
    }
    if faults.is_empty() { Ok(rules) } else { Err(faults) }
}

fn part(document: &Document, key: &str, name: &str, names: &Node, axes: &[Axis]) -> Result<Part, Fault> {
    let known = axes.iter().map(|axis| axis.name.as_str());
    let of = axes.iter().enumerate().find(|(_, axis)| axis.name == name);
    let (axis, Axis { settings, .. }) =
        of.ok_or_else(|| document.fault_at_key(names, key, unknown("axis", name, known)))?;
    let number = |node: &Node| {
        let written = node.written().unwrap_or_default();
        settings.iter().position(|(name, _)| *name == written).ok_or_else(|| {
            let message = unknown("name", written, settings.iter().map(|(name, _)| name.as_str()));
            document.fault_at(node, &format!("{key}.{name}"), message)
        })
    };
    let nodes = names.entries().unwrap_or(std::slice::from_ref(names));
    Ok(Part { axis, settings: nodes.iter().map(number).collect::<Result<Vec<usize>, Fault>>()? })
}
