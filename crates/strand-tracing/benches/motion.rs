//! Rays a second at random times through a ball of hair that spins in the shutter: the tree whose boxes move,
//! beside the same rays through a tree whose boxes hold every key (with the same packs), and beside as many
//! through still hair.
//!
//! `BENCH_STRANDS` (10000) sets the size of the ball, `BENCH_ONLY` ("45 3") picks a row; all timings of a row
//! are taken in turns, the best counts.
#![allow(missing_docs, dead_code, unused_imports, clippy::print_stdout, clippy::unwrap_used)]

use std::hint::black_box;
use std::time::Instant;

use glam::{Quat, Vec3, Vec4, Vec4Swizzles, vec3};
use strand_tracing::{
    BuildOptions, BuildQuality, Hit, HitKind, Primitive, Radii, Ray, Strands, Tracer, TracingError, Triangles,
};

#[path = "../src/arrange.rs"]
mod arrange;
#[path = "common/ball.rs"]
mod ball;
#[path = "../src/bounds.rs"]
mod bounds;
#[path = "../src/build.rs"]
mod build;
#[path = "../src/cone_sphere.rs"]
mod cone_sphere;
#[path = "../src/fibres.rs"]
mod fibres;
#[path = "../src/inside.rs"]
mod inside;
#[path = "../src/intervals.rs"]
mod intervals;
#[path = "../src/keys.rs"]
mod keys;
#[path = "../src/line.rs"]
mod line;
#[path = "../src/meshes.rs"]
mod meshes;
#[path = "../src/moving.rs"]
mod moving;
#[path = "../src/moving_packs.rs"]
mod moving_packs;
#[path = "../src/moving_pieces.rs"]
mod moving_pieces;
#[path = "../src/moving_tree.rs"]
mod moving_tree;
#[path = "../src/moving_triangles.rs"]
mod moving_triangles;
#[path = "../src/pack.rs"]
mod pack;
#[path = "../src/pieces.rs"]
mod pieces;
#[path = "../src/pose.rs"]
mod pose;
#[path = "../src/query.rs"]
mod query;
#[path = "common/random.rs"]
mod random;
#[path = "../src/search.rs"]
mod search;
#[path = "../src/shares.rs"]
mod shares;
#[path = "../src/slabs.rs"]
mod slabs;
#[path = "../src/stray.rs"]
mod stray;
#[path = "../src/tracks.rs"]
mod tracks;
#[path = "../src/triangle.rs"]
mod triangle;
#[path = "../src/walk.rs"]
mod walk;
#[path = "../src/wide_tree.rs"]
mod wide_tree;

use ball::{Hair, ball};
use fibres::Fibres;
use meshes::Meshes;
use moving_packs::MovingPacks;
use moving_pieces::MovingPieces;
use pose::Moment;
use query::Query;
use random::Random;
use search::{Candidates, Nearest};
use shares::Shares;
use walk::walk;
use wide_tree::WideTree;

/// Timings of every run, of which the best counts.
const ROUNDS: usize = 8;
/// Rays of a run.
const RUN: usize = 256;
/// The tree whose boxes hold all keys is so slow that it gets only every so manieth run.
const NAIVE: usize = 16;
const SEGMENTS: u32 = 24;

/// The ball at keys evenly spaced over a turn about the vertical; the turn is centred on the shutter.
fn spun(hair: &Hair, degrees: f32, keys: usize) -> Vec<Vec<Vec3>> {
    (0..keys)
        .map(|key| {
            let turn = degrees.to_radians() * (key as f32 / (keys - 1).max(1) as f32 - 0.5);
            let turn = Quat::from_rotation_y(if keys == 1 { 0.0 } else { turn });
            hair.positions.iter().map(|&p| turn * p).collect()
        })
        .collect()
}

/// The same strands and packs under boxes that hold all keys and stand still.
struct AllKeys {
    tree: WideTree,
    packs: MovingPacks,
    intervals: usize,
    seconds: f64,
}

impl AllKeys {
    fn build(fibres: &Fibres, meshes: &Meshes, intervals: usize) -> Self {
        let start = Instant::now();
        let pieces = MovingPieces::cut(&Moment { fibres, meshes, time: 0.5 }, intervals);
        let around = |piece| {
            let boxes = (0..=intervals).map(|key| pieces.ends(piece, key));
            boxes.map(|(a, b)| bounds::of_segment(a, b)).reduce(|a, b| a.union(&b)).unwrap()
        };
        let binary =
            build::binary(&pieces.all.iter().map(around).collect::<Vec<_>>(), BuildQuality::Standard);
        let mut packs = MovingPacks::new(intervals + 1);
        let tree = WideTree::from_binary(
            &binary,
            |_| true,
            |places| packs.push(&pieces, places.iter().map(|&place| &pieces.all[place as usize])),
        );
        packs.finish();
        Self { tree, packs, intervals, seconds: start.elapsed().as_secs_f64() }
    }
}

impl Candidates for AllKeys {
    #[inline(always)]
    fn candidates<const ORDERED: bool>(
        &self,
        ray: &Ray,
        far: &mut f32,
        mut visit: impl FnMut(u32, &mut f32) -> bool,
    ) {
        let shares = Shares::of(f64::from(ray.time), self.intervals);
        let sight = self.packs.sight(ray);
        walk::<ORDERED>(&self.tree, ray, far, |leaf, far| {
            let near = self.packs.near(&sight, &shares, leaf);
            (0..4).any(|lane| near >> lane & 1 == 1 && visit(self.packs.number(leaf, lane), far))
        });
    }
}

fn camera_rays(side: u32, random: &mut Random) -> Vec<Ray> {
    let eye = vec3(0.3, 0.2, 1.0).normalize() * 36.0;
    let ahead = -eye.normalize();
    let right = ahead.cross(Vec3::Y).normalize();
    let up = right.cross(ahead);
    let pixel = |i: u32| (i as f32 + 0.5) / side as f32 - 0.5;
    (0..side * side)
        .map(|i| {
            let direction = ahead + right * pixel(i % side) * 0.7 + up * pixel(i / side) * 0.7;
            Ray { origin: eye, direction: direction.normalize(), t_max: f32::INFINITY, time: random.next() }
        })
        .collect()
}

/// A ray of the hit's time from every hit.
fn bounces(rays: &[Ray], tracer: &Tracer, random: &mut Random) -> Vec<(Ray, Option<Primitive>)> {
    rays.iter()
        .filter_map(|ray| Some((ray.time, tracer.closest(ray, None)?)))
        .map(|(time, hit)| {
            let (origin, direction) = (hit.position, random.direction());
            (Ray { origin, direction, t_max: f32::INFINITY, time }, Some(hit.primitive))
        })
        .collect()
}

type Asked = (Ray, Option<Primitive>);

/// One kind of question asked of many rays, timed in short runs: on a busy machine the best time of a short run
/// is found sooner than that of a long one.
struct Timed<'a> {
    rays: &'a [Asked],
    ask: &'a dyn Fn(&Asked) -> bool,
    best: Vec<f64>,
}

impl<'a> Timed<'a> {
    fn new(rays: &'a [Asked], ask: &'a dyn Fn(&Asked) -> bool) -> Self {
        Self { rays, ask, best: vec![f64::INFINITY; rays.len().div_ceil(RUN)] }
    }

    fn round(&mut self) {
        for (run, best) in self.rays.chunks(RUN).zip(&mut self.best) {
            let start = Instant::now();
            black_box(run.iter().filter(|asked| (self.ask)(asked)).count());
            *best = best.min(start.elapsed().as_secs_f64());
        }
    }

    /// Millions of rays a second.
    fn rate(&self) -> f64 {
        self.rays.len() as f64 / self.best.iter().sum::<f64>() / 1e6
    }
}

fn main() {
    let strands = std::env::var("BENCH_STRANDS").ok().and_then(|text| text.parse().ok()).unwrap_or(10_000);
    let only = std::env::var("BENCH_ONLY").unwrap_or_default();
    let hair = ball(strands, SEGMENTS);
    println!("ball of {strands} strands, {} points; Mrays/s primary, bounce, any", hair.positions.len());
    let mut random = Random(7);
    let primary = camera_rays(200, &mut random);
    let still = spun(&hair, 0.0, 1);
    let still = build(&hair, &still);
    let bytes = still.statistics().bytes;
    for degrees in [0.0, 5.0, 45.0] {
        for keys in [2, 3, 5, 9] {
            let wanted = only.is_empty() || only == format!("{degrees} {keys}");
            if degrees == 0.0 && keys != 2 || !wanted {
                continue;
            }
            row(&hair, &still, &primary, bytes, degrees, keys);
        }
    }
}

fn build(hair: &Hair, keys: &[Vec<Vec3>]) -> Tracer {
    let moved: Vec<&[Vec3]> = keys[1..].iter().map(Vec::as_slice).collect();
    Tracer::build(&[hair.strands(&keys[0], &moved)], &[], &BuildOptions::default()).unwrap()
}

impl Hair {
    fn strands<'a>(&'a self, positions: &'a [Vec3], moved: &'a [&'a [Vec3]]) -> Strands<'a> {
        Strands { offsets: &self.offsets, positions, radii: Radii::PerVertex(&self.radii), moved }
    }
}

fn row(hair: &Hair, still: &Tracer, primary: &[Ray], bytes: usize, degrees: f32, keys: usize) {
    let mut positions = spun(hair, degrees, keys);
    if degrees == 0.0 {
        // Keys that are all the same are none: one hair a little off makes them count.
        positions[1][0].x += 1e-3;
    }
    let moved: Vec<&[Vec3]> = positions[1..].iter().map(Vec::as_slice).collect();
    let moving = build(hair, &positions);
    let fibres = Fibres::gather(&[hair.strands(&positions[0], &moved)]).unwrap();
    let meshes = Meshes::default();
    let around = AllKeys::build(&fibres, &meshes, keys - 1);
    let mut random = Random(5);
    let secondary = bounces(primary, &moving, &mut random);
    let still_secondary = bounces(primary, still, &mut random);
    let primary: Vec<Asked> = primary.iter().map(|ray| (*ray, None)).collect();
    let naive = |(ray, left): &Asked| {
        let pose = Moment { fibres: &fibres, meshes: &meshes, time: f64::from(ray.time) };
        Query::new(pose, ray, *left)
    };
    let some = |rays: &[Asked]| rays.chunks(RUN).step_by(NAIVE).flatten().copied().collect::<Vec<_>>();
    let (few_first, few_second) = (some(&primary), some(&secondary));
    let still_closest = |(ray, left): &Asked| still.closest(ray, *left).is_some();
    let still_any = |(ray, left): &Asked| still.occluded(ray, *left);
    let moving_closest = |(ray, left): &Asked| moving.closest(ray, *left).is_some();
    let moving_any = |(ray, left): &Asked| moving.occluded(ray, *left);
    let naive_closest = |asked: &Asked| {
        let query = naive(asked);
        let mut nearest = Nearest::new(&asked.0);
        nearest.search(&around, &query, &asked.0);
        nearest.describe(&query, &asked.0).is_some()
    };
    let naive_any = |asked: &Asked| search::any(&around, &naive(asked), &asked.0);
    let mut timed = [
        Timed::new(&primary, &still_closest),
        Timed::new(&still_secondary, &still_closest),
        Timed::new(&still_secondary, &still_any),
        Timed::new(&primary, &moving_closest),
        Timed::new(&secondary, &moving_closest),
        Timed::new(&secondary, &moving_any),
        Timed::new(&few_first, &naive_closest),
        Timed::new(&few_second, &naive_closest),
        Timed::new(&few_second, &naive_any),
    ];
    for _ in 0..ROUNDS {
        timed.iter_mut().for_each(Timed::round);
    }
    for (ray, left) in &few_second {
        let found = search::any(&around, &naive(&(*ray, *left)), ray);
        assert_eq!(found, moving.occluded(ray, *left), "the two trees find the same");
    }
    let [of_still, of_moving, of_naive] =
        [0, 3, 6].map(|first| [0, 1, 2].map(|kind: usize| timed[first + kind].rate()));
    let statistics = moving.statistics();
    let ratios =
        |a: [f64; 3], b: [f64; 3]| format!("{:.2} {:.2} {:.2}", a[0] / b[0], a[1] / b[1], a[2] / b[2]);
    println!(
        "  {degrees:2} degrees, {keys} keys ({} of the tree): {:.2} {:.2} {:.2}; over boxes of all keys {}; over still {}; \
         build {:.2} s (still {:.2}, all keys {:.2}); {:.1} MB + {:.1} MB a further key",
        statistics.tree_keys,
        of_moving[0],
        of_moving[1],
        of_moving[2],
        ratios(of_moving, of_naive),
        ratios(of_moving, of_still),
        statistics.build_seconds,
        still.statistics().build_seconds,
        around.seconds,
        bytes as f64 / 1e6,
        (statistics.bytes - bytes) as f64 / (keys - 1) as f64 / 1e6,
    );
}
