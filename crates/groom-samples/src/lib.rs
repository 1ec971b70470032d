//! Procedural heads of hair: straight, wavy and curly; and coats of fur on any surface.
//!
//! Made for tests and demonstrations: hair that is nobody's property, of any size, the same bits for
//! the same options on every machine. The head is an ellipsoid about 20 cm tall around the origin,
//! y up, face towards +z, in metres; hair grows on its scalp, parted in the middle, combed away from
//! the face and falling by its weight without passing through the head.
//!
//! ```
//! use groom_samples::{Options, Style, hair};
//!
//! let groom = hair(&Options { style: Style::Curly, strands: 100, points: 20, ..Options::default() })?;
//! assert_eq!(groom.strand_count(), 100);
//! # Ok::<(), groom_samples::SampleError>(())
//! ```

mod dress;
mod fur;
mod fur_options;
mod grow;
mod hair;
mod head;
mod mesh;
mod nodding_head;
mod options;
mod scatter;
mod thickness;
mod trigonometry;
mod tufts;

pub use fur::fur_on;
pub use fur_options::{FurOptions, FurSurface};
pub use hair::hair;
pub use head::HEAD_RADII;
pub use mesh::head_obj;
pub use nodding_head::nodding_head_glb;
pub use options::{Options, SampleError, Style};
