//! Widths and colours.

use glam::Vec3;
use groom::{Attribute, Domain, Groom, GroomError, Values, names, random};

/// A thick human hair, in metres: no sample is thinner.
const LEAST_RADIUS: f32 = 35e-6;

/// Gives strands the radius it takes to cover the head a few times over, tapering to the tip.
pub(crate) fn radius(groom: &mut Groom, strands: u32, length: f32) -> Result<(), GroomError> {
    // Hair of this many square metres, laid flat, hides a head of a tenth of a square metre.
    let root = (0.30 / (strands as f32 * length)).clamp(LEAST_RADIUS, 0.002);
    let values = groom.along_strands().into_iter().map(|t| root * (1.0 - 0.6 * t.powi(4))).collect();
    groom.set_attribute(names::RADIUS, Attribute { domain: Domain::Vertex, values: Values::Float(values) })
}

/// Brown, darker at the root, each strand a little different.
pub(crate) fn color(groom: &mut Groom, seed: u64) -> Result<(), GroomError> {
    let (dark, light) = (Vec3::new(0.20, 0.10, 0.045), Vec3::new(0.52, 0.32, 0.16));
    let along = groom.along_strands();
    let mut values = Vec::with_capacity(along.len());
    for strand in 0..groom.strand_count() {
        let shade = 0.8 + 0.4 * random(seed, strand as u32, "shade");
        values.extend(along[groom.strand_range(strand)].iter().map(|&t| dark.lerp(light, t) * shade));
    }
    groom.set_attribute(names::COLOR, Attribute { domain: Domain::Vertex, values: Values::Vec3(values) })
}
