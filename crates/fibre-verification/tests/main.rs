//! The checks hold our models and find broken ones.

#![allow(clippy::unwrap_used)] // also the helpers are test code

mod mutants;
mod oracle;
