//! Things that move: a ray sees what a still scene of its time holds.
#![allow(clippy::unwrap_used, clippy::panic)]

mod support;

use glam::Vec3;
use strand_tracing::{BuildOptions, Hit, Ray, Tracer, Triangles};
use support::{Hair, Random, wander};

/// Positions at a time, told from the definition alone.
fn posed(keys: &[Vec<Vec3>], time: f32) -> Vec<Vec3> {
    let intervals = keys.len() - 1;
    let place = f64::from(time) * intervals as f64;
    let before = (place.floor() as usize).min(intervals.saturating_sub(1));
    let share = place - before as f64;
    let after = (before + 1).min(intervals);
    let pair = keys[before].iter().zip(&keys[after]);
    pair.map(|(a, b)| (a.as_dvec3() * (1.0 - share) + b.as_dvec3() * share).as_vec3()).collect()
}

/// Hair and a mesh, each with keys of its own.
struct Scene {
    hair: Hair,
    hair_keys: Vec<Vec<Vec3>>,
    indices: Vec<[u32; 3]>,
    mesh_keys: Vec<Vec<Vec3>>,
}

impl Scene {
    /// As many keys as given; `wild` is how far things go between two, as a share of the scene.
    fn random(random: &mut Random, scale: f32, offset: Vec3, keys: [usize; 2], wild: f32) -> Self {
        let hair = wander(random, scale, offset, 0.04, 0.8);
        let triangles = 12;
        let corners: Vec<Vec3> = (0..3 * triangles).map(|_| random.cube() * scale + offset).collect();
        let moved = |random: &mut Random, first: &[Vec3], count: usize| {
            let mut keys = vec![first.to_vec()];
            while keys.len() < count {
                let turn = random.direction() * wild;
                let next = keys[keys.len() - 1].iter().map(|p| {
                    let p = p - offset;
                    offset + p + turn.cross(p) + random.cube() * (0.1 * wild * scale)
                });
                let next = next.collect();
                keys.push(next);
            }
            keys
        };
        let hair_keys = moved(random, &hair.positions, keys[0]);
        let mesh_keys = moved(random, &corners, keys[1]);
        let indices = (0..triangles).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Self { hair, hair_keys, indices, mesh_keys }
    }

    fn moving(&self) -> Tracer {
        let hair: Vec<&[Vec3]> = self.hair_keys[1..].iter().map(Vec::as_slice).collect();
        let mesh: Vec<&[Vec3]> = self.mesh_keys[1..].iter().map(Vec::as_slice).collect();
        let strands = strand_tracing::Strands { moved: &hair, ..self.hair.strands() };
        let triangles = Triangles { positions: &self.mesh_keys[0], indices: &self.indices, moved: &mesh };
        Tracer::build(&[strands], &[triangles], &BuildOptions::default()).unwrap()
    }

    fn still(&self, time: f32) -> (Hair, Tracer) {
        let hair = Hair { positions: posed(&self.hair_keys, time), ..self.hair.clone() };
        let corners = posed(&self.mesh_keys, time);
        let triangles = Triangles { positions: &corners, indices: &self.indices, moved: &[] };
        let tracer = Tracer::build(&[hair.strands()], &[triangles], &BuildOptions::default()).unwrap();
        (hair, tracer)
    }
}

fn times(random: &mut Random) -> Vec<f32> {
    let mut times = vec![0.0, 1.0, 0.5, 0.25, 1.0 / 3.0, f32::MIN_POSITIVE, 1.0_f32.next_down()];
    times.extend((0..5).map(|_| random.next()));
    times
}

/// A ray at some point of some strand or anywhere.
fn aimed(random: &mut Random, hair: &Hair, scale: f32, offset: Vec3) -> (Vec3, Vec3) {
    let point = ((random.next() * hair.positions.len() as f32) as usize).min(hair.positions.len() - 1);
    let target = if random.next() < 0.7 {
        hair.positions[point] + random.direction() * (0.06 * scale * random.next())
    } else {
        offset + random.cube() * scale
    };
    let direction = if random.next() < 0.2 {
        [Vec3::X, Vec3::NEG_Y, Vec3::Z][(random.next() * 3.0) as usize % 3]
    } else {
        random.direction()
    };
    (target - direction * (scale * 4.0 * random.next()), direction)
}

/// Everything two tracers can be asked, along a path of a few bounces.
fn same(moving: &Tracer, still: &Tracer, random: &mut Random, mut ray: Ray) -> usize {
    let mut leaving = None;
    let mut hits = 0;
    for _ in 0..4 {
        let expected: Option<Hit> = still.closest(&ray, leaving);
        let found = moving.closest(&ray, leaving);
        assert_eq!(found, expected, "{ray:?} leaving {leaving:?}");
        assert_eq!(moving.occluded(&ray, leaving), expected.is_some());
        let Some(hit) = found else { break };
        hits += 1;
        leaving = Some(hit.primitive);
        ray = Ray { origin: hit.position, direction: random.direction(), ..ray };
    }
    hits
}

#[test]
fn a_ray_sees_the_still_scene_of_its_time() {
    let mut random = Random(41);
    let mut hits = 0;
    for (scale, far) in [(1.0, 0.0), (1e-6, 0.0), (1e-6, 1e-2), (10.0, 1e6), (1e6, 1.0)] {
        let offset = Vec3::new(far, -far, 0.5 * far);
        for keys in [[2, 2], [3, 3], [1, 2], [2, 1], [5, 5], [3, 4], [4, 2]] {
            for wild in [0.02, 0.3, 2.0] {
                let scene = Scene::random(&mut random, scale, offset, keys, wild);
                let moving = scene.moving();
                for time in times(&mut random) {
                    let (hair, still) = scene.still(time);
                    for _ in 0..25 {
                        let (origin, direction) = aimed(&mut random, &hair, scale, offset);
                        let ray = Ray { origin, direction, t_max: f32::INFINITY, time };
                        hits += same(&moving, &still, &mut random, ray);
                    }
                }
            }
        }
    }
    assert!(hits > 20_000, "{hits}");
}
