//! Writing: samples as they come, the tree that names them at the end.

mod archive;
mod headers;
mod object;
mod property;

pub use archive::ArchiveWriter;
pub use object::{Compound, Object};
pub use property::{Property, StoredSample};
