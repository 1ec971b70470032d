//! Crates, versions 0.4 to 0.13, as OpenUSD's `crateFile.cpp` lays them out.

mod bytes;
mod compression;
pub(crate) mod decode;
mod paths;
mod sections;
mod tree;
mod types;
mod value;

use crate::read::ReadError;
use crate::read::budget::Budget;
use crate::{Layer, Name};

/// What a crate is taken apart into.
pub(super) struct Parts {
    pub(super) tokens: Vec<Name>,
    pub(super) strings: Vec<u32>,
    pub(super) root: tree::Root,
}

pub(super) fn read(all: &[u8]) -> Result<Parts, ReadError> {
    let budget = &mut Budget::of(all.len());
    let sections = sections::read(all, budget)?;
    let paths = paths::build(&sections.paths, &sections.tokens, budget)?;
    let source = value::Source { all, sections: &sections, paths: &paths };
    let root = tree::build(&source, budget)?;
    Ok(Parts { root, tokens: sections.tokens, strings: sections.strings })
}

impl Parts {
    pub(super) fn into_layer<B>(self, bytes: B, start: usize, end: usize) -> Layer<B> {
        let Parts { tokens, strings, root } = self;
        Layer { bytes, start, end, tokens, strings, metadata: root.metadata, prims: root.prims }
    }
}
