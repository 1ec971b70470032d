//! Where the arrays of a file lie.

use crate::{Field, HEADER_BYTES, Header};

/// Where one array lies in a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Span {
    /// Byte offset of its first value.
    pub offset: u64,
    /// How many values it has.
    pub count: u64,
    /// How many bytes it takes.
    pub bytes: u64,
}

/// Byte ranges of the arrays a header announces, in file order.
///
/// The largest counts a header can hold make a file of 2^37 bytes, so nothing here can overflow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    spans: [Option<Span>; 5],
    /// The offset one past the last array: the length of a file without trailing bytes.
    pub end: u64,
}

impl Layout {
    /// The layout `header` describes.
    #[must_use]
    pub fn of(header: &Header) -> Self {
        let mut end = HEADER_BYTES as u64;
        let spans = Field::ARRAYS.map(|array| {
            if !header.has(array) {
                return None;
            }
            let count =
                u64::from(if array == Field::Segments { header.hair_count } else { header.point_count });
            let span = Span { offset: end, count, bytes: count * array.value_bytes() };
            end += span.bytes;
            Some(span)
        });
        Layout { spans, end }
    }

    /// Where `array` lies, if the header announces it.
    #[must_use]
    pub fn span(&self, array: Field) -> Option<Span> {
        let index = Field::ARRAYS.iter().position(|&other| other == array)?;
        self.spans[index]
    }

    /// The announced arrays in file order.
    pub fn spans(&self) -> impl Iterator<Item = (Field, Span)> + '_ {
        Field::ARRAYS.into_iter().filter_map(|array| Some((array, self.span(array)?)))
    }
}
