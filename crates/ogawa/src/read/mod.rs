//! Reading: everything borrowed from the bytes, checked where it is looked at. Only [`Sample`]'s vectors and
//! times take memory, so that no file, however broken, takes more than it has bytes for.

mod archive;
mod cursor;
mod group;
mod headers;
mod object;
mod property;
mod sample;

pub use archive::Archive;
pub use object::{Children, ObjectReader};
pub use property::{CompoundReader, PropertyKind, PropertyReader};
pub use sample::Sample;
