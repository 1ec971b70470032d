//! Materials from files and presets, and on grooms: one program, to link once.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, clippy::indexing_slicing)] // tests fail by panicking

mod files;
mod presets;
mod strands;
