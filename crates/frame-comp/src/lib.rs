//! Finished frames put together: their passes re-weighed, a picture or a colour put behind them.
//!
//! The light passes of a frame add up to its beauty, so another beauty is a sum of the same passes with other
//! factors: [`Weights`], [`reweigh`]. How well they add up is [`residual`]'s to say. What is put behind the transparent
//! part is a [`Background`]; [`behind`] does it in light, for a frame that goes on, and [`shown`] for the eye.
//!
//! ```
//! use frame_comp::{Weights, reweigh};
//! # use hair_render::{Aov, Frame};
//! # use glam::Vec3;
//! # fn frame() -> Frame { unimplemented!() }
//! # fn show() -> Result<(), frame_comp::CompError> {
//! let weights: Weights = "TT=0.5,TRT=2".parse()?;
//! let darker = reweigh(&frame(), &weights)?;
//! # Ok(())
//! # }
//! ```

mod background;
mod comp;
mod error;
mod fit;
mod numbering;
mod plate;
mod residual;
mod smaller;
mod weights;

pub use background::Background;
pub use comp::{behind, shown, shown_deep};
pub use error::CompError;
pub use fit::{Fit, Fitted};
pub use numbering::outputs;
pub use plate::{Meaning, Plate};
pub use residual::{Residual, residual};
pub use smaller::{smaller, smaller_size};
pub use weights::{Weights, reweigh};
