//! A turntable as one self-contained HTML page.
//!
//! Frames to scrub (slider, drag, arrow keys, play), passes to flip and to weigh, variants to choose and to compare
//! (side by side, by a wipe, by their difference), the parameters of each with what differs, error against seconds,
//! what was left out and why. The page needs no network and no other file, and runs nothing but its own script, whose
//! hash is in its content security policy.
//!
//! Passes are kept as light (8 bits a channel and a scale a pixel), so the page adds and
//! exposes them in linear light and shows what the PNGs show, to 2/255.
//!
//! ```
//! use flip_page::{Curve, Page, Shot, Tone, Variant};
//!
//! let tone = Tone { exposure: 0.0, curve: Curve::Neutral, backdrop: [0.18; 3], plate: None };
//! let mut page = Page::new("A head of hair", &["R", "TT"]);
//! let variant = page.variant(Variant::default(), tone);
//! page.shot(variant, &Shot {
//!     number: 1,
//!     facts: vec![("seconds".into(), "3.2 s".into())],
//!     width: 1,
//!     height: 1,
//!     shown: &[128, 128, 128],
//!     alpha: &[1.0],
//!     layers: Some(&[&[[0.1, 0.1, 0.1]], &[[0.2, 0.1, 0.0]]]),
//! })?;
//! assert!(page.to_html()?.starts_with("<!DOCTYPE html>"));
//! # Ok::<(), flip_page::PageError>(())
//! ```

mod data;
mod error;
mod html;
mod pack;
mod page;
mod sha256;

pub use data::{Axis, Curve, Plate, Tone, Variant};
pub use error::PageError;
pub use page::{Bytes, Page, Shot};
