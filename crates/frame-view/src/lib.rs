//! Frames shown: in a terminal, or in the tev viewer.
//!
//! [`Show`] shows the frame being rendered to whoever started the program, and says so where it cannot: only programs
//! use it. Beneath it, [`Manner::of`] finds out how a terminal shows pictures (graphics where it has them, else half
//! blocks in 24-bit colours), [`drawn`] makes the bytes for it. [`Tev`] speaks to a running
//! [tev](https://github.com/Tom94/tev), the viewer that pbrt's and Mitsuba's `--display-server` speak to as well.

mod blocks;
mod error;
mod graphics;
mod manner;
mod picture;
mod show;
mod sixel;
mod tev;

pub use error::ViewError;
pub use manner::{Manner, drawn};
pub use picture::Picture;
pub use show::Show;
pub use tev::{Tev, Tile};
