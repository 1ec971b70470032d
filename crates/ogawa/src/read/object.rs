//! Objects of an archive.

use super::archive::Archive;
use super::cursor::Cursor;
use super::group::Group;
use super::headers;
use super::property::CompoundReader;
use crate::{MetadataText, OgawaError};

/// Objects in objects and compounds in compounds a file may have; far more than any scene has.
pub(super) const DEEPEST: u32 = 256;

/// An object of an archive.
#[derive(Clone, Copy, Debug)]
pub struct ObjectReader<'a> {
    archive: &'a Archive<'a>,
    group: Group<'a>,
    name: &'a str,
    metadata: MetadataText<'a>,
    depth: u32,
}

/// The children of an object, one after another.
#[derive(Clone, Debug)]
pub struct Children<'a> {
    parent: ObjectReader<'a>,
    headers: Cursor<'a>,
    /// The child that comes next.
    next: usize,
}

impl<'a> ObjectReader<'a> {
    pub(super) fn top(archive: &'a Archive<'a>, group: Group<'a>) -> Self {
        ObjectReader { archive, group, name: "", metadata: archive.metadata(), depth: 0 }
    }

    /// Its name, the last part of its path; empty for the top.
    #[must_use]
    pub fn name(&self) -> &'a str {
        self.name
    }

    /// Words about it; `schema` says what it is.
    #[must_use]
    pub fn metadata(&self) -> MetadataText<'a> {
        self.metadata
    }

    /// Where its bytes stand in the file: objects at the same place are the same object, which a sound file
    /// reaches on one way only; 0 for an object of nothing.
    #[must_use]
    pub fn offset(&self) -> u64 {
        self.group.offset
    }

    /// What it is made of.
    ///
    /// # Errors
    /// [`OgawaError::Invalid`].
    pub fn properties(&self) -> Result<CompoundReader<'a>, OgawaError> {
        let group = match self.group.len() {
            0 => self.group,
            _ => self.group.group(0, "properties of an object")?,
        };
        CompoundReader::new(self.archive, group, 0)
    }

    /// What is below it.
    ///
    /// A broken file may hang an object below itself: whoever goes down the whole tree keeps the
    /// [`ObjectReader::offset`]s seen.
    ///
    /// # Errors
    /// [`OgawaError::Invalid`], also for a tree deeper than 256 objects; a child may bring one too.
    pub fn children(&self) -> Result<Children<'a>, OgawaError> {
        let headers = headers::of_objects(self.group)?;
        if !headers.is_empty() && self.depth >= DEEPEST {
            let (offset, found) = (self.group.offset, format!("more than {DEEPEST} objects in each other"));
            return Err(OgawaError::invalid(offset, "objects", found, "fewer, and no object in itself"));
        }
        Ok(Children { parent: *self, headers, next: 1 })
    }
}

impl<'a> Iterator for Children<'a> {
    type Item = Result<ObjectReader<'a>, OgawaError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.headers.is_empty() {
            return None;
        }
        let child = self.child();
        if child.is_err() {
            self.headers = Cursor::new(&[], self.headers.offset());
        }
        Some(child)
    }
}

impl<'a> Children<'a> {
    fn child(&mut self) -> Result<ObjectReader<'a>, OgawaError> {
        let ObjectReader { archive, group, depth, .. } = self.parent;
        let (name, metadata) = headers::object(&mut self.headers, &archive.table)?;
        let group = group.group(self.next, "child object")?;
        self.next += 1;
        Ok(ObjectReader { archive, group, name, metadata, depth: depth + 1 })
    }
}
