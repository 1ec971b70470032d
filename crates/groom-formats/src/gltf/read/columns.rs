//! Values of vertices, gathered from primitive to primitive.

use std::collections::BTreeMap;

use glam::{Vec2, Vec3};
use groom::Values;

/// Attributes by their name in the file; `ALPHA` stands for the fourth channel of COLOR_0.
#[derive(Debug, Default)]
pub(super) struct Columns {
    columns: BTreeMap<String, Column>,
    /// Names that had two types.
    pub(super) torn: Vec<String>,
}

/// One attribute, one value a vertex.
#[derive(Debug)]
pub(super) struct Column {
    pub(super) values: Values,
    /// Whether some vertices had none.
    pub(super) is_filled: bool,
}

impl Columns {
    /// Adds the values of the vertices after the first `before`.
    pub(super) fn add(&mut self, name: &str, values: Values, before: usize) {
        if self.torn.iter().any(|torn| torn == name) {
            return;
        }
        let Some(column) = self.columns.get_mut(name) else {
            let mut column = Column { values, is_filled: false };
            if before > 0 {
                let added = std::mem::replace(&mut column.values, Values::Float(Vec::new()));
                column.values = empty_like(&added);
                column.fill(before, name);
                append(&mut column.values, added);
            }
            self.columns.insert(name.to_owned(), column);
            return;
        };
        column.fill(before, name);
        if !append(&mut column.values, values) {
            self.columns.remove(name);
            self.torn.push(name.to_owned());
        }
    }

    /// All columns, each of `points` values.
    pub(super) fn finish(mut self, points: usize) -> BTreeMap<String, Column> {
        for (name, column) in &mut self.columns {
            column.fill(points, name);
        }
        self.columns
    }
}

impl Column {
    /// Makes values up to `len`: white for colours, 0 for the rest.
    fn fill(&mut self, len: usize, name: &str) {
        self.is_filled |= self.values.len() < len;
        let is_color = name.starts_with("COLOR_");
        match &mut self.values {
            Values::Float(v) => v.resize(len.max(v.len()), 0.0),
            Values::Vec2(v) => v.resize(len.max(v.len()), Vec2::ZERO),
            Values::Vec3(v) => v.resize(len.max(v.len()), if is_color { Vec3::ONE } else { Vec3::ZERO }),
            Values::Int(v) => v.resize(len.max(v.len()), 0),
        }
    }
}

fn empty_like(values: &Values) -> Values {
    match values {
        Values::Float(_) => Values::Float(Vec::new()),
        Values::Vec2(_) => Values::Vec2(Vec::new()),
        Values::Vec3(_) => Values::Vec3(Vec::new()),
        Values::Int(_) => Values::Int(Vec::new()),
    }
}

/// `false` when the types differ.
fn append(to: &mut Values, from: Values) -> bool {
    match (to, from) {
        (Values::Float(to), Values::Float(mut from)) => to.append(&mut from),
        (Values::Vec2(to), Values::Vec2(mut from)) => to.append(&mut from),
        (Values::Vec3(to), Values::Vec3(mut from)) => to.append(&mut from),
        (Values::Int(to), Values::Int(mut from)) => to.append(&mut from),
        _ => return false,
    }
    true
}
