//! Groups and data: the two things an Ogawa file is made of.

use super::cursor::Cursor;
use crate::{DATA, HEADER, OgawaError};

/// A list of places of groups and data.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group<'a> {
    file: &'a [u8],
    /// Where it stands; 0 for the empty group.
    pub(super) offset: u64,
    /// Eight bytes a child.
    children: &'a [u8],
}

/// A child of a group.
#[derive(Clone, Copy, Debug)]
pub(super) enum Child<'a> {
    Group(Group<'a>),
    Data(Data<'a>),
}

/// Bytes, and where they begin in the file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Data<'a> {
    pub(super) bytes: &'a [u8],
    pub(super) offset: u64,
}

impl<'a> Data<'a> {
    pub(super) fn cursor(self) -> Cursor<'a> {
        Cursor::new(self.bytes, self.offset)
    }
}

impl<'a> Group<'a> {
    pub(super) fn at(file: &'a [u8], offset: u64) -> Result<Self, OgawaError> {
        if offset == 0 {
            return Ok(Group { file, offset, children: &[] });
        }
        let (count, rest) = counted(file, offset, "group")?;
        let children = usize::try_from(count)
            .ok()
            .and_then(|count| count.checked_mul(8))
            .and_then(|len| rest.get(..len))
            .ok_or_else(|| {
                let room = rest.len() / 8;
                OgawaError::invalid(
                    offset,
                    "children of a group",
                    count.to_string(),
                    format!("{room} at most"),
                )
            })?;
        Ok(Group { file, offset, children })
    }

    pub(super) fn len(&self) -> usize {
        self.children.len() / 8
    }

    pub(super) fn child(&self, index: usize, what: &'static str) -> Result<Child<'a>, OgawaError> {
        let (places, _) = self.children.as_chunks::<8>();
        let Some(&place) = places.get(index) else {
            let found = format!("a group of {}", places.len());
            return Err(OgawaError::invalid(self.offset, what, found, format!("a child {index}")));
        };
        match u64::from_le_bytes(place) {
            DATA => Ok(Child::Data(Data { bytes: &[], offset: self.place_of(index) })),
            place if place & DATA == 0 => Ok(Child::Group(Group::at(self.file, place)?)),
            place => {
                let offset = place & !DATA;
                let (len, rest) = counted(self.file, offset, "data")?;
                let bytes = usize::try_from(len).ok().and_then(|len| rest.get(..len));
                let bytes = bytes.ok_or_else(|| {
                    let found = format!("{len} bytes");
                    OgawaError::invalid(offset, what, found, format!("{} at most", rest.len()))
                })?;
                Ok(Child::Data(Data { bytes, offset: offset + 8 }))
            }
        }
    }

    pub(super) fn group(&self, index: usize, what: &'static str) -> Result<Group<'a>, OgawaError> {
        match self.child(index, what)? {
            Child::Group(group) => Ok(group),
            Child::Data(_) => Err(OgawaError::invalid(self.place_of(index), what, "data", "a group")),
        }
    }

    pub(super) fn data(&self, index: usize, what: &'static str) -> Result<Data<'a>, OgawaError> {
        match self.child(index, what)? {
            Child::Data(data) => Ok(data),
            Child::Group(_) => Err(OgawaError::invalid(self.place_of(index), what, "a group", "data")),
        }
    }

    /// The last child where it is data: headers stand there.
    pub(super) fn last_data(&self, what: &'static str) -> Result<Option<Data<'a>>, OgawaError> {
        let Some(last) = self.len().checked_sub(1) else { return Ok(None) };
        match self.child(last, what)? {
            Child::Data(data) => Ok(Some(data)),
            Child::Group(_) => Ok(None),
        }
    }

    /// Where the place of a child stands in the file.
    fn place_of(&self, index: usize) -> u64 {
        self.offset + 8 * (index as u64 + 1)
    }
}

/// The count at `offset` and the bytes after it.
fn counted<'a>(file: &'a [u8], offset: u64, what: &'static str) -> Result<(u64, &'a [u8]), OgawaError> {
    let rest = usize::try_from(offset).ok().filter(|_| offset >= HEADER).and_then(|at| file.get(at..));
    let split = rest.and_then(<[u8]>::split_first_chunk::<8>);
    let Some((count, rest)) = split else {
        let expected = format!("a place from {HEADER} to {}", file.len().saturating_sub(8));
        return Err(OgawaError::invalid(offset, what, format!("byte {offset}"), expected));
    };
    Ok((u64::from_le_bytes(*count), rest))
}
