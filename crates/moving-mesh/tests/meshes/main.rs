//! The tests of all readers, in one program: they share what has to be compiled.

#![allow(clippy::unwrap_used, clippy::print_stdout)] // helpers of tests

mod broken_files;
mod cameras;
mod gltf_files;
mod gltf_motion;
mod obj;
mod sources;
mod support;
mod usd;
mod usd_skel;
