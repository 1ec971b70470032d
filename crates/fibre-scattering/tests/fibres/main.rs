//! The laws of scattering, hair and fur, and other programs' answers.

#![allow(clippy::print_stdout, clippy::unwrap_used)] // tests fail by panicking

mod brute_force;
mod energy;
mod far_field;
mod fur;
mod laws;
mod oracle;
mod sampling;
mod support;
