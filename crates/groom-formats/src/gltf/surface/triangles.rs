//! The triangles of tubes and ribbons, counter-clockwise seen from outside.

use std::io::{self, Write};

use super::Surface;
use crate::drawable::Drawable;
use crate::gltf::blocks::Blocks;

/// Writes all indices.
pub(in crate::gltf) fn write(
    surface: &Surface<'_>,
    drawable: Drawable<'_>,
    stream: &mut impl Write,
) -> io::Result<()> {
    let mut blocks = Blocks::new(stream);
    let sides = surface.per_point() as u32;
    let mut first = 0_u32;
    for (_, range) in drawable.strands() {
        let last = first + (range.len() as u32 - 1) * sides;
        for ring in (first..last).step_by(sides as usize) {
            let next = ring + sides;
            if surface.is_tube {
                for i in 0..sides {
                    let j = if i + 1 == sides { 0 } else { i + 1 };
                    blocks.push([ring + i, ring + j, next + j, ring + i, next + j, next + i])?;
                }
            } else {
                blocks.push([ring, next + 1, ring + 1, ring, next, next + 1])?;
            }
        }
        if surface.is_tube {
            // The cap at the root looks back, the one at the tip ahead.
            for i in 1..sides - 1 {
                blocks.push([first, first + i + 1, first + i, last, last + i, last + i + 1])?;
            }
        }
        first = last + sides;
    }
    blocks.finish()
}
