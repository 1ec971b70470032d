//! Alembic archives in the Ogawa layout, to the byte, read and written.
//!
//! An archive is a tree of objects; an object has named properties, each a compound of others, a
//! scalar or an array with one sample or one for each of its times. What the samples mean (meshes,
//! curves, matrices) is the affair of schemas, which are names in the metadata; this crate knows none.
//!
//! ```text
//! file    "Ogawa" | ff when whole | 00 01 | u64 root group | groups and data in any order
//! group   u64 children | a u64 for each: a position, with the top bit set for data; 0 and 1 << 63 are empty
//! data    u64 bytes | bytes
//!
//! root    version (0) | library version | top object | metadata | time samplings | metadata table
//! object  properties | child objects ... | their headers and two digests
//! compound  a group a property | their headers
//! scalar  a sample for each time that changes something: 16-byte key | value
//! array   as a scalar, with a second child after each: its dimensions, empty where they follow from the size
//! ```
//!
//! The layout is that of Alembic 1.8's `AbcCoreOgawa`. Numbers are little endian.
//!
//! ```
//! use ogawa::{ArchiveWriter, Compound, DataType, Metadata, Object, Property};
//! # fn main() -> Result<(), ogawa::OgawaError> {
//! let mut file = std::io::Cursor::new(Vec::new());
//! let mut archive = ArchiveWriter::new(&mut file)?;
//! let mut ids = Property::array("ids", DataType::I32, Metadata::new());
//! ids.push(archive.values(&[1_i32, 2, 3])?);
//! let mut thing = Object::new("thing", Metadata::new());
//! thing.properties.push(ids);
//! let mut top = Object::top();
//! top.children.push(thing);
//! archive.finish(&top, &Metadata::new())?;
//!
//! let bytes = file.into_inner();
//! let archive = ogawa::Archive::new(&bytes)?;
//! for thing in archive.top().children()? {
//!     if let Some(ids) = thing?.properties()?.find("ids")? {
//!         assert_eq!(ids.sample(0)?.to_vec::<i32>()?, [1, 2, 3]);
//!     }
//! }
//! # Ok(())
//! # }
//! ```

mod data_type;
mod error;
mod metadata;
mod read;
mod time;
mod write;

pub use data_type::{DataType, Pod, Value};
pub use error::OgawaError;
pub use metadata::{Metadata, MetadataText};
pub use read::{Archive, Children, CompoundReader, ObjectReader, PropertyKind, PropertyReader, Sample};
pub use time::TimeSampling;
pub use write::{ArchiveWriter, Compound, Object, Property, StoredSample};

/// The bit of a child's position that says it is data and not a group.
const DATA: u64 = 1 << 63;
/// Bytes of the key before every sample.
const KEY: usize = 16;
/// Bytes of the header of a file.
const HEADER: u64 = 16;
