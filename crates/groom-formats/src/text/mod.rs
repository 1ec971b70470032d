//! Plain text: one point a line, one blank line between strands.
//!
//! ```text
//! x y z radius [r g b [transparency]]
//! ```
//!
//! | column | meaning |
//! |---|---|
//! | `x y z` | position, root first, in the groom's units |
//! | `radius` | radius (half the width) there, in the same units |
//! | `r g b` | linear Rec. 709 colour, 0..1; left out when the groom has none |
//! | `transparency` | 0 opaque .. 1 clear; left out when the groom is opaque; needs `r g b` before it |
//!
//! Numbers are separated by a space and are the shortest that read back to the same bits, so writing
//! and reading a groom keeps every bit of its points, radii, colours and transparencies (values that
//! were constant or per strand come back per point). There is no header and there are no comments:
//! Mitsuba 3 loads the files as they are. The file has no unit and no up axis; z is taken for up,
//! as for HAIR.
//!
//! The reader also takes tabs, CRLF, a byte order mark, spaces at either end, a last line without an
//! end, several blank lines in a row, `x y z` alone (a warning, and the default radius) and more than
//! eight columns (a warning; they are not read). Lines that end with CR alone are refused.
//! All lines must have the same number of columns.

mod lines;
mod pieces;
mod read;
mod write;

pub use read::read;
pub(crate) use write::{write, write_strands};
