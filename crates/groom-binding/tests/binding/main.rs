//! Binding and rigid carry.

#![allow(clippy::unwrap_used, clippy::panic)] // tests fail by panicking

mod blended;
mod hard_cases;
mod kept_out;
mod laws;
mod motion;
mod places;
mod shapes;
mod unsound;
