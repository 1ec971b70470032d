//! groom-bind as a user runs it.

mod attributes;
mod formats;
mod motion;
mod readme;
mod real_cases;
mod refused;
mod streaming;
mod support;
