//! Conversions in memory that does not grow with the number of strands: HAIR, which can be read strand by
//! strand, to the formats that can be written so.
//!
//! Strands come in blocks, each a small [`Groom`] with the attributes the whole file has, so a block is
//! read, edited and written by the code that does it for whole files, and the bytes are the same.

mod convert;
mod sink;

pub use convert::{Streamed, convert_streaming, convert_streaming_with};
pub(crate) use sink::{Counts, Sink};
