//! Properties being put together: their samples' places, and which of them changed anything.

use super::object::Compound;
use crate::{DATA, DataType, KEY, Metadata};

/// A sample that stands in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StoredSample {
    /// The place of its data, as a group names it.
    pub(super) place: u64,
    /// Bytes without the key.
    pub(super) len: u64,
    pub(super) key: [u8; KEY],
    /// How many strings it is, where it is strings.
    pub(super) strings: Option<u64>,
}

/// What a property holds.
#[derive(Clone, Debug)]
pub(super) enum Content {
    Compound(Compound),
    Scalar(DataType, Vec<StoredSample>),
    Array(DataType, Vec<StoredSample>),
}

/// A named value, constant or with a sample a time, or a compound of properties.
#[derive(Clone, Debug)]
pub struct Property {
    pub(super) name: String,
    pub(super) metadata: Metadata,
    pub(super) times: u32,
    pub(super) content: Content,
}

impl Property {
    /// A property that is properties.
    #[must_use]
    pub fn compound(name: &str, metadata: Metadata, properties: Compound) -> Self {
        Property { name: name.to_owned(), metadata, times: 0, content: Content::Compound(properties) }
    }

    /// A property with one value a sample, constant unless it is given [`Property::at`] times.
    #[must_use]
    pub fn scalar(name: &str, data_type: DataType, metadata: Metadata) -> Self {
        let content = Content::Scalar(data_type, Vec::new());
        Property { name: name.to_owned(), metadata, times: 0, content }
    }

    /// A property with an array of values a sample.
    #[must_use]
    pub fn array(name: &str, data_type: DataType, metadata: Metadata) -> Self {
        let content = Content::Array(data_type, Vec::new());
        Property { name: name.to_owned(), metadata, times: 0, content }
    }

    /// The same, its samples taken at times that [`ArchiveWriter::add_times`](crate::ArchiveWriter::add_times)
    /// knows.
    #[must_use]
    pub fn at(mut self, times: u32) -> Self {
        self.set_times(times);
        self
    }

    /// Says when its samples are taken; times may be known only when the last sample is.
    pub fn set_times(&mut self, times: u32) {
        self.times = times;
    }

    /// Adds the next sample; a compound has none and ignores it.
    pub fn push(&mut self, sample: StoredSample) {
        match &mut self.content {
            Content::Scalar(_, samples) | Content::Array(_, samples) => samples.push(sample),
            Content::Compound(_) => {}
        }
    }

    /// The same with one more sample, for building in one expression.
    #[must_use]
    pub fn with(mut self, sample: StoredSample) -> Self {
        self.push(sample);
        self
    }
}

/// Which samples changed: those before `first` are the first sample, those after `last` the last.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Changes {
    pub(super) first: u32,
    pub(super) last: u32,
}

impl Changes {
    /// Both 0 when all samples are alike.
    pub(super) fn of(samples: &[StoredSample]) -> Self {
        let changed = |i: &usize| samples[*i] != samples[*i - 1];
        let first = (1..samples.len()).find(changed).unwrap_or(0) as u32;
        let last = (1..samples.len()).rev().find(changed).unwrap_or(0) as u32;
        Changes { first, last }
    }

    /// The samples that are stored.
    pub(super) fn stored(self, samples: &[StoredSample]) -> impl Iterator<Item = &StoredSample> {
        let (first, last) = (self.first as usize, self.last as usize);
        let rest = if first == 0 { &[] } else { samples.get(first..=last).unwrap_or_default() };
        samples.iter().take(1).chain(rest)
    }
}

impl StoredSample {
    /// A sample of nothing.
    pub const EMPTY: StoredSample = StoredSample { place: DATA, len: 0, key: [0; KEY], strings: None };

    /// How many values of a type it holds.
    pub(super) fn count(&self, data_type: DataType) -> u64 {
        match (self.strings, data_type.size()) {
            (Some(strings), _) => strings / u64::from(data_type.extent.max(1)),
            (None, Some(size)) if size > 0 => self.len / size as u64,
            _ => 0,
        }
    }

    /// The dimensions that stand beside it in an array: empty where its size says them.
    pub(super) fn dimensions(&self) -> Option<u64> {
        self.strings
    }

    pub(super) fn is_empty(&self) -> bool {
        self.place == DATA
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn changes(samples: &[u64]) -> (u32, u32, Vec<u64>) {
        let samples: Vec<StoredSample> = samples
            .iter()
            .map(|&place| StoredSample { place, len: 4, key: [0; KEY], strings: None })
            .collect();
        let changes = Changes::of(&samples);
        (changes.first, changes.last, changes.stored(&samples).map(|sample| sample.place).collect())
    }

    #[test]
    fn samples_that_change_nothing_are_not_stored() {
        assert_eq!(changes(&[]), (0, 0, vec![]));
        assert_eq!(changes(&[7]), (0, 0, vec![7]));
        assert_eq!(changes(&[7, 7, 7]), (0, 0, vec![7]));
        assert_eq!(changes(&[1, 2, 3]), (1, 2, vec![1, 2, 3]));
        assert_eq!(changes(&[1, 1, 2, 2, 3, 3]), (2, 4, vec![1, 2, 2, 3]));
        assert_eq!(changes(&[1, 2, 1, 1]), (1, 2, vec![1, 2, 1]));
    }
}
