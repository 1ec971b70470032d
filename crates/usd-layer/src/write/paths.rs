//! The tree of paths.

use std::collections::HashMap;

use crate::write::WriteError;
use crate::write::tokens::Tokens;

/// Every path of a layer, parents before children; the first is the root.
#[derive(Debug)]
pub(super) struct Paths {
    numbers: HashMap<String, u32>,
    entries: Vec<Entry>,
}

#[derive(Debug)]
struct Entry {
    name: String,
    is_property: bool,
    children: Vec<u32>,
}

/// The tree, flattened depth first.
#[derive(Debug, Default)]
pub(super) struct Flat {
    /// Which path each place is.
    pub paths: Vec<i32>,
    /// The token of its name; negative for properties.
    pub names: Vec<i32>,
    /// 0: a sibling follows; -1: a child follows; -2: neither; more: a child follows, the next sibling this far on.
    pub jumps: Vec<i32>,
}

impl Paths {
    pub fn new() -> Self {
        let root = Entry { name: String::new(), is_property: false, children: Vec::new() };
        Paths { numbers: HashMap::from([("/".to_owned(), 0)]), entries: vec![root] }
    }

    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// The number of the prim at `path`, which starts with `/`.
    pub fn prim(&mut self, path: &str) -> Result<u32, WriteError> {
        let names = path.strip_prefix('/').filter(|names| names.is_empty() || names.split('/').all(is_name));
        let Some(names) = names else {
            let expected = "`/` and names of letters, digits and `_` between `/`";
            return Err(WriteError::Path { path: path.to_owned(), what: "prim", expected });
        };
        let mut parent = 0;
        let mut end = 0;
        for name in names.split('/').filter(|name| !name.is_empty()) {
            end += 1 + name.len();
            parent = self.child(parent, &path[..end], name, false);
        }
        Ok(parent)
    }

    /// The number of the property at `path`: a prim's, a dot and names between colons.
    pub fn property(&mut self, path: &str) -> Result<u32, WriteError> {
        let parts = path.split_once('.').filter(|(prim, name)| *prim != "/" && name.split(':').all(is_name));
        let Some((prim, name)) = parts else {
            let expected = "the path of a prim, `.`, and names of letters, digits and `_` between `:`";
            return Err(WriteError::Path { path: path.to_owned(), what: "property", expected });
        };
        let parent = self.prim(prim)?;
        Ok(self.child(parent, path, name, true))
    }

    /// The number of a prim or a property.
    pub fn any(&mut self, path: &str) -> Result<u32, WriteError> {
        if path.contains('.') { self.property(path) } else { self.prim(path) }
    }

    fn child(&mut self, parent: u32, path: &str, name: &str, is_property: bool) -> u32 {
        if let Some(&number) = self.numbers.get(path) {
            return number;
        }
        let number = self.entries.len() as u32;
        self.numbers.insert(path.to_owned(), number);
        self.entries.push(Entry { name: name.to_owned(), is_property, children: Vec::new() });
        if let Some(parent) = self.entries.get_mut(parent as usize) {
            parent.children.push(number);
        }
        number
    }

    /// The tree for the file.
    pub fn flatten(&self, tokens: &mut Tokens) -> Flat {
        // Children come after their parents, so sizes add up from the end.
        let mut sizes = vec![1_i32; self.entries.len()];
        for (number, entry) in self.entries.iter().enumerate().rev() {
            sizes[number] += entry.children.iter().map(|&child| sizes[child as usize]).sum::<i32>();
        }
        let mut flat = Flat::default();
        let mut waiting = vec![(0_u32, false)];
        while let Some((number, has_sibling)) = waiting.pop() {
            let entry = &self.entries[number as usize];
            let name = if number == 0 { 0 } else { tokens.token(&entry.name).cast_signed() };
            flat.paths.push(number.cast_signed());
            flat.names.push(if entry.is_property { -name } else { name });
            flat.jumps.push(match (entry.children.is_empty(), has_sibling) {
                (true, true) => 0,
                (true, false) => -2,
                (false, false) => -1,
                (false, true) => sizes[number as usize],
            });
            let last = entry.children.len().saturating_sub(1);
            let children = entry.children.iter().enumerate().rev();
            waiting.extend(children.map(|(place, &child)| (child, place < last)));
        }
        flat
    }
}

/// Whether `name` can stand in a path: letters, digits and `_`, no digit first.
fn is_name(name: &str) -> bool {
    let good = |c: char| c == '_' || c.is_alphanumeric();
    name.chars().all(good) && name.chars().next().is_some_and(|c| !c.is_numeric())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn broken_paths_are_refused() {
        let mut paths = Paths::new();
        for path in ["", "a", "/a/", "//a", "/a b", "/1", "/a.b"] {
            assert!(paths.prim(path).is_err(), "{path}");
        }
        for path in ["/a", "/.x", "/a.", "/a.b:", "/a.b.c", "a.b", "/a.b c"] {
            assert!(paths.property(path).is_err(), "{path}");
        }
        assert_eq!((paths.prim("/").unwrap(), paths.prim("/a/b").unwrap()), (0, 2));
        assert_eq!((paths.property("/a.c:d").unwrap(), paths.any("/a/b").unwrap()), (3, 2));
    }

    #[test]
    fn the_tree_is_flat() {
        let (mut paths, mut tokens) = (Paths::new(), Tokens::new());
        for path in ["/a/b", "/a.x", "/c", "/a/b/d"] {
            paths.any(path).unwrap();
        }
        let flat = paths.flatten(&mut tokens);
        assert_eq!(flat.paths, [0, 1, 2, 5, 3, 4], "/, a, b, d, a.x, c");
        assert_eq!(flat.jumps, [-1, 4, 2, -2, -2, -2]);
        let [b, x] = ["b", "x"].map(|name| tokens.token(name).cast_signed());
        assert_eq!((flat.names[0], flat.names[2], flat.names[4]), (0, b, -x));
    }
}
