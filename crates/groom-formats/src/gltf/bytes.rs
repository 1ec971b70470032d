//! The binary buffer: the arrays one after the other, each made in one pass.

use std::io::{self, Write};

use bytemuck::NoUninit;
use glam::Vec3;
use groom::{Domain, Values};

use super::Plan;
use super::blocks::Blocks;
use super::extra::Extra;
use super::moving::Moving;
use super::runs::runs;
use super::surface;
use super::views::Content;

pub(super) fn write(plan: &Plan<'_>, stream: &mut impl Write) -> io::Result<()> {
    for view in &plan.views {
        match view.content {
            Content::Lines => lines(plan, stream)?,
            Content::Triangles => {
                let Some(surface) = &plan.surface else { continue };
                surface::write_triangles(surface, plan.drawable, stream)?;
            }
            Content::Surface => {
                let Some(surface) = &plan.surface else { continue };
                surface::write_vertices(surface, plan, stream)?;
            }
            Content::Positions => positions(plan, stream)?,
            Content::Colors => {
                let Some(colors) = plan.colors else { continue };
                each_vertex(plan, stream, |strand, vertex| colors.rgba(strand, vertex))?;
            }
            Content::Widths => {
                let radii = plan.drawable.groom.radii();
                each_vertex(plan, stream, |strand, vertex| plan.width(radii.get(strand, vertex)))?;
            }
            Content::Extra(extra) => custom(plan, extra, stream)?,
            Content::Joints => joints(plan, stream)?,
            Content::Weights => {
                let Moving::Skin(skin) = &plan.moving else { continue };
                each_vertex(plan, stream, |strand, _| skin.influences(strand).weights)?;
            }
        }
    }
    Ok(())
}

fn joints(plan: &Plan<'_>, stream: &mut impl Write) -> io::Result<()> {
    let Moving::Skin(skin) = &plan.moving else { return Ok(()) };
    if skin.is_wide() {
        each_vertex(plan, stream, |strand, _| skin.influences(strand).joints.map(|joint| joint as u16))
    } else {
        each_vertex(plan, stream, |strand, _| skin.influences(strand).joints.map(|joint| joint as u8))
    }
}

fn lines(plan: &Plan<'_>, stream: &mut impl Write) -> io::Result<()> {
    let mut blocks = Blocks::new(stream);
    let mut first = 0_u32;
    for (_, range) in plan.drawable.strands() {
        let last = first + (range.len() as u32 - 1);
        for index in first..last {
            blocks.push([index, index + 1])?;
        }
        first = last + 1;
    }
    blocks.finish()
}

fn positions(plan: &Plan<'_>, stream: &mut impl Write) -> io::Result<()> {
    let space = plan.space;
    match plan.grid {
        Some(grid) if grid.is_stored() => each_point(plan, stream, |point| {
            let [x, y, z] = grid.stored(space.vector(point));
            [x, y, z, 0]
        }),
        Some(grid) => each_point(plan, stream, |point| grid.rounded(space.vector(point)).to_array()),
        None if space.is_the_same() => {
            let mut blocks = Blocks::new(stream);
            for run in runs(plan.drawable) {
                blocks.write(plan.drawable.groom.positions().get(run.vertices).unwrap_or_default())?;
            }
            blocks.finish()
        }
        None => each_point(plan, stream, |point| space.vector(point).to_array()),
    }
}

/// An attribute, spread over the vertices.
fn custom(plan: &Plan<'_>, extra: Extra<'_>, stream: &mut impl Write) -> io::Result<()> {
    let domain = extra.attribute.domain;
    let at = move |strand: usize, vertex: usize| match domain {
        Domain::Groom => 0,
        Domain::Strand => strand,
        Domain::Vertex => vertex,
    };
    match &extra.attribute.values {
        Values::Float(values) => each_vertex(plan, stream, |s, v| values[at(s, v)]),
        Values::Int(values) => each_vertex(plan, stream, |s, v| values[at(s, v)] as f32),
        Values::Vec2(values) => each_vertex(plan, stream, |s, v| values[at(s, v)].to_array()),
        Values::Vec3(values) if extra.is_velocity => {
            each_vertex(plan, stream, |s, v| plan.velocity(values[at(s, v)]).to_array())
        }
        Values::Vec3(values) => each_vertex(plan, stream, |s, v| values[at(s, v)].to_array()),
    }
}

fn each_point<T: NoUninit>(
    plan: &Plan<'_>,
    stream: &mut impl Write,
    make: impl Fn(Vec3) -> T,
) -> io::Result<()> {
    let mut blocks = Blocks::new(stream);
    for run in runs(plan.drawable) {
        for &point in plan.drawable.groom.positions().get(run.vertices).unwrap_or_default() {
            blocks.push(make(point))?;
        }
    }
    blocks.finish()
}

/// `make` gets strand and vertex, as indices in the groom; every vertex of a surface gets its point's.
fn each_vertex<T: NoUninit>(
    plan: &Plan<'_>,
    stream: &mut impl Write,
    make: impl Fn(usize, usize) -> T,
) -> io::Result<()> {
    let mut blocks = Blocks::new(stream);
    let times = plan.surface.as_ref().map_or(1, surface::Surface::per_point);
    for (strand, range) in plan.drawable.strands() {
        for vertex in range {
            let value = make(strand, vertex);
            for _ in 0..times {
                blocks.push(value)?;
            }
        }
    }
    blocks.finish()
}
