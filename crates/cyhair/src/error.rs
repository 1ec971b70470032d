//! Why a HAIR file is refused.

use std::io;
use std::path::{Path, PathBuf};

use crate::{Field, LookAlike};

/// A HAIR file that cannot be read, mended or written. Offsets are bytes from the start of the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum HairError {
    /// The file could not be opened.
    #[error("cannot open {}", path.display())]
    Open {
        /// The file.
        path: PathBuf,
        /// What the system said.
        source: io::Error,
    },
    /// The file at a path is refused, or could not be read to its end.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong with it; any of the other errors.
        source: Box<HairError>,
    },
    /// Reading or writing failed.
    #[error("{field} at byte {offset}: input or output failed")]
    Io {
        /// The part being read or written.
        field: Field,
        /// Where that part starts.
        offset: u64,
        /// What the system said.
        source: io::Error,
    },
    /// The file does not start with `HAIR`.
    #[error("magic at byte 0: found {:?}, expected \"HAIR\"{}", found.escape_ascii().to_string(),
        looks_like.map(|kind| format!("; this looks like {kind}")).unwrap_or_default())]
    Magic {
        /// The first four bytes.
        found: [u8; 4],
        /// What the file seems to be.
        looks_like: Option<LookAlike>,
    },
    /// The file ends inside a field or an array, or its counts promise more than it holds.
    #[error("{field} at byte {offset}: expected {expected} bytes, found {found} before the end of the file")]
    Truncated {
        /// The part that is cut off.
        field: Field,
        /// Where that part starts.
        offset: u64,
        /// How many bytes it needs.
        expected: u64,
        /// How many there are.
        found: u64,
    },
    /// The strands' segments do not add up to the point count.
    #[error(
        "point_count at byte 8: found {found}, expected {expected}, the sum of segments + 1 over the strands \
         ({field} at byte {offset})"
    )]
    PointCount {
        /// Where the segments come from: the segments array or the default.
        field: Field,
        /// Where that starts.
        offset: u64,
        /// Points the segments ask for.
        expected: u64,
        /// Points the header has.
        found: u64,
    },
    /// A coordinate is infinite or not a number.
    #[error(
        "points at byte {offset}: point {point}, component {component} is {found}, expected a finite number"
    )]
    NonFinitePoint {
        /// Where the coordinate lies.
        offset: u64,
        /// Index of the point in the whole file.
        point: u64,
        /// 0 x, 1 y, 2 z.
        component: u8,
        /// The coordinate.
        found: f32,
    },
    /// There are no strands, or none is left after mending.
    #[error("hair_count at byte 4: found 0 strands, expected at least 1")]
    NoStrands,
    /// An array is larger than this machine can address or give.
    #[error("{field} at byte {offset}: {bytes} bytes do not fit in memory")]
    OutOfMemory {
        /// The array.
        field: Field,
        /// Where it starts.
        offset: u64,
        /// How long it is.
        bytes: u64,
    },
    /// To be written: an array's length does not agree with the header's counts.
    #[error("{field}: the header says {expected} values, the array has {found}")]
    ArrayLength {
        /// The array.
        field: Field,
        /// Values the header asks for.
        expected: u64,
        /// Values there are.
        found: u64,
    },
    /// To be written: the header announces an array that is not there, or the other way round.
    #[error("arrays: the header says {field} is {}, but the array is {}",
        if *announced { "present" } else { "absent" }, if *announced { "absent" } else { "present" })]
    ArrayBit {
        /// The array.
        field: Field,
        /// What the header says.
        announced: bool,
    },
    /// To be written: a count is larger than its field can hold.
    #[error("{field}: found {found}, but the format holds at most {limit}")]
    TooLarge {
        /// The field.
        field: Field,
        /// The count.
        found: u64,
        /// The largest the format can say.
        limit: u64,
    },
    /// Written strand by strand: a strand does not fit the segments announced for it.
    #[error("strand {strand}: {field} has {found} values, expected {expected}")]
    Strand {
        /// Index of the strand.
        strand: u64,
        /// The array.
        field: Field,
        /// Values the strand must have.
        expected: u64,
        /// Values it has.
        found: u64,
    },
    /// Written strand by strand: fewer strands came than the header announces.
    #[error("{found} strands were written, but the header says {expected}")]
    StrandCount {
        /// Strands the header has.
        expected: u64,
        /// Strands that came.
        found: u64,
    },
}

impl HairError {
    /// This error, naming the file it is about.
    pub(crate) fn of_file(self, path: &Path) -> Self {
        HairError::File { path: path.to_owned(), source: Box::new(self) }
    }
}
