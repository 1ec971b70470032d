//! The whole head of hair.

use glam::Vec3;
use groom::{Attribute, Domain, Groom, Values, names, random};

use crate::trigonometry::{cos, sin};
use crate::{Options, SampleError, Style, dress, grow, head};

/// What makes a style, in metres.
struct Shape {
    length: f32,
    /// Where the scissors go: hair that falls below this height ends there.
    cut: f32,
    /// How many locks strands gather in; 0 for hair that falls freely.
    locks: u32,
    /// How much of the way a tip moves to its lock's middle.
    gathering: f32,
    /// How far waves or curls reach, and how far it is from one to the next along the strand.
    reach: f32,
    pitch: f32,
    /// 0 waves to and fro, 1 winds round.
    winding: f32,
}

fn shape(style: Style) -> Shape {
    match style {
        Style::Straight => Shape {
            length: 0.34,
            cut: -0.165,
            locks: 420,
            gathering: 0.35,
            reach: 0.0,
            pitch: 1.0,
            winding: 0.0,
        },
        Style::Wavy => Shape {
            length: 0.36,
            cut: -0.175,
            locks: 170,
            gathering: 0.6,
            reach: 0.0065,
            pitch: 0.062,
            winding: 0.25,
        },
        Style::Curly => Shape {
            length: 0.27,
            cut: -0.16,
            locks: 190,
            gathering: 0.75,
            reach: 0.011,
            pitch: 0.060,
            winding: 1.0,
        },
    }
}

/// A lock: where it grows, and the path its strands gather around.
struct Lock {
    root: Vec3,
    path: Vec<Vec3>,
    id: u32,
}

/// Makes a head of hair: y up, in metres, with a `radius` at each point that tapers to the tip and
/// is as thick as it takes for the strands to cover the head.
///
/// # Errors
/// [`SampleError::Option`] for options out of their range.
pub fn hair(options: &Options) -> Result<Groom, SampleError> {
    options.check()?;
    let shape = shape(options.style);
    let locks = locks(options, &shape);
    let (mut offsets, mut positions) = (vec![0], Vec::new());
    for (id, root) in (0..options.strands).zip(head::roots(options.strands)) {
        let fine = strand(options, &shape, &locks, id, root);
        positions.extend(thin_out(&fine, point_count(options, id)));
        offsets.push(positions.len() as u32);
    }
    let mut groom = Groom::new(offsets, positions)?;
    dress::radius(&mut groom, options.strands, shape.length)?;
    if options.color {
        dress::color(&mut groom, options.seed)?;
    }
    if options.transparency {
        let values = groom.along_strands().into_iter().map(|t| 0.6 * t * t).collect();
        let attribute = Attribute { domain: Domain::Vertex, values: Values::Float(values) };
        groom.set_attribute(names::TRANSPARENCY, attribute)?;
    }
    Ok(groom)
}

fn locks(options: &Options, shape: &Shape) -> Vec<Lock> {
    let roots = head::roots(shape.locks.min(options.strands));
    // Locks draw their chances from ids no strand has.
    let ids = (0..=u32::MAX).rev();
    let grow = |(root, id)| Lock { root, path: grow::path(root, id, options.seed, shape.length), id };
    roots.zip(ids).map(grow).collect()
}

/// The points of one strand, as finely as it was grown.
fn strand(options: &Options, shape: &Shape, locks: &[Lock], id: u32, root: Vec3) -> Vec<Vec3> {
    let length = shape.length * (0.78 + 0.3 * random(options.seed, id, "length"));
    let mut points = grow::path(root, id, options.seed, length);
    // Where two locks meet across the parting a strand stays with those that fall to its own side.
    let side = grow::side(root, id, options.seed);
    let own_side = |lock: &&Lock| grow::side(lock.root, lock.id, options.seed) == side;
    let near = |a: &&Lock, b: &&Lock| a.root.distance_squared(root).total_cmp(&b.root.distance_squared(root));
    let lock = locks.iter().filter(own_side).min_by(near);
    let Some(lock) = lock else { return points };
    for (i, point) in points.iter_mut().enumerate() {
        let t = i as f32 / grow::STEPS as f32;
        let gathered = shape.gathering * t * (2.0 - t);
        *point = point.lerp(lock.path[i], gathered) + curl(options.seed, shape, lock, id, i, length * t);
        if i > 0 {
            *point = head::keep_off(
                *point,
                0.001 * (1.0 + random(options.seed, id, "rest")) * (t * 20.0).min(1.0),
            );
        }
    }
    // Blunt, but not as if by a laser.
    let cut = shape.cut - 0.012 * random(options.seed, id, "cut");
    let kept = points.iter().position(|p| p.y < cut).map_or(points.len(), |below| below.max(2));
    points.truncate(kept);
    points
}

/// How far waves or curls carry a point `along` metres from its root off its path.
fn curl(seed: u64, shape: &Shape, lock: &Lock, id: u32, i: usize, along: f32) -> Vec3 {
    if shape.reach == 0.0 {
        return Vec3::ZERO;
    }
    let (before, after) = (lock.path[i.max(1) - 1], lock.path[(i + 1).min(grow::STEPS)]);
    let tangent = (after - before).normalize_or(Vec3::NEG_Y);
    let out = head::normal(lock.path[i]);
    let side = tangent.cross(out).normalize_or(Vec3::X);
    let up = side.cross(tangent);
    // One lock curls as one; its strands differ a little in phase and reach.
    let turn = f64::from(random(seed, lock.id, "phase") + 0.09 * random(seed, id, "phase"));
    let pitch = shape.pitch * (0.8 + 0.4 * random(seed, lock.id, "pitch"));
    let angle = std::f64::consts::TAU * (turn + f64::from(along / pitch));
    let hand = if random(seed, lock.id, "hand") < 0.5 { -1.0 } else { 1.0 };
    let reach = shape.reach * (0.7 + 0.6 * random(seed, id, "reach")) * (along / 0.05).min(1.0);
    (side * sin(angle) + up * (shape.winding * hand * cos(angle))) * reach
}

fn point_count(options: &Options, id: u32) -> u32 {
    if !options.vary_points {
        return options.points;
    }
    let part = 0.6 + 0.4 * random(options.seed, id, "length");
    ((options.points as f32 * part).round() as u32).max(3)
}

/// `count` points evenly spread over the steps of a finely grown strand.
fn thin_out(fine: &[Vec3], count: u32) -> impl Iterator<Item = Vec3> + '_ {
    let steps = (fine.len() - 1) as f32;
    (0..count).map(move |i| {
        let at = steps * i as f32 / (count - 1) as f32;
        let from = (at as usize).min(fine.len() - 2);
        fine[from].lerp(fine[from + 1], at - from as f32)
    })
}
