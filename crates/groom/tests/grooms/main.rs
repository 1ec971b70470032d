//! Grooms: what is done to strands and attributes.

#![allow(clippy::unwrap_used)] // tests fail by panicking

mod dressing;
mod guides;
mod moving;
mod operations;
mod shape;
mod support;
mod yuksel;
