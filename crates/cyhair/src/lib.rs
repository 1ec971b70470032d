//! Reads and writes the HAIR (cyHair) file format to the byte.
//!
//! A HAIR file holds strands of hair as polylines: a 128-byte header and up to five arrays
//! (segments of each strand; points, thickness, transparency and colour of each point). See
//! <http://www.cemyuksel.com/research/hairmodels/>. [`HairFile`] is a whole file in memory,
//! [`HairReader`] and [`HairWriter`] go strand by strand in bounded memory, [`ArrayWriter`] takes arrays
//! that lie elsewhere, [`HairView`] looks at bytes in place, and, with the feature `mmap`, `MappedHair` at a file.
//!
//! A header is not trusted: a file that lies is refused with a [`HairError`] that names the field,
//! its byte offset, what was found and what was expected, and no more memory is taken than the file
//! is long. What is merely odd comes back as [`Warning`]s; [`HairFile::read_and_repair`] mends both
//! as far as it can and says what it did.
//!
//! ```
//! use cyhair::{HairFile, Header};
//!
//! let header = Header { hair_count: 1, default_segments: 1, ..Header::default() };
//! let points = Some(vec![[0.0; 3], [0.0, 1.0, 0.0]]);
//! let mut file = HairFile { header, points, ..HairFile::default() };
//! file.sync_header();
//! let bytes = file.to_bytes()?;
//! let loaded = HairFile::from_bytes(&bytes)?;
//! assert_eq!(loaded.file, file);
//! assert!(loaded.warnings.is_empty());
//! # Ok::<(), cyhair::HairError>(())
//! ```

mod array_write;
mod check;
mod cursor;
mod error;
mod field;
mod file;
mod header;
mod layout;
mod little_endian;
mod look_alike;
#[cfg(feature = "mmap")]
mod mapped;
mod repair;
mod salvage;
mod source;
mod stream_read;
mod stream_write;
mod view;
mod warning;
mod write;

pub use array_write::ArrayWriter;
pub use error::HairError;
pub use field::Field;
pub use file::{HairFile, Loaded};
pub use header::{HEADER_BYTES, Header, KNOWN_ARRAYS, MAGIC};
pub use layout::{Layout, Span};
pub use little_endian::Value;
pub use look_alike::LookAlike;
#[cfg(feature = "mmap")]
pub use mapped::MappedHair;
pub use repair::Repair;
pub use salvage::Repaired;
pub use stream_read::{HairReader, Strand};
pub use stream_write::HairWriter;
pub use view::{ArrayView, HairView};
pub use warning::Warning;
