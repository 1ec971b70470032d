//! What is refused, what is degenerate, and that nothing panics.

use glam::{Vec3, vec3};
use proptest::prelude::*;

use crate::support::{Random, wander};
use strand_tracing::{
    BuildOptions, HitKind, Primitive, Radii, Ray, Strands, Tracer, TracingError, Triangles,
};

fn build(offsets: &[u32], positions: &[Vec3], radii: Radii) -> Result<Tracer, TracingError> {
    Tracer::build(&[Strands { offsets, positions, radii, moved: &[] }], &[], &BuildOptions::default())
}

#[test]
fn an_empty_scene_is_fine() {
    for tracer in [
        Tracer::build(&[], &[], &BuildOptions::default()).unwrap(),
        build(&[], &[], Radii::Constant(1.0)).unwrap(),
        build(&[0], &[], Radii::Constant(1.0)).unwrap(),
        build(&[0, 0, 1, 1], &[Vec3::ONE], Radii::Constant(1.0)).unwrap(),
    ] {
        let ray = Ray { origin: Vec3::ZERO, direction: Vec3::X, t_max: f32::INFINITY, time: 0.0 };
        assert_eq!(tracer.closest(&ray, None), None);
        assert!(!tracer.occluded(&ray, None));
        assert_eq!(tracer.bounds(), (Vec3::ZERO, Vec3::ZERO));
        assert_eq!((tracer.statistics().segments, tracer.statistics().nodes), (0, 0));
    }
}

#[test]
fn wrong_input_is_named() {
    let points = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let one = Radii::Constant(1.0);
    for offsets in [&[][..], &[1, 3], &[0, 2], &[0, 4], &[0, 2, 1, 3], &[0]] {
        let error = build(offsets, &points, one).unwrap_err();
        assert!(matches!(error, TracingError::Offsets { object: 0, .. }), "{error}");
    }
    let error = build(&[0, 3], &points, Radii::PerVertex(&[1.0])).unwrap_err();
    assert_eq!(error, TracingError::RadiusCount { object: 0, found: 1, expected: 3 });
    for bad in [f32::NAN, f32::INFINITY, -1.0] {
        assert!(matches!(
            build(&[0, 3], &points, Radii::PerVertex(&[1.0, bad, 1.0])),
            Err(TracingError::Radius { object: 0, point: 1, .. })
        ));
        assert!(build(&[0, 3], &points, Radii::Constant(bad)).is_err());
    }
    let nan = [Vec3::ZERO, vec3(0.0, f32::NAN, 0.0)];
    let error = build(&[0, 2], &nan, one).unwrap_err();
    assert!(error.to_string().starts_with("strands 0: point 1 is"), "{error}");
    let mesh = |positions: &[Vec3], index| {
        let indices = [[0, 1, index]];
        let mesh = Triangles { positions, indices: &indices, moved: &[] };
        Tracer::build(&[], &[mesh], &BuildOptions::default()).unwrap_err()
    };
    assert!(matches!(mesh(&points, 3), TracingError::Index { found: 3, vertices: 3, .. }));
    assert!(matches!(mesh(&nan, 1), TracingError::Vertex { vertex: 1, .. }));
}

#[test]
fn degenerate_segments() {
    let ray = Ray { origin: vec3(0.0, 0.0, 5.0), direction: Vec3::NEG_Z, t_max: f32::INFINITY, time: 0.0 };
    // No length: a sphere; its direction is its strand's.
    let points = [Vec3::ZERO, Vec3::ZERO, Vec3::ZERO, vec3(2.0, 0.0, 0.0)];
    let sphere = build(&[0, 3, 4], &points, Radii::Constant(1.0)).unwrap();
    let hit = sphere.closest(&ray, None).unwrap();
    assert_eq!((hit.t, hit.position), (4.0, Vec3::Z));
    let HitKind::Segment { tangent, .. } = hit.kind else { panic!() };
    assert_eq!(tangent, Vec3::Y);
    assert_eq!(sphere.closest(&Ray { origin: hit.position, ..ray }, Some(hit.primitive)), None);
    let strand = build(&[0, 4], &points, Radii::Constant(1.0)).unwrap();
    let HitKind::Segment { tangent, .. } = strand.closest(&ray, None).unwrap().kind else { panic!() };
    assert_eq!(tangent, Vec3::X);
    // One sphere within the other.
    let held = build(&[0, 2], &points[..2], Radii::PerVertex(&[1.0, 0.5])).unwrap();
    assert_eq!(held.closest(&ray, None).unwrap().t, 4.0);
    // No width: never hit. A point at one end only: a cone.
    let line = [vec3(-1.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0)];
    let none = build(&[0, 2], &line, Radii::Constant(0.0)).unwrap();
    assert_eq!((none.closest(&ray, None), none.statistics().segments), (None, 0));
    let cone = build(&[0, 2], &line, Radii::PerVertex(&[0.5, 0.0])).unwrap();
    let HitKind::Segment { h, u, .. } = cone.closest(&ray, None).unwrap().kind else { panic!() };
    assert!(h.abs() < 1e-6 && u > 0.3 && u < 0.5, "{h} {u}");
}

#[test]
fn ids_are_the_input_s_places() {
    let points = |y: f32| [vec3(0.0, y, 0.0), vec3(1.0, y, 0.0), vec3(2.0, y, 0.0), vec3(3.0, y, 0.0)];
    let (low, high) = ([points(0.0), points(1.0)].concat(), points(2.0));
    let radii = Radii::Constant(0.1);
    let strands = [
        Strands { offsets: &[0, 4, 4, 8], positions: &low, radii, moved: &[] },
        Strands { offsets: &[0], positions: &[], radii, moved: &[] },
        Strands { offsets: &[0, 4], positions: &high, radii, moved: &[] },
    ];
    let tracer = Tracer::build(&strands, &[], &BuildOptions::default()).unwrap();
    for (y, object, strand) in [(0.0, 0, 0), (1.0, 0, 2), (2.0, 2, 0)] {
        for segment in 0..3 {
            let origin = vec3(segment as f32 + 0.5, y, 5.0);
            let ray = Ray { origin, direction: Vec3::NEG_Z, t_max: 9.0, time: 0.0 };
            let hit = tracer.closest(&ray, None).unwrap();
            assert_eq!(hit.primitive, Primitive::Segment { object, strand, segment });
            assert!(!tracer.occluded(&ray, Some(hit.primitive)));
        }
    }
}

#[test]
fn building_twice_gives_the_same_and_the_first_of_twins_is_hit() {
    let mut random = Random(9);
    let mut hair = wander(&mut random, 1.0, Vec3::ZERO, 0.05, 0.5);
    let twin = hair.clone();
    let count = hair.positions.len() as u32;
    hair.positions.extend(&twin.positions);
    hair.radii.extend(&twin.radii);
    hair.offsets.extend(twin.offsets[1..].iter().map(|o| o + count));
    let (a, b) = (hair.tracer(), hair.tracer());
    let strands = twin.offsets.len() as u32 - 1;
    for _ in 0..2000 {
        let origin = random.cube() * 3.0;
        let direction = (random.cube() * 0.5 - origin).normalize();
        let ray = Ray { origin, direction, t_max: f32::INFINITY, time: 0.0 };
        let hit = a.closest(&ray, None);
        assert_eq!(hit, b.closest(&ray, None));
        if let Some(Primitive::Segment { strand, .. }) = hit.map(|h| h.primitive) {
            assert!(strand < strands);
        }
    }
}

fn number() -> impl Strategy<Value = f32> {
    prop_oneof![
        4 => -2.0_f32..2.0,
        1 => Just(0.0_f32),
        1 => Just(-0.0_f32),
        1 => Just(1.0_f32),
        1 => any::<f32>(),
    ]
}

fn place() -> impl Strategy<Value = Vec3> {
    (number(), number(), number()).prop_map(Vec3::from)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn nothing_panics(
        offsets in prop::collection::vec(0_u32..8, 0..5),
        positions in prop::collection::vec(place(), 0..8),
        radii in prop::collection::vec(number().prop_map(f32::abs), 0..8),
        indices in prop::collection::vec(prop::array::uniform3(0_u32..8), 0..4),
        rays in prop::collection::vec((place(), place(), number()), 1..6),
    ) {
        let positions_count = positions.len() as u32;
        let mut offsets: Vec<u32> = offsets.into_iter().map(|o| o.min(positions_count)).collect();
        offsets.sort_unstable();
        offsets.insert(0, 0);
        offsets.push(positions_count);
        let radii: Vec<f32> = radii.into_iter().chain([0.1; 8]).take(positions.len()).collect();
        let strands = Strands { offsets: &offsets, positions: &positions, radii: Radii::PerVertex(&radii), moved: &[] };
        let indices: Vec<_> = indices.into_iter().filter(|t| t.iter().all(|i| *i < positions_count)).collect();
        let triangles = Triangles { positions: &positions, indices: &indices, moved: &[] };
        let Ok(tracer) = Tracer::build(&[strands], &[triangles], &BuildOptions::default()) else {
            return Ok(());
        };
        for (origin, direction, t_max) in rays {
            let mut leaving = None;
            for direction in [direction, direction.normalize_or(Vec3::X)] {
                let ray = Ray { origin, direction, t_max, time: 0.0 };
                let hit = tracer.closest(&ray, leaving);
                prop_assert_eq!(hit.is_some(), tracer.occluded(&ray, leaving));
                if let Some(hit) = hit {
                    prop_assert!(hit.t <= t_max && hit.t >= 0.0);
                    leaving = Some(hit.primitive);
                }
            }
        }
    }
}
