//! Binding and rigid carry.

#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout)] // tests fail by panicking and print figures

mod blended;
mod hard_cases;
mod kept_out;
mod laws;
mod motion;
mod places;
mod real;
mod root_attributes;
#[path = "../../src/stability/shapes.rs"]
#[allow(dead_code)]
mod shapes;
mod stability;
mod unsound;

use groom::Groom;
use groom_binding::Surface;

impl shapes::Mesh {
    fn surface(&self) -> Surface<'_> {
        Surface { triangles: &self.triangles, rest: &self.rest, uvs: Some(&self.uvs) }
    }
}

fn strands(count: u32, off: f32, seed: u64) -> Groom {
    shapes::strands(count, off, seed).unwrap()
}
