//! groom-bind as a user runs it.

#![allow(clippy::unwrap_used, clippy::panic)] // tests fail by panicking

mod attributes;
mod formats;
mod motion;
mod readme;
mod real_cases;
mod refused;
mod streaming;
mod support;
