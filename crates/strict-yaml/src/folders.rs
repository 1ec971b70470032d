//! Paths that count from the file they are written in.

use std::path::Path;

use crate::document::Document;
use crate::include::normal;
use crate::source::Sources;
use crate::tree::{Node, Value};

impl Document {
    /// The folder of the file in which a node was written, from the folder of the document's first file:
    /// empty for what was written there or in a setting. A path in the node is relative to it.
    #[must_use]
    pub fn folder_of(&self, node: &Node) -> &Path {
        self.sources.texts.get(node.origin.source).map_or(Path::new(""), |source| &source.folder)
    }

    /// Makes the paths at these keys count from the folder of the document's first file, wherever they were
    /// written: they are joined to [`Document::folder_of`] them. A `*` stands for every entry.
    pub fn join_folders(&mut self, keys: &[&str]) {
        for key in keys {
            let steps: Vec<&str> = key.split('.').collect();
            join_folder(&mut self.root, &steps, &self.sources);
        }
    }
}

fn join_folder(node: &mut Node, steps: &[&str], sources: &Sources) {
    match (steps, &mut node.value) {
        ([], Value::Text(path)) => {
            let folder = sources.texts.get(node.origin.source).map(|source| source.folder.as_path());
            if let Some(joined) = folder.map(|folder| normal(&folder.join(&*path)))
                && folder != Some(Path::new(""))
            {
                *path = joined.to_string_lossy().into_owned();
            }
        }
        (["*", rest @ ..], Value::List(list)) => {
            list.iter_mut().for_each(|node| join_folder(node, rest, sources));
        }
        ([first, rest @ ..], _) => {
            if let Some(child) = node.child_mut(first) {
                join_folder(child, rest, sources);
            }
        }
        _ => {}
    }
}
