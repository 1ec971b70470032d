//! The Curves objects of an archive and what is above them.

use std::collections::HashSet;

use ogawa::{Archive, CompoundReader, ObjectReader, OgawaError};

use crate::alembic::schema;

/// What the schema of a transform begins with; the number after it is its version.
const XFORM: &str = "AbcGeom_Xform";

/// Bytes that an object takes in a file, at least: its place, its header and a group with two digests.
const OBJECT_BYTES: usize = 64;

/// An object on the way to the curves.
#[derive(Clone, Copy)]
pub(super) struct Node<'a> {
    name: &'a str,
    pub(super) parent: Option<usize>,
    pub(super) xform: Option<CompoundReader<'a>>,
}

/// The objects of an archive.
#[derive(Default)]
pub(super) struct Tree<'a> {
    pub(super) nodes: Vec<Node<'a>>,
    /// Curves: their node and their geometry, in the order of the file.
    pub(super) curves: Vec<(usize, CompoundReader<'a>)>,
}

impl<'a> Tree<'a> {
    /// Goes through the whole archive.
    pub(super) fn new(archive: &'a Archive<'a>, file_len: usize) -> Result<Self, OgawaError> {
        let most = file_len / OBJECT_BYTES;
        let mut tree = Tree::default();
        let mut seen = HashSet::new();
        let mut open = vec![(archive.top().children()?, None)];
        while let Some((children, parent)) = open.last_mut() {
            let parent = *parent;
            let Some(child) = children.next() else {
                open.pop();
                continue;
            };
            let child = child?;
            if child.offset() != 0 && !seen.insert(child.offset()) {
                return Err(OgawaError::Property {
                    name: format!("{}/{}", tree.path(parent), child.name()),
                    found: format!("the object at byte {} a second time", child.offset()),
                    expected: "objects that hang in one place only".into(),
                });
            }
            if tree.nodes.len() >= most {
                return Err(OgawaError::Property {
                    name: format!("{}/{}", tree.path(parent), child.name()),
                    found: format!("more than {most} objects"),
                    expected: format!("one in {OBJECT_BYTES} bytes of the file at most"),
                });
            }
            let node = tree.add(child, parent)?;
            open.push((child.children()?, Some(node)));
        }
        Ok(tree)
    }

    fn add(&mut self, object: ObjectReader<'a>, parent: Option<usize>) -> Result<usize, OgawaError> {
        let schema = object.metadata().get("schema").unwrap_or_default();
        let mut node = Node { name: object.name(), parent, xform: None };
        let inside = |name: &str| -> Result<_, OgawaError> {
            object.properties()?.find(name)?.map(|compound| compound.compound()).transpose()
        };
        if schema.starts_with(XFORM) {
            node.xform = inside(schema::XFORM_COMPOUND)?;
        }
        let index = self.nodes.len();
        self.nodes.push(node);
        if schema == schema::CURVES
            && let Some(geometry) = inside(schema::GEOMETRY)?
        {
            self.curves.push((index, geometry));
        }
        Ok(index)
    }

    /// The path of a node, `/head/hair`.
    pub(super) fn path(&self, node: Option<usize>) -> String {
        let mut names = Vec::new();
        let mut next = node;
        while let Some(node) = next.and_then(|node| self.nodes.get(node)) {
            names.push(node.name);
            next = node.parent;
        }
        names.iter().rev().map(|name| format!("/{name}")).collect()
    }
}
