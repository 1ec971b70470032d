//! Objects and compounds, and how their tree becomes groups.

use std::io::{Seek, Write};

use super::ArchiveWriter;
use super::headers::{self, MetadataTable};
use super::property::{Changes, Content, Property, StoredSample};
use crate::{KEY, Metadata, OgawaError};

/// Named properties, in the order they were added.
#[derive(Clone, Debug, Default)]
pub struct Compound(Vec<Property>);

impl Compound {
    /// No properties.
    #[must_use]
    pub fn new() -> Self {
        Compound::default()
    }

    /// Adds a property.
    pub fn push(&mut self, property: Property) {
        self.0.push(property);
    }

    /// Whether there are no properties.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// A thing with properties and children.
#[derive(Clone, Debug)]
pub struct Object {
    name: String,
    metadata: Metadata,
    /// What it is made of.
    pub properties: Compound,
    /// What is below it, each with a name of its own.
    pub children: Vec<Object>,
}

impl Object {
    /// An object with nothing in it. Its name is one part of a path, without `/`.
    #[must_use]
    pub fn new(name: &str, metadata: Metadata) -> Self {
        Object { name: name.to_owned(), metadata, properties: Compound::new(), children: Vec::new() }
    }

    /// The object above all others; its name stands in no file.
    #[must_use]
    pub fn top() -> Self {
        Object::new("ABC", Metadata::new())
    }
}

/// The tree on its way into the file.
pub(super) struct Tree<'a, W> {
    pub(super) archive: &'a mut ArchiveWriter<W>,
    pub(super) table: &'a mut MetadataTable,
    /// The largest number of samples taken at each of the archive's times.
    pub(super) samples: Vec<u32>,
}

/// A name for content: equal trees have equal digests. Readers use it to find copies and check it against
/// nothing.
type Digest = [u8; KEY];

impl<W: Write + Seek> Tree<'_, W> {
    /// Writes an object: the place of its group, and its digest.
    pub(super) fn object(&mut self, object: &Object) -> Result<(u64, Digest), OgawaError> {
        let (properties, of_properties) = self.compound(&object.properties)?;
        let mut children = vec![properties];
        let (mut bytes, mut below) = (Vec::new(), blake3::Hasher::new());
        for child in &object.children {
            let (place, digest) = self.object(child)?;
            children.push(place);
            below.update(&digest);
            headers::object(&child.name, &child.metadata, self.table, &mut bytes)?;
        }
        below.update(&bytes);
        let of_children = short(&below);
        bytes.extend(of_properties);
        bytes.extend(of_children);
        children.push(self.archive.data(&bytes)?);
        let mut whole = blake3::Hasher::new();
        whole.update(&of_properties).update(&of_children);
        Ok((self.archive.group(&children)?, short(&whole)))
    }

    fn compound(&mut self, compound: &Compound) -> Result<(u64, Digest), OgawaError> {
        let (mut children, mut bytes, mut digest) = (Vec::new(), Vec::new(), blake3::Hasher::new());
        for property in &compound.0 {
            children.push(self.property(property, &mut digest)?);
            headers::property(property, self.table, &mut bytes)?;
        }
        digest.update(&bytes);
        if !bytes.is_empty() {
            children.push(self.archive.data(&bytes)?);
        }
        Ok((self.archive.group(&children)?, short(&digest)))
    }

    fn property(&mut self, property: &Property, digest: &mut blake3::Hasher) -> Result<u64, OgawaError> {
        match &property.content {
            Content::Compound(compound) => {
                let (place, of_compound) = self.compound(compound)?;
                digest.update(&of_compound);
                Ok(place)
            }
            Content::Scalar(_, samples) => self.samples_of(property, samples, false, digest),
            Content::Array(_, samples) => self.samples_of(property, samples, true, digest),
        }
    }

    fn samples_of(
        &mut self,
        property: &Property,
        samples: &[StoredSample],
        dimensions: bool,
        digest: &mut blake3::Hasher,
    ) -> Result<u64, OgawaError> {
        self.note_times(property, samples)?;
        let mut children = Vec::new();
        for sample in Changes::of(samples).stored(samples) {
            digest.update(&sample.key);
            children.push(sample.place);
            if dimensions {
                let count = sample.dimensions().filter(|_| !sample.is_empty());
                children.push(match count {
                    Some(count) => self.archive.data(&count.to_le_bytes())?,
                    None => self.archive.data(&[])?,
                });
            }
        }
        self.archive.group(&children)
    }

    /// Counts samples for their times, as the official library does: constants count once.
    fn note_times(&mut self, property: &Property, samples: &[StoredSample]) -> Result<(), OgawaError> {
        let times = property.times as usize;
        let known = self.archive.times_known();
        if times >= known {
            return Err(OgawaError::Property {
                name: property.name.clone(),
                found: format!("times {times}"),
                expected: format!("one of the {known} the archive knows"),
            });
        }
        let constant = Changes::of(samples).last == 0;
        let count = if constant { samples.len().min(1) } else { samples.len() };
        if self.samples.len() <= times {
            self.samples.resize(times + 1, 0);
        }
        self.samples[times] = self.samples[times].max(count as u32);
        Ok(())
    }
}

fn short(hasher: &blake3::Hasher) -> Digest {
    let mut digest = [0; KEY];
    digest.copy_from_slice(&hasher.finalize().as_bytes()[..KEY]);
    digest
}
