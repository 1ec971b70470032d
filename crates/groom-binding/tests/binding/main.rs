//! Binding and rigid carry.

#![allow(clippy::unwrap_used, clippy::panic)] // tests fail by panicking

mod laws;
mod motion;
mod places;
mod shapes;
mod unsound;
