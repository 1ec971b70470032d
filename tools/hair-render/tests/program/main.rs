//! The program as a shell meets it.

#![allow(clippy::unwrap_used)] // tests fail by panicking

mod command;
mod farm;
mod motion;
mod support;
