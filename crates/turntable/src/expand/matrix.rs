//! `matrix`: axes of named settings, and what they come to together.

use strict_yaml::{Document, Node, nearest};

use super::axis::Axis;
use super::exclude::{self, Rule};
use crate::Fault;

/// More variants than this are taken for a slip: each is a folder of frames.
pub(super) const MOST_VARIANTS: usize = 1000;
/// Bytes of a variant's path, which has more before and behind it on its way to a file: systems open no path of
/// more than a few thousand.
const LONGEST_ID: usize = 1000;
/// The key beside the axes that says what is left out.
const EXCLUDE: &str = "exclude";

/// The axes of a pipeline, as they are written.
pub(super) struct Matrix {
    axes: Vec<Axis>,
    exclude: Option<Node>,
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
            match Axis::of(document, name, child) {
                Ok(axis) => matrix.axes.push(axis),
                Err(found) => faults.extend(found),
            }
        }
        if faults.is_empty() { Ok(matrix) } else { Err(faults) }
    }

    /// Every combination that is not left out, the last axis changing fastest; one without patches where there are
    /// no axes.
    pub fn combinations(&self, document: &Document) -> Result<Vec<Combination>, Vec<Fault>> {
        let count = self.count(document)?;
        let rules = match self.exclude.as_ref().filter(|node| !node.is_null()) {
            Some(node) => exclude::rules(document, node, &self.axes)?,
            None => Vec::new(),
        };
        let kept = (0..count).map(|index| self.chosen(index));
        let kept = kept.filter(|chosen| !rules.iter().any(|rule: &Rule| rule.fits(chosen)));
        let combinations: Vec<Combination> = kept.map(|chosen| self.combination(&chosen)).collect();
        match (&self.exclude, combinations.is_empty()) {
            (Some(node), true) => {
                Err(vec![document.fault_at(node, "matrix.exclude", "leaves nothing".into())])
            }
            _ => Ok(combinations),
        }
    }

    /// How many combinations there are, with those that are left out.
    fn count(&self, document: &Document) -> Result<usize, Vec<Fault>> {
        let refuse = |message: String| Err(vec![document.fault("matrix", message)]);
        let longest: usize = self.axes.iter().map(|axis| axis.longest_name() + 1).sum();
        if longest > LONGEST_ID {
            return refuse(format!(
                "comes to folders whose names are {longest} bytes long together, expected at most {LONGEST_ID}"
            ));
        }
        let all = self.axes.iter().try_fold(1_usize, |count, axis| count.checked_mul(axis.settings.len()));
        match all.filter(|&count| count <= MOST_VARIANTS) {
            Some(count) => Ok(count),
            None => {
                let sizes: Vec<String> =
                    self.axes.iter().map(|axis| axis.settings.len().to_string()).collect();
                refuse(format!("comes to {} variants, expected at most {MOST_VARIANTS}", sizes.join(" x ")))
            }
        }
    }

    /// Which setting of each axis the combination of that number has.
    fn chosen(&self, mut index: usize) -> Vec<usize> {
        let mut chosen = vec![0; self.axes.len()];
        for (place, axis) in chosen.iter_mut().zip(&self.axes).rev() {
            *place = index % axis.settings.len();
            index /= axis.settings.len();
        }
        chosen
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
}

/// Words for a name that is not there, with the one that may have been meant.
pub(super) fn unknown<'a>(kind: &str, name: &str, known: impl Iterator<Item = &'a str> + Clone) -> String {
    match nearest(name, known.clone()) {
        Some(meant) => format!("unknown {kind} `{name}`, did you mean `{meant}`?"),
        None => {
            format!("unknown {kind} `{name}`, expected one of `{}`", known.collect::<Vec<_>>().join("`, `"))
        }
    }
}
