//! What is odd about a file but does not keep it from being read.

use std::fmt;

use crate::Field;

/// Something odd in a file that was read all the same. Offsets are bytes from the start of the file.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// There is no points array, so the file has no geometry.
    MissingPoints,
    /// Bits of `arrays` the format does not define are set. Such arrays could only follow the known
    /// ones, so those are read as usual; the bits are not written again.
    UnknownArrays {
        /// The undefined bits.
        bits: u32,
    },
    /// Bytes follow the last array.
    TrailingBytes {
        /// Where they start.
        offset: u64,
        /// How many there are.
        bytes: u64,
    },
    /// Consecutive points of a strand coincide.
    ZeroLengthSegments {
        /// How many such segments there are.
        count: u64,
        /// Index of the first point that repeats the one before it.
        first_point: u64,
    },
    /// Strands have no segment.
    OnePointStrands {
        /// How many such strands there are.
        count: u64,
        /// Index of the first.
        first_strand: u64,
    },
    /// Values of an array other than points are infinite or not a number.
    NonFiniteValues {
        /// The array.
        field: Field,
        /// Where the first lies.
        offset: u64,
        /// How many there are.
        count: u64,
    },
    /// A default in the header that stands in for an absent array is infinite or not a number.
    NonFiniteDefault {
        /// The default.
        field: Field,
        /// Its value, the first channel that is not finite of a colour.
        found: f32,
    },
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Warning::MissingPoints => {
                write!(f, "arrays at byte 12: there is no points array, so the file has no geometry")
            }
            Warning::UnknownArrays { bits } => write!(
                f,
                "arrays at byte 12: bits {bits:#x} are not defined by the format; what they announce is ignored"
            ),
            Warning::TrailingBytes { offset, bytes } => {
                write!(f, "byte {offset}: {bytes} bytes follow the last array")
            }
            Warning::ZeroLengthSegments { count, first_point } => {
                write!(f, "points: {count} segments have no length, the first ends at point {first_point}")
            }
            Warning::OnePointStrands { count, first_strand } => {
                write!(f, "segments: {count} strands have a single point, the first is strand {first_strand}")
            }
            Warning::NonFiniteValues { field, offset, count } => {
                write!(f, "{field}: {count} values are not finite, the first at byte {offset}")
            }
            Warning::NonFiniteDefault { field, found } => {
                write!(
                    f,
                    "{field} at byte {}: found {found}, expected a finite number",
                    field.header_offset()
                )
            }
        }
    }
}
