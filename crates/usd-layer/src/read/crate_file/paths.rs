//! The tree of paths.
//!
//! Paths are stored depth first. An entry has an index, the token of its last element (negative for a
//! property) and a jump: -2 is a leaf, -1 has a child (the next entry), 0 a sibling (the next entry), and a
//! positive jump a child next and a sibling that far away.

use super::compression::too_much;
use super::sections::EncodedPaths;
use crate::Name;
use crate::read::ReadError;
use crate::read::budget::Budget;

/// Deeper trees are refused: no stage has them, and what walks trees calls itself.
const DEEPEST: u32 = 256;

/// No node.
pub(super) const NONE: u32 = u32::MAX;

/// The last element of a path and the path before it.
#[derive(Clone, Copy)]
pub(super) struct Node {
    pub(super) parent: u32,
    pub(super) token: u32,
    pub(super) property: bool,
    pub(super) known: bool,
}

/// The paths by index, and their indices in the stored order (parents first).
pub(super) struct Paths {
    pub(super) nodes: Vec<Node>,
    pub(super) order: Vec<u32>,
}

pub(super) fn build(stored: &EncodedPaths, tokens: &[Name], budget: &mut Budget) -> Result<Paths, ReadError> {
    let entries = stored.indices.len();
    let cost = 16 * stored.count as u64 + 20 * entries as u64;
    budget.take(cost, || too_much(stored.at, cost, "paths"))?;
    let fault = |entry: usize, found: String, expected: &str| {
        Err(ReadError::byte(stored.at, format!("{found} at path {entry}"), expected))
    };
    let unknown = Node { parent: NONE, token: 0, property: false, known: false };
    let mut nodes = vec![unknown; stored.count];
    let mut order = Vec::with_capacity(entries);
    // Siblings that come later: entry, parent, depth.
    let mut later: Vec<(usize, u32, u32)> = Vec::new();
    let mut next = Some((0, NONE, 0)).filter(|_| entries > 0);
    while let Some((entry, parent, depth)) = next.take().or_else(|| later.pop()) {
        let (Some(&index), Some(&element), Some(&jump)) =
            (stored.indices.get(entry), stored.elements.get(entry), stored.jumps.get(entry))
        else {
            return fault(entry, "no entry".into(), "as many as the tree has");
        };
        let token = element.unsigned_abs();
        match nodes.get_mut(index as usize) {
            Some(node) if !node.known => {
                *node = Node { parent, token, property: element < 0, known: true };
            }
            Some(_) => return fault(entry, format!("index {index} again"), "every index once"),
            None => return fault(entry, format!("index {index}"), "one below the number of paths"),
        }
        if token as usize >= tokens.len() {
            return fault(entry, format!("token {token}"), "one of the file's tokens");
        }
        if depth > DEEPEST {
            return fault(entry, format!("a prim {depth} deep"), "256 at most");
        }
        order.push(index);
        let child = (entry + 1, index, depth + 1);
        match jump {
            -2 => {}
            -1 => next = Some(child),
            0 => next = Some((entry + 1, parent, depth)),
            1.. => {
                later.push((entry + jump as usize, parent, depth));
                next = Some(child);
            }
            _ => return fault(entry, format!("a jump of {jump}"), "-2 or more"),
        }
    }
    Ok(Paths { nodes, order })
}

impl Paths {
    /// The text of a path; `None` for an index that stands for none.
    pub(super) fn text(&self, index: u32, tokens: &[Name]) -> Option<String> {
        let mut elements = Vec::new();
        let mut at = index;
        while let Some(node) = self.nodes.get(at as usize).filter(|node| node.known) {
            if node.parent == NONE {
                break;
            }
            elements.push((tokens.get(node.token as usize)?, node.property));
            at = node.parent;
        }
        if !self.nodes.get(index as usize)?.known {
            return None;
        }
        if elements.is_empty() {
            return Some("/".to_owned());
        }
        let mut text = String::new();
        for (element, property) in elements.into_iter().rev() {
            match property {
                true => text.push('.'),
                // A variant, and what is in it, follows without a slash.
                false if element.starts_with('{') || text.ends_with('}') => {}
                false => text.push('/'),
            }
            text.push_str(element);
        }
        Some(text)
    }
}
