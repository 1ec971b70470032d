//! The vertices of tubes and ribbons: position, normal, texture coordinate and colour side by side.

use std::io::{self, Write};

use glam::{Vec2, Vec3};

use super::Surface;
use super::frames::{Frame, frames};
use crate::drawable::Drawable;
use crate::gltf::Plan;
use crate::gltf::blocks::Blocks;
use crate::gltf::space::Space;

/// Exact bounds of all vertices, y-up and in metres.
pub(in crate::gltf) fn bounds(surface: &Surface<'_>, drawable: Drawable<'_>, space: Space) -> [Vec3; 2] {
    let (mut min, mut max) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let mut strand = Strand::default();
    for (index, range) in drawable.strands() {
        strand.frame(drawable, space, range.clone());
        for (vertex, frame) in range.zip(&strand.frames) {
            let radius = 0.5 * space.width(drawable.groom.radii().get(index, vertex));
            for &(around, _) in &surface.around {
                let position = frame.point + direction(frame, around) * radius;
                (min, max) = (min.min(position), max.max(position));
            }
        }
    }
    [min, max]
}

/// Writes all vertices.
pub(in crate::gltf) fn write(
    surface: &Surface<'_>,
    plan: &Plan<'_>,
    stream: &mut impl Write,
) -> io::Result<()> {
    let mut blocks = Blocks::new(stream);
    let (drawable, space) = (plan.drawable, plan.space);
    let mut strand = Strand::default();
    let mut row = Row::default();
    for (index, range) in drawable.strands() {
        strand.frame(drawable, space, range.clone());
        let length = strand.frames.last().map_or(0.0, |frame| frame.along);
        for (vertex, frame) in range.zip(&strand.frames) {
            let radius = 0.5 * space.width(drawable.groom.radii().get(index, vertex));
            let root_uv = surface.root_uv(index, vertex);
            let along = if length > 0.0 { frame.along / length } else { 0.0 };
            let color = plan.colors.map(|colors| u32::from_le_bytes(colors.rgba(index, vertex)));
            for &(around, across) in &surface.around {
                let way = direction(frame, around);
                row.used = 0;
                position(&mut row, plan, frame.point + way * radius);
                row.floats((if surface.is_tube { way } else { frame.out }).to_array());
                row.floats(root_uv.unwrap_or(Vec2::new(across, along)).to_array());
                row.words(color.as_slice());
                blocks.push_all(row.filled())?;
            }
        }
    }
    blocks.finish()
}

/// From the point to a vertex, of unit length.
#[inline]
fn direction(frame: &Frame, [cos, sin]: [f32; 2]) -> Vec3 {
    frame.across * cos + frame.out * sin
}

#[inline]
fn position(row: &mut Row, plan: &Plan<'_>, position: Vec3) {
    match plan.grid {
        Some(grid) if grid.is_stored() => {
            let [x, y, z] = grid.stored(position).map(u32::from);
            row.words(&[x | y << 16, z]);
        }
        Some(grid) => row.floats(grid.rounded(position).to_array()),
        None => row.floats(position.to_array()),
    }
}

/// The points of one strand and the frames there.
#[derive(Default)]
struct Strand {
    points: Vec<Vec3>,
    frames: Vec<Frame>,
}

impl Strand {
    fn frame(&mut self, drawable: Drawable<'_>, space: Space, range: std::ops::Range<usize>) {
        self.points.clear();
        let points = drawable.groom.positions().get(range).unwrap_or_default();
        self.points.extend(points.iter().map(|&point| space.vector(point)));
        frames(&self.points, &mut self.frames);
    }
}

/// One vertex as 32-bit words: at most 3 + 3 + 2 + 1.
#[derive(Default)]
struct Row {
    words: [u32; 9],
    used: usize,
}

impl Row {
    #[inline]
    fn words(&mut self, words: &[u32]) {
        if let Some(free) = self.words.get_mut(self.used..self.used + words.len()) {
            free.copy_from_slice(words);
            self.used += words.len();
        }
    }

    #[inline]
    fn floats<const N: usize>(&mut self, values: [f32; N]) {
        self.words(&values.map(f32::to_bits));
    }

    #[inline]
    fn filled(&self) -> &[u32] {
        self.words.get(..self.used).unwrap_or_default()
    }
}
