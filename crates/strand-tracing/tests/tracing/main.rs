//! What rays hit, against oracles.
#![allow(clippy::unwrap_used, clippy::panic)]

mod input;
mod leaving;
mod motion;
mod oracle;
mod support;
mod triangles;
