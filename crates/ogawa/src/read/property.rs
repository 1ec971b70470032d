//! Properties of an object.

use super::archive::Archive;
use super::cursor::Cursor;
use super::group::Group;
use super::headers::{self, PropertyHeader, ValuesHeader};
use super::object::DEEPEST;
use super::sample::Sample;
use crate::{DataType, MetadataText, OgawaError, TimeSampling};

/// Named properties.
#[derive(Clone, Copy, Debug)]
pub struct CompoundReader<'a> {
    archive: &'a Archive<'a>,
    group: Group<'a>,
    headers: Cursor<'a>,
    depth: u32,
}

/// What a property is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PropertyKind {
    /// Properties.
    Compound,
    /// One value a sample.
    Scalar,
    /// An array of values a sample.
    Array,
}

/// A property of an object.
#[derive(Clone, Copy, Debug)]
pub struct PropertyReader<'a> {
    archive: &'a Archive<'a>,
    parent: Group<'a>,
    index: usize,
    header: PropertyHeader<'a>,
    depth: u32,
}

impl<'a> CompoundReader<'a> {
    pub(super) fn new(archive: &'a Archive<'a>, group: Group<'a>, depth: u32) -> Result<Self, OgawaError> {
        Ok(CompoundReader { archive, group, headers: headers::of_properties(group)?, depth })
    }

    /// The properties in the order of the file; a broken one is the last.
    pub fn iter(&self) -> impl Iterator<Item = Result<PropertyReader<'a>, OgawaError>> + use<'a> {
        let CompoundReader { archive, group: parent, mut headers, depth } = *self;
        let mut index = 0;
        std::iter::from_fn(move || {
            if headers.is_empty() {
                return None;
            }
            let header = headers::property(&mut headers, &archive.table);
            if header.is_err() {
                headers = Cursor::new(&[], headers.offset());
            }
            index += 1;
            Some(header.map(|header| PropertyReader { archive, parent, index: index - 1, header, depth }))
        })
    }

    /// The property of a name.
    ///
    /// # Errors
    /// [`OgawaError::Invalid`] for a broken property on the way to it.
    pub fn find(&self, name: &str) -> Result<Option<PropertyReader<'a>>, OgawaError> {
        self.iter().find(|property| property.as_ref().map_or(true, |p| p.name() == name)).transpose()
    }
}

impl<'a> PropertyReader<'a> {
    /// Its name.
    #[must_use]
    pub fn name(&self) -> &'a str {
        self.header.name
    }

    /// Words about it.
    #[must_use]
    pub fn metadata(&self) -> MetadataText<'a> {
        self.header.metadata
    }

    /// What it is.
    #[must_use]
    pub fn kind(&self) -> PropertyKind {
        match self.header.values {
            None => PropertyKind::Compound,
            Some(values) if values.is_array => PropertyKind::Array,
            Some(_) => PropertyKind::Scalar,
        }
    }

    /// The type of its values; `None` for a compound.
    #[must_use]
    pub fn data_type(&self) -> Option<DataType> {
        self.header.values.map(|values| values.data_type)
    }

    /// How many samples it has, as the header says: repeated ones have no bytes of their own. 0 for a compound.
    #[must_use]
    pub fn sample_count(&self) -> u64 {
        self.header.values.map_or(0, |values| values.samples.into())
    }

    /// Whether all samples are alike.
    #[must_use]
    pub fn is_constant(&self) -> bool {
        self.header.values.is_none_or(|values| values.first_change == 0)
    }

    /// When its samples were taken.
    ///
    /// # Errors
    /// [`OgawaError::Property`] when the archive does not know.
    pub fn times(&self) -> Result<&'a TimeSampling, OgawaError> {
        let index = self.header.values.map_or(0, |values| values.times);
        self.archive
            .times(index)
            .ok_or_else(|| self.unlike(format!("times {index}"), "times the archive has"))
    }

    /// The properties it is.
    ///
    /// # Errors
    /// [`OgawaError::Property`] when it is no compound, [`OgawaError::Invalid`].
    pub fn compound(&self) -> Result<CompoundReader<'a>, OgawaError> {
        if self.kind() != PropertyKind::Compound {
            return Err(self.unlike(format!("{:?}", self.kind()), "a compound"));
        }
        let group = self.parent.group(self.index, "compound")?;
        if self.depth >= DEEPEST {
            let found = format!("more than {DEEPEST} compounds in each other");
            return Err(OgawaError::invalid(group.offset, "compound", found, "fewer, and none in itself"));
        }
        CompoundReader::new(self.archive, group, self.depth + 1)
    }

    /// Sample number `index`.
    ///
    /// # Errors
    /// [`OgawaError::Property`] when there is no such sample, [`OgawaError::Invalid`].
    pub fn sample(&self, index: u64) -> Result<Sample<'a>, OgawaError> {
        let Some(values) = self.header.values else {
            return Err(self.unlike("a compound", "a scalar or an array"));
        };
        if index >= values.samples.into() {
            return Err(self.unlike(format!("{} samples", values.samples), format!("a sample {index}")));
        }
        let stored = usize::try_from(stored(values, index))
            .map_err(|_| self.unlike("too many samples", "as many as memory can name"))?;
        let group = self.parent.group(self.index, "samples")?;
        if !values.is_array {
            return Sample::new(group.data(stored, "sample")?, values.data_type, None, self.name());
        }
        let dimensions = group.data(2 * stored + 1, "dimensions of a sample")?;
        Sample::new(group.data(2 * stored, "sample")?, values.data_type, Some(dimensions), self.name())
    }

    fn unlike(&self, found: impl Into<String>, expected: impl Into<String>) -> OgawaError {
        let name = self.name().to_owned();
        OgawaError::Property { name, found: found.into(), expected: expected.into() }
    }
}

/// Which stored sample stands for number `index`: those before the first change are the first, those after
/// the last change the last.
fn stored(values: ValuesHeader, index: u64) -> u64 {
    let (first, last) = (u64::from(values.first_change), u64::from(values.last_change));
    if index < first || first == 0 {
        return 0;
    }
    index.min(last.max(first)) - first + 1
}
