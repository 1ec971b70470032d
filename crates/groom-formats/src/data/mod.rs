//! USC's hair data, `.data`, as the USC-HairSalon database is stored.
//!
//! | bytes | what |
//! |---|---|
//! | `i32` | number of strands |
//! | for every strand: `i32` | its number of points, 0 or more |
//! | `f32 x y z` as often | its points, root first |
//!
//! Little endian, nothing else: no radius, no colour, no unit and no axis. The database is y up and in metres,
//! and so a file is taken to be. Strands without points (the database has bald roots) are left out with a warning,
//! the others then keep their index as `id`; segments without length are kept and told.

mod read;
pub(crate) mod write;

pub(crate) use read::read;
pub(crate) use write::write;
