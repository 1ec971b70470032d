//! A tree of values as a plain struct; every fault in it, not only the first.

use serde::de::DeserializeOwned;

use crate::fault::{Fault, MOST_FAULTS};
use crate::source::{Part, Sources};
use crate::tree::{Node, Value};
use crate::typed::{Error, Typed};
use crate::words;

/// A struct read from a tree as far as that was possible.
#[derive(Clone, Debug)]
pub struct Reading<T> {
    /// What was read; keys with a fault are as if they were not there. `None` where not even that can be
    /// had: the struct has no defaults for them.
    pub value: Option<T>,
    /// The faults, in the order they were met.
    pub faults: Vec<Fault>,
    /// The keys that were left out of `value` for their faults, as `render.spp`.
    pub left_out: Vec<String>,
}

/// Reads a `T`. What cannot be read is told and left out, and the rest read again, until it can be.
pub(crate) fn read<T: DeserializeOwned>(sources: &Sources, root: &Node) -> Reading<T> {
    let mut tree = root.clone();
    let (mut faults, mut left_out) = (Vec::new(), Vec::new());
    loop {
        let mut error = match T::deserialize(Typed(&tree)) {
            Ok(value) => return Reading { value: Some(value), faults, left_out },
            Err(error) => error,
        };
        error.path.reverse();
        let steps: Vec<&str> = error.path.iter().map(String::as_str).collect();
        // That a key is missing which was left out is no fault of its own.
        let missed = error.message.strip_prefix("missing field `").and_then(|rest| rest.strip_suffix('`'));
        let follows = missed.is_some_and(|name| {
            let key: Vec<&str> = steps.iter().copied().chain([name]).collect();
            left_out.contains(&key.join("."))
        });
        if !follows {
            faults.push(told(sources, &tree, &steps, &error));
        }
        let out = remove(&mut tree, &steps);
        let stuck = out.is_none() || faults.len() >= MOST_FAULTS;
        left_out.extend(out);
        if stuck {
            return Reading { value: None, faults, left_out };
        }
    }
}

fn told(sources: &Sources, tree: &Node, steps: &[&str], error: &Error) -> Fault {
    let key = if error.at_key { &steps[..steps.len().saturating_sub(1)] } else { steps };
    let part = if error.at_key { Part::Key } else { Part::Value };
    let node = steps.iter().try_fold(tree, |node, step| node.child(step)).unwrap_or(tree);
    sources.fault(&node.origin, part, &key.join("."), words::plain(&error.message))
}

/// Takes out of the tree the innermost key of a mapping on the way; which one that was.
fn remove(tree: &mut Node, steps: &[&str]) -> Option<String> {
    let inner = (0..steps.len()).rev().find(|&i| {
        let above = steps.get(..i).unwrap_or_default();
        above.iter().try_fold(&*tree, |node, step| node.child(step)).is_some_and(Node::is_map)
    })?;
    let (above, rest) = steps.split_at(inner);
    let node = above.iter().try_fold(tree, |node, step| node.child_mut(step))?;
    let Value::Map(map) = &mut node.value else { return None };
    map.shift_remove(*rest.first()?)?;
    Some(steps.get(..=inner)?.join("."))
}
