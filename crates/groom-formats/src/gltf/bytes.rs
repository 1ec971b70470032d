//! The binary buffer: indices, points, colours, widths, each aligned to 4 bytes by its own size.

use std::io::{self, Write};

use crate::gltf::Plan;

pub(super) fn write(plan: &Plan<'_>, stream: &mut impl Write) -> io::Result<()> {
    let mut first = 0_u32;
    for (_, range) in plan.drawable.strands() {
        let last = first + (range.len() as u32 - 1);
        for index in first..last {
            put(stream, [index, index + 1])?;
        }
        first = last + 1;
    }
    for (_, vertex) in plan.drawable.vertices() {
        put(stream, plan.point(vertex).to_array().map(f32::to_bits))?;
    }
    if let Some(colors) = plan.colors {
        for (strand, vertex) in plan.drawable.vertices() {
            stream.write_all(&colors.rgba(strand, vertex).map(in_8_bits))?;
        }
    }
    for (strand, vertex) in plan.drawable.vertices() {
        put(stream, [plan.width(strand, vertex).to_bits()])?;
    }
    Ok(())
}

/// A number from 0 to 1 as glTF normalises it; what lies outside is clamped.
pub(super) fn in_8_bits(value: f32) -> u8 {
    (value.clamp(0.0, 1.0) * 255.0).round() as u8
}

fn put<const N: usize>(stream: &mut impl Write, words: [u32; N]) -> io::Result<()> {
    stream.write_all(words.map(u32::to_le_bytes).as_flattened())
}
