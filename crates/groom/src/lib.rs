//! Strands and their attributes: the one model every groomkit crate shares.
//!
//! A [`Groom`] is a set of strands stored as offsets into flat arrays, with named attributes per
//! groom, per strand or per vertex. Readers make grooms, writers and the renderer consume them;
//! nothing here knows a file, a mesh or a light.
//!
//! ```
//! use glam::Vec3;
//! use groom::{Attribute, Groom, names};
//!
//! let mut groom = Groom::new(vec![0, 2, 3], vec![Vec3::ZERO, Vec3::Y, Vec3::X])?;
//! groom.set_attribute(names::RADIUS, Attribute::constant_float(0.05))?;
//! assert_eq!(groom.strand_count(), 2);
//! assert_eq!(groom.strand(0), &[Vec3::ZERO, Vec3::Y]);
//! assert_eq!(groom.radii().get(1, 2), 0.05);
//! # Ok::<(), groom::GroomError>(())
//! ```

mod attribute;
mod axis;
mod distance;
mod dress;
mod error;
mod expression;
mod farthest;
mod filter;
mod gather;
mod grid;
#[allow(clippy::module_inception)] // the crate's one idea is the type of the same name
mod groom;
mod guides;
mod length;
mod ramp;
mod random;
mod repair;
mod resample;
mod reverse;
mod segment;
mod simplify;
mod smooth;
mod statistics;
mod subsample;
mod texture;
mod transform;

pub use attribute::{Attribute, Domain, FloatView, Values, Vec3View, names};
pub use axis::UpAxis;
pub use distance::{Deviation, Distance};
pub use error::GroomError;
pub use expression::Expression;
pub use grid::Grid;
pub use groom::{DEFAULT_RADIUS, Groom};
pub use guides::Guides;
pub use ramp::Ramp;
pub use random::random;
pub use repair::Repair;
pub use smooth::Smoothing;
pub use statistics::{Range, Statistics};
pub use texture::{Texture, VAxis};
