//! OpenUSD's own Python package (`usd-core`), run as a subprocess: check a stage, bake one, package one.
//!
//! Nothing of groomkit needs it: it judges what we write ([`UsdCore::check`]) and does what a reader of
//! single layers cannot, composition and skinning ([`UsdCore::bake`]). The programs themselves are
//! `tools/usd/*.py`; they are part of this crate, so that an installed program has them.
//!
//! ```no_run
//! # fn main() -> Result<(), usd_core::UsdCoreError> {
//! let usd = usd_core::UsdCore::find()?;
//! for finding in usd.check("groom.usdc".as_ref())? {
//!     assert_ne!(finding.severity, usd_core::Severity::Error, "{finding}");
//! }
//! # Ok(())
//! # }
//! ```

mod error;
mod finding;
mod python;
mod scripts;
mod usd_core;

pub use error::UsdCoreError;
pub use finding::{Finding, Severity};
pub use usd_core::{BakeOptions, UsdCore};
