//! Things that move: a ray sees what a still scene of its time holds.

use crate::support::{Hair, Random, wander};
use glam::{Vec3, vec3};
use proptest::prelude::*;
use strand_tracing::{BuildOptions, Hit, HitKind, Radii, Ray, Strands, Tracer, TracingError, Triangles};

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
        let strands = Strands { moved: &hair, ..self.hair.strands() };
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

/// With one pose of many keys the tree has fewer keys than the object, and must still lose nothing.
#[test]
fn objects_of_more_keys_than_a_tree_has_are_followed() {
    let mut random = Random(43);
    let mut hits = 0;
    for keys in [[20, 18], [34, 3], [1, 40]] {
        for wild in [0.05, 1.0] {
            let scene = Scene::random(&mut random, 1.0, Vec3::ONE, keys, wild);
            let moving = scene.moving();
            for time in times(&mut random) {
                let (hair, still) = scene.still(time);
                for _ in 0..40 {
                    let (origin, direction) = aimed(&mut random, &hair, 1.0, Vec3::ONE);
                    let ray = Ray { origin, direction, t_max: f32::INFINITY, time };
                    hits += same(&moving, &still, &mut random, ray);
                }
            }
        }
    }
    assert!(hits > 2000, "{hits}");
}

/// Long needles in a heap are cut into pieces, which must move with them.
#[test]
fn needles_cut_into_pieces_move() {
    let mut random = Random(47);
    let mut hair = Hair::new();
    for _ in 0..300 {
        let (middle, way) = (random.cube() * 0.2, random.direction());
        hair.push([(middle - way, 0.004), (middle + way, 0.001)]);
    }
    let mut keys = vec![hair.positions.clone()];
    for _ in 0..3 {
        keys.push(hair.positions.iter().map(|p| p + random.cube()).collect());
    }
    let scene = Scene { hair, hair_keys: keys.clone(), indices: Vec::new(), mesh_keys: vec![Vec::new()] };
    let moving = scene.moving();
    let mut hits = 0;
    for time in times(&mut random) {
        let (hair, still) = scene.still(time);
        for _ in 0..300 {
            let (origin, direction) = aimed(&mut random, &hair, 0.1, Vec3::ZERO);
            hits += same(&moving, &still, &mut random, Ray { origin, direction, t_max: 1e3, time });
        }
    }
    assert!(hits > 2000, "{hits}");
}

#[test]
fn a_segment_has_the_direction_it_has_at_the_time() {
    let keys = [[Vec3::ZERO, Vec3::X], [Vec3::ZERO, Vec3::Y]];
    let strands =
        Strands { offsets: &[0, 2], positions: &keys[0], radii: Radii::Constant(0.1), moved: &[&keys[1]] };
    let tracer = Tracer::build(&[strands], &[], &BuildOptions::default()).unwrap();
    for (time, x, y) in [(0.0, 1.0, 0.0), (1.0, 0.0, 1.0), (0.5, 0.5, 0.5), (0.25, 0.75, 0.25)] {
        let along = Vec3::new(x, y, 0.0);
        let down = Ray { origin: along * 0.8 + Vec3::Z, direction: Vec3::NEG_Z, t_max: 9.0, time };
        let hit = tracer.closest(&down, None).unwrap();
        let HitKind::Segment { u, tangent, h, normal, .. } = hit.kind else { panic!() };
        assert!((tangent - along.normalize()).length() < 1e-6 && (normal - Vec3::Z).length() < 1e-6);
        assert!((u - 0.8).abs() < 1e-6 && h.abs() < 1e-6 && (hit.t - 0.9).abs() < 1e-6);
        let elsewhere = Ray { time: if time < 0.5 { 1.0 } else { 0.0 }, ..down };
        assert!(tracer.closest(&elsewhere, None).is_none() || time == 0.5);
    }
    assert_eq!(tracer.bounds().0.floor(), Vec3::splat(-1.0));
    assert!(tracer.bounds().1.cmpge(vec3(1.1, 1.1, 0.1)).all());
}

/// A segment that shrinks to nothing takes its neighbour's direction, as at that time.
#[test]
fn a_segment_that_loses_its_length_is_a_sphere() {
    let keys = [[Vec3::ZERO, Vec3::X, vec3(3.0, 0.0, 0.0)], [Vec3::X, Vec3::X, vec3(1.0, 3.0, 0.0)]];
    let strands =
        Strands { offsets: &[0, 3], positions: &keys[0], radii: Radii::Constant(0.5), moved: &[&keys[1]] };
    let tracer = Tracer::build(&[strands], &[], &BuildOptions::default()).unwrap();
    let ray = Ray { origin: vec3(0.8, -0.1, 9.0), direction: Vec3::NEG_Z, t_max: 99.0, time: 1.0 };
    let hit = tracer.closest(&ray, None).unwrap();
    let HitKind::Segment { tangent, .. } = hit.kind else { panic!() };
    assert_eq!(tangent, Vec3::Y);
}

#[test]
fn rays_outside_the_shutter_hit_nothing_that_could_move() {
    let mut random = Random(53);
    let scene = Scene::random(&mut random, 1.0, Vec3::ZERO, [2, 1], 0.5);
    let (moving, (_, still)) = (scene.moving(), scene.still(0.0));
    for _ in 0..500 {
        let (origin, direction) = aimed(&mut random, &scene.hair, 1.0, Vec3::ZERO);
        let ray = |time| Ray { origin, direction, t_max: f32::INFINITY, time };
        for time in [f32::NAN, -1e-6, 1.0_f32.next_up(), f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(moving.closest(&ray(time), None), None);
            assert!(!moving.occluded(&ray(time), None));
            // Where nothing moves, there is no time.
            assert_eq!(still.closest(&ray(time), None), still.closest(&ray(0.0), None));
        }
        assert_eq!(moving.closest(&ray(-0.0), None), still.closest(&ray(0.0), None));
    }
}

#[test]
fn what_stands_still_costs_nothing() {
    let mut random = Random(59);
    let scene = Scene::random(&mut random, 1.0, Vec3::ZERO, [1, 1], 0.5);
    let same_keys = Scene {
        hair: scene.hair.clone(),
        hair_keys: vec![scene.hair_keys[0].clone(); 4],
        indices: scene.indices.clone(),
        mesh_keys: vec![scene.mesh_keys[0].clone(); 3],
    };
    let moving_mesh = Scene::random(&mut Random(59), 1.0, Vec3::ZERO, [1, 2], 0.5);
    let of = |scene: &Scene| {
        let tracer = scene.moving();
        (tracer.statistics().bytes, tracer.statistics().nodes)
    };
    assert_eq!(of(&same_keys), of(&scene));
    assert_eq!([scene.moving(), moving_mesh.moving()].map(|t| t.statistics().tree_keys), [0, 2]);
    let (bytes, _) = of(&scene);
    let (more, _) = of(&moving_mesh);
    // A dozen triangles move: a few boxes and corners, and nothing for the hair.
    assert!(more > bytes && more < bytes + 4000, "{bytes} {more}");
}

#[test]
fn what_cannot_be_hit_does_not_move_the_scene() {
    let (here, there) = ([Vec3::X, Vec3::ONE], [Vec3::splat(50.0), Vec3::splat(60.0)]);
    let radii = Radii::Constant(0.0);
    let nothing = Strands { offsets: &[0, 2], positions: &here, radii, moved: &[&there] };
    let still = Strands { radii: Radii::Constant(0.1), moved: &[], ..nothing };
    let tracer = Tracer::build(&[nothing, still], &[], &BuildOptions::default()).unwrap();
    assert!(tracer.bounds().0.cmpge(vec3(0.89, -0.11, -0.11)).all() && tracer.bounds().1.max_element() < 1.2);
    let ray = Ray { origin: vec3(1.0, 0.5, 5.0), direction: Vec3::NEG_Z, t_max: 9.0, time: f32::NAN };
    assert!(tracer.occluded(&ray, None));
    let nothing = Tracer::build(&[nothing], &[], &BuildOptions::default()).unwrap();
    assert_eq!(nothing.bounds(), (Vec3::ZERO, Vec3::ZERO));
}

#[test]
fn keys_that_do_not_fit_are_named() {
    let points = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let nan = [Vec3::ZERO, Vec3::X, vec3(0.0, f32::NAN, 0.0)];
    let strands = |moved: &[&[Vec3]]| {
        let radii = Radii::Constant(0.1);
        let strands = Strands { offsets: &[0, 3], positions: &points, radii, moved };
        Tracer::build(&[strands], &[], &BuildOptions::default()).unwrap_err()
    };
    let triangles = |moved: &[&[Vec3]], indices: &[[u32; 3]]| {
        let triangles = Triangles { positions: &points, indices, moved };
        Tracer::build(&[], &[triangles], &BuildOptions::default())
    };
    let expected = TracingError::MovedPoints { object: 0, key: 2, found: 2, expected: 3 };
    assert_eq!(strands(&[&points, &points[1..]]), expected);
    let error = strands(&[&points, &nan]).to_string();
    assert!(error.starts_with("strands 0: point 2 is [0, NaN, 0] at key 2"), "{error}");
    let expected = TracingError::MovedVertices { object: 0, key: 1, found: 0, expected: 3 };
    assert_eq!(triangles(&[&[]], &[[0, 1, 2]]).unwrap_err(), expected);
    let error = triangles(&[&nan], &[[0, 1, 2]]).unwrap_err();
    assert!(matches!(error, TracingError::MovedVertex { object: 0, key: 1, vertex: 2, .. }), "{error}");
    assert!(matches!(triangles(&[&[]], &[]).unwrap_err(), TracingError::MovedVertices { found: 0, .. }));
    // A vertex no triangle has is not asked for, as at the first key.
    assert!(triangles(&[&nan], &[[0, 1, 1]]).is_ok());
}

fn number() -> impl Strategy<Value = f32> {
    let any = any::<f32>().prop_filter("finite", |x| x.is_finite());
    prop_oneof![6 => -2.0_f32..2.0, 1 => Just(0.0_f32), 1 => any]
}

fn place() -> impl Strategy<Value = Vec3> {
    (number(), number(), number()).prop_map(Vec3::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(3000))]

    /// Whatever the keys and the rays; and where numbers are not too large to be squared, the hits are right.
    #[test]
    fn nothing_panics_and_nothing_is_lost(
        points in prop::collection::vec(prop::array::uniform3(place()), 2..7),
        keys in 1_usize..4,
        radius in 0.0_f32..0.5,
        rays in prop::collection::vec((place(), place(), 0.0_f32..1.0), 1..6),
    ) {
        let key = |key: usize| points.iter().map(|p| p[key]).collect::<Vec<Vec3>>();
        let keys: Vec<Vec<Vec3>> = (0..keys).map(key).collect();
        let count = points.len() as u32;
        let radii = vec![radius; points.len()];
        let hair = Hair { offsets: vec![0, count], positions: keys[0].clone(), radii };
        let indices = (2..count).map(|i| [i - 2, i - 1, i]).collect();
        let scene = Scene { hair, hair_keys: keys.clone(), indices, mesh_keys: keys.clone() };
        let moving = scene.moving();
        let small = keys.iter().flatten().all(|p| p.abs().max_element() < 1e15);
        for (origin, direction, time) in rays {
            let ray = Ray { origin, direction: direction.normalize_or(Vec3::X), t_max: f32::INFINITY, time };
            let hit = moving.closest(&ray, None);
            prop_assert_eq!(hit.is_some(), moving.occluded(&ray, None));
            if small && origin.abs().max_element() < 1e15 {
                prop_assert_eq!(hit, scene.still(time).1.closest(&ray, None));
            }
        }
    }
}
