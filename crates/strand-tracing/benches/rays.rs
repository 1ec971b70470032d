//! Rays a second on one thread: this crate's tree against `obvhs`'s own two traversals, all with the same
//! exact intersector, on a generated ball of hair and, where `$GROOMKIT_DATA` has it, `hair/straight.hair`.
#![allow(missing_docs, dead_code, clippy::print_stdout, clippy::unwrap_used, clippy::indexing_slicing)]

use std::hint::black_box;
use std::time::{Duration, Instant};

use glam::{Vec3, Vec4, vec3};
use obvhs::BvhBuildParams;
use obvhs::bvh2::builder::build_bvh2;
use obvhs::cwbvh::builder::build_cwbvh;
use obvhs::ray::RayHit;
use strand_tracing::{BuildOptions, BuildQuality, Hit, Primitive, Radii, Ray, Strands, Tracer};

#[path = "common/ball.rs"]
mod ball;
#[path = "../src/bounds.rs"]
mod bounds;
#[path = "../src/cone_sphere.rs"]
mod cone_sphere;
#[path = "../src/line.rs"]
mod line;
#[path = "common/random.rs"]
mod random;

use ball::{Hair, ball};
use cone_sphere::ConeSphere;
use line::Line;
use random::Random;

/// Timings of which the best counts.
const ROUNDS: usize = 4;

fn straight() -> Option<Hair> {
    let data = std::env::var("GROOMKIT_DATA")
        .unwrap_or(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared/data").into());
    let bytes = std::fs::read(format!("{data}/hair/straight.hair")).ok()?;
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
    let (strands, points, arrays, usual) = (word(4), word(8), word(12), word(16));
    let mut at = 128;
    let mut offsets = vec![0];
    for strand in 0..strands as usize {
        let segments = match arrays & 1 {
            1 => u32::from(u16::from_le_bytes(bytes[at + 2 * strand..][..2].try_into().unwrap())),
            _ => usual,
        };
        offsets.push(offsets[strand] + segments + 1);
    }
    at += if arrays & 1 == 1 { 2 * strands as usize } else { 0 };
    let number = |i: usize| f32::from_bits(word(at + 4 * i));
    let positions: Vec<Vec3> =
        (0..points as usize).map(|p| vec3(number(3 * p), number(3 * p + 1), number(3 * p + 2))).collect();
    Some(Hair { name: "straight.hair", offsets, radii: vec![0.05; positions.len()], positions })
}

fn timed<T>(what: impl FnOnce() -> T) -> (T, f64) {
    let start = Instant::now();
    let result = what();
    (result, start.elapsed().as_secs_f64())
}

fn camera_rays(tracer: &Tracer, side: u32) -> Vec<Ray> {
    let (low, high) = tracer.bounds();
    let (centre, size) = ((low + high) * 0.5, (high - low).length());
    let eye = centre + vec3(0.3, 0.2, 1.0).normalize() * size;
    let ahead = (centre - eye).normalize();
    let right = ahead.cross(Vec3::Y).normalize();
    let up = right.cross(ahead);
    let pixel = |i: u32| (i as f32 + 0.5) / side as f32 - 0.5;
    (0..side * side)
        .map(|i| {
            let direction = ahead + right * pixel(i % side) * 0.7 + up * pixel(i / side) * 0.7;
            Ray { origin: eye, direction: direction.normalize(), t_max: f32::INFINITY, time: 0.0 }
        })
        .collect()
}

fn bounces(hits: &[Hit]) -> Vec<(Ray, Primitive)> {
    let mut random = Random(7);
    hits.iter()
        .map(|hit| {
            let direction = random.direction();
            (Ray { origin: hit.position, direction, t_max: f32::INFINITY, time: 0.0 }, hit.primitive)
        })
        .collect()
}

fn main() {
    for hair in [Some(ball(10_000, 24)), straight()].into_iter().flatten() {
        let only = std::env::var("BENCH_ONLY").unwrap_or_default();
        if !hair.name.contains(&only) {
            continue;
        }
        println!("{}: {} points", hair.name, hair.positions.len());
        let strands = Strands {
            offsets: &hair.offsets,
            positions: &hair.positions,
            radii: Radii::PerVertex(&hair.radii),
            moved: &[],
        };
        let mut rays = None;
        // Standard last: it is built like `obvhs`'s medium, so compared with it.
        for quality in [BuildQuality::Draft, BuildQuality::Best, BuildQuality::Standard] {
            let mut options = BuildOptions::default();
            options.quality = quality;
            let tracer = Tracer::build(&[strands], &[], &options).unwrap();
            let statistics = tracer.statistics();
            let primary = camera_rays(&tracer, 500);
            let (hits, seconds) =
                timed(|| primary.iter().filter_map(|ray| tracer.closest(ray, None)).collect::<Vec<_>>());
            let secondary = bounces(&hits);
            let (again, bounced) =
                timed(|| secondary.iter().filter(|(r, p)| tracer.closest(r, Some(*p)).is_some()).count());
            let (_, shadowed) =
                timed(|| secondary.iter().filter(|(r, p)| tracer.occluded(r, Some(*p))).count());
            println!(
                "  wide {quality:?}: build {:.2} s, {:.1} MB, primary {:.2}, bounce {:.2}, any {:.2} Mrays/s ({} hits, {again} again)",
                statistics.build_seconds,
                statistics.bytes as f64 / 1e6,
                primary.len() as f64 / seconds / 1e6,
                secondary.len() as f64 / bounced / 1e6,
                secondary.len() as f64 / shadowed / 1e6,
                hits.len(),
            );
            rays = Some((primary, secondary, tracer));
        }
        let Some((primary, secondary, tracer)) = rays else { continue };
        plain(&hair, &primary, &secondary, &tracer);
    }
}

/// `obvhs`'s own traversals. Of the rules for leaving a fibre they only know not to hit the segment left.
fn plain(hair: &Hair, primary: &[Ray], secondary: &[(Ray, Primitive)], ours: &Tracer) {
    let ends: Vec<(Vec4, Vec4, usize)> = hair
        .offsets
        .windows(2)
        .flat_map(|o| (o[0] as usize)..(o[1].saturating_sub(1) as usize))
        .map(|i| {
            let end = |i: usize| hair.positions[i].extend(hair.radii[i]);
            (end(i), end(i + 1), i)
        })
        .collect();
    let boxes: Vec<_> = ends.iter().map(|&(a, b, _)| bounds::of_segment(a, b)).collect();
    let (binary, binary_build) =
        timed(|| build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Duration::default()));
    let (wide, wide_build) =
        timed(|| build_cwbvh(&boxes, BvhBuildParams::medium_build(), &mut Duration::default()));
    let binary_ends: Vec<_> = binary.primitive_indices.iter().map(|&i| ends[i as usize]).collect();
    let wide_ends: Vec<_> = wide.primitive_indices.iter().map(|&i| ends[i as usize]).collect();
    let test = |(line, left): &(Line, usize), (a, b, number): (Vec4, Vec4, usize)| match ConeSphere::new(a, b)
        .entry(line)
    {
        Some(entry) if entry.t > 0.0 && number != *left => entry.t as f32,
        _ => f32::INFINITY,
    };
    let left = |primitive: &Primitive| match *primitive {
        Primitive::Segment { strand, segment, .. } => (hair.offsets[strand as usize] + segment) as usize,
        Primitive::Triangle { .. } => usize::MAX,
    };
    let convert = |(ray, left): &(Ray, usize)| {
        let plain = obvhs::ray::Ray::new(ray.origin.into(), ray.direction.into(), 0.0, f32::INFINITY);
        (plain, (Line::of(ray), *left))
    };
    let first: Vec<_> = primary.iter().map(|ray| (*ray, usize::MAX)).collect();
    let second: Vec<_> = secondary.iter().map(|(ray, from)| (*ray, left(from))).collect();
    for (name, build) in [("Bvh2", binary_build), ("CwBvh", wide_build)] {
        let rate = |rays: &[(Ray, usize)], any: bool| {
            let (_, seconds) = timed(|| {
                for ray in rays {
                    let (plain, line) = convert(ray);
                    let mut hit = RayHit::none();
                    black_box(match (name, any) {
                        ("Bvh2", false) => {
                            binary.ray_traverse(plain, &mut hit, |_, i| test(&line, binary_ends[i]))
                        }
                        ("Bvh2", true) => binary.ray_traverse_miss(plain, |_, i| test(&line, binary_ends[i])),
                        (_, false) => wide.ray_traverse(plain, &mut hit, |_, i| test(&line, wide_ends[i])),
                        (_, true) => wide.ray_traverse_miss(plain, |_, i| test(&line, wide_ends[i])),
                    });
                }
            });
            rays.len() as f64 / seconds / 1e6
        };
        // Side by side, the best of several: the machine's other work comes and goes.
        let mut theirs = [0.0_f64; 3];
        let mut our = [0.0_f64; 3];
        for _ in 0..ROUNDS {
            let found = [rate(&first, false), rate(&second, false), rate(&second, true)];
            theirs = std::array::from_fn(|i| theirs[i].max(found[i]));
            let found = our_rates(ours, primary, secondary);
            our = std::array::from_fn(|i| our[i].max(found[i]));
        }
        println!(
            "  obvhs {name}: build {build:.2} s, primary {:.2}, bounce {:.2}, any {:.2} Mrays/s",
            theirs[0], theirs[1], theirs[2]
        );
        println!(
            "    ours (Standard) over {name}: primary {:.2}, bounce {:.2}, any {:.2}",
            our[0] / theirs[0],
            our[1] / theirs[1],
            our[2] / theirs[2]
        );
    }
}

/// Millions of rays a second: primary, bounces, any hit of the bounces.
fn our_rates(tracer: &Tracer, primary: &[Ray], secondary: &[(Ray, Primitive)]) -> [f64; 3] {
    let (_, first) = timed(|| primary.iter().filter(|ray| tracer.closest(ray, None).is_some()).count());
    let (_, bounced) =
        timed(|| secondary.iter().filter(|(r, p)| tracer.closest(r, Some(*p)).is_some()).count());
    let (_, any) = timed(|| secondary.iter().filter(|(r, p)| tracer.occluded(r, Some(*p))).count());
    let rate = |rays: usize, seconds: f64| rays as f64 / seconds / 1e6;
    [rate(primary.len(), first), rate(secondary.len(), bounced), rate(secondary.len(), any)]
}
