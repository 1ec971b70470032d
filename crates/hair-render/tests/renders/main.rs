//! Renders: what must hold of a picture.

#![allow(clippy::unwrap_used)] // tests fail by panicking

mod blur;
mod blur_energy;
mod checkpoints;
mod color;
mod common;
mod energy;
mod environment_files;
mod frames;
mod geometry;
mod surfaces;
mod visible_lights;
