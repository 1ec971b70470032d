//! Rays that start on a fibre: they are not stopped by what they leave, and by nothing less.

use crate::support::{Hair, Random, Span, wander};
use glam::{Vec3, vec3};
use strand_tracing::{Primitive, Ray, Tracer};

fn segment(primitive: Primitive) -> (u32, u32) {
    match primitive {
        Primitive::Segment { strand, segment, .. } => (strand, segment),
        Primitive::Triangle { .. } => panic!("no triangles here"),
    }
}

/// A hit on the hair from a random side.
fn touch(random: &mut Random, hair: &Hair, tracer: &Tracer, back: f32) -> Option<strand_tracing::Hit> {
    let last = hair.positions.len() - 1;
    let low = ((random.next() * last as f32) as usize).min(last - 1);
    let target = hair.positions[low].lerp(hair.positions[low + 1], random.next());
    let direction = random.direction();
    tracer
        .closest(&Ray { origin: target - direction * back, direction, t_max: f32::INFINITY, time: 0.0 }, None)
}

/// A straight strand is convex: nothing that leaves it comes back, inwards or outwards, however thin it
/// is and however far from the origin.
#[test]
fn straight_strands_do_not_stop_their_own_light() {
    let ways = [Vec3::X, vec3(0.3, 1.0, 0.2), vec3(1.0, -1.0, 1.0)];
    for (scale, radius, far) in [(1.0, 0.01, 0.0), (1.0, 1e-6, 0.0), (1.0, 1e-6, 1.0), (40.0, 0.5, 1e6)] {
        let mut random = Random(17);
        let mut touched = 0;
        for way in ways.map(Vec3::normalize) {
            for tip in [1.0, 0.25] {
                let mut hair = Hair::new();
                hair.push((0..=8).map(|i| {
                    let s = i as f32 / 8.0;
                    (way * scale * s + Vec3::splat(far), radius * (1.0 + (tip - 1.0) * s))
                }));
                let tracer = hair.tracer();
                for _ in 0..4000 {
                    let Some(hit) = touch(&mut random, &hair, &tracer, scale * 0.1) else { continue };
                    touched += 1;
                    for _ in 0..10 {
                        let direction = random.direction();
                        let onward = Ray { origin: hit.position, direction, t_max: f32::INFINITY, time: 0.0 };
                        let again = tracer.closest(&onward, Some(hit.primitive));
                        assert!(again.is_none(), "radius {radius} at {far}: {again:?} from {hit:?}");
                        assert!(!tracer.occluded(&onward, Some(hit.primitive)));
                    }
                }
            }
        }
        assert!(touched > 10_000, "{touched}");
    }
}

/// Along the fibre is the hard way out: through every segment and joint, or just above them.
#[test]
fn rays_almost_along_a_straight_strand_leave_it() {
    let mut random = Random(23);
    for (radius, far) in [(0.01, 0.0), (1e-6, 0.0), (0.5, 1e6)] {
        let mut hair = Hair::new();
        let way = vec3(1.0, 0.7, -0.4).normalize();
        let length = radius * 1000.0;
        hair.push((0..=50).map(|i| (way * length * (i as f32 / 50.0) + Vec3::splat(far), radius)));
        let tracer = hair.tracer();
        for _ in 0..20_000 {
            let Some(hit) = touch(&mut random, &hair, &tracer, length) else { continue };
            let slope = 10.0_f32.powf(-6.0 * random.next());
            let along = if random.next() < 0.5 { way } else { -way };
            let direction = (along + random.direction() * slope).normalize();
            let onward = Ray { origin: hit.position, direction, t_max: f32::INFINITY, time: 0.0 };
            assert_eq!(tracer.closest(&onward, Some(hit.primitive)), None, "from {hit:?}");
        }
    }
}

/// On bent strands: the stretch inside the strand does not count, everything after it does.
#[test]
fn bent_strands_agree_with_brute_force() {
    let mut random = Random(29);
    let (mut hits, mut own) = (0, 0);
    for bend in [0.3, 1.0, 4.0] {
        let hair = wander(&mut random, 0.5, Vec3::ZERO, 0.04, bend);
        let tracer = hair.tracer();
        let all = hair.spheres();
        for _ in 0..2500 {
            let Some(hit) = touch(&mut random, &hair, &tracer, 3.0) else { continue };
            let from = segment(hit.primitive);
            let ray =
                Ray { origin: hit.position, direction: random.direction(), t_max: f32::INFINITY, time: 0.0 };
            let spans: Vec<(u32, u32, Span)> =
                all.iter().filter_map(|(a, b, s)| Some((*a, *b, s.span(&ray)?))).collect();
            let Some(out) = way_out(&spans, from) else { continue };
            let expected = spans
                .iter()
                .filter(|(strand, piece, span)| {
                    let least = if *strand == from.0 { out } else { 0.0 };
                    (*strand, *piece) != from && span.enter > least
                })
                .min_by(|x, y| x.2.enter.total_cmp(&y.2.enter));
            let found = tracer.closest(&ray, Some(hit.primitive));
            assert_eq!(found.is_some(), tracer.occluded(&ray, Some(hit.primitive)));
            match (expected, found) {
                (None, None) => {}
                (Some((strand, _, span)), Some(found)) => {
                    hits += 1;
                    own += usize::from(*strand == from.0);
                    assert!((f64::from(found.t) - span.enter).abs() < 1e-5, "{found:?} {span:?}");
                }
                other => panic!("{other:?} leaving {from:?}"),
            }
        }
    }
    assert!(hits > 300 && own > 30, "{hits} {own}");
}

/// Where the ray leaves the strand it starts in; nothing where rounding could decide either way, where it
/// also starts in another strand, or where a loop of the strand runs through itself.
fn way_out(spans: &[(u32, u32, Span)], from: (u32, u32)) -> Option<f64> {
    const CLOSE: f64 = 1e-5;
    let unclear = |span: &Span| span.depth < 1e-3 || span.enter.abs() < CLOSE || span.exit.abs() < CLOSE;
    if spans.iter().any(|(a, b, s)| (*a, *b) != from && unclear(s)) {
        return None;
    }
    if spans.iter().any(|(a, _, s)| *a != from.0 && s.enter < 0.0 && s.exit > 0.0) {
        return None;
    }
    let mine: Vec<_> = spans.iter().filter(|(a, ..)| *a == from.0).collect();
    let mut out: f64 = mine.iter().find(|(_, b, _)| *b == from.1).map_or(0.0, |s| s.2.exit.max(0.0));
    let mut joined = vec![from.1];
    while let Some((_, b, span)) =
        mine.iter().find(|(_, b, s)| !joined.contains(b) && s.exit > 0.0 && s.enter <= out)
    {
        out = out.max(span.exit);
        joined.push(*b);
    }
    if mine.iter().any(|(_, b, s)| !joined.contains(b) && (s.enter - out).abs() < CLOSE) {
        return None;
    }
    joined.sort_unstable();
    joined.windows(2).all(|pair| pair[1] == pair[0] + 1).then_some(out)
}

#[test]
fn a_curl_that_comes_back_is_hit() {
    let mut hair = Hair::new();
    hair.push((0..200).map(|i| {
        let angle = i as f32 * 0.2;
        (vec3(angle.cos(), 0.1 * angle, angle.sin()), 0.05)
    }));
    let tracer = hair.tracer();
    let down = Ray { origin: vec3(1.0, 10.0, 0.0), direction: Vec3::NEG_Y, t_max: f32::INFINITY, time: 0.0 };
    let first = tracer.closest(&down, None).unwrap();
    // Through the first coil (it is not in its own way) on to the next, a turn below.
    let onward = Ray { origin: first.position, ..down };
    let second = tracer.closest(&onward, Some(first.primitive)).unwrap();
    assert!((second.t - 0.1 * std::f32::consts::TAU).abs() < 0.05, "{second:?}");
    let (_, here) = segment(first.primitive);
    let (_, there) = segment(second.primitive);
    assert!(here.abs_diff(there) >= 30);
}

#[test]
fn across_a_bend_the_other_arm_is_hit() {
    let mut hair = Hair::new();
    hair.push([(vec3(0.0, 1.0, 0.0), 0.05), (Vec3::ZERO, 0.05), (vec3(1.0, 0.0, 0.0), 0.05)]);
    let tracer = hair.tracer();
    let ray = Ray { origin: vec3(2.0, 0.5, 0.0), direction: Vec3::NEG_X, t_max: f32::INFINITY, time: 0.0 };
    let hit = tracer.closest(&ray, None).unwrap();
    let down =
        Ray { origin: hit.position, direction: vec3(1.0, -1.0, 0.0).normalize(), t_max: 9.0, time: 0.0 };
    let arm = tracer.closest(&down, Some(hit.primitive)).unwrap();
    assert_eq!(segment(arm.primitive), (0, 1));
    // Straight down inside the arm, through the joint and out of the bottom: still the same fibre.
    let through =
        Ray { origin: hit.position, direction: vec3(-0.1, -1.0, 0.0).normalize(), t_max: 9.0, time: 0.0 };
    assert_eq!(tracer.closest(&through, Some(hit.primitive)), None);
}

#[test]
fn from_inside_a_fibre_its_joints_are_not_hit() {
    let mut hair = Hair::new();
    hair.push([(Vec3::ZERO, 0.1), (vec3(1.0, 0.0, 0.0), 0.1), (vec3(2.0, 0.3, 0.0), 0.08)]);
    hair.push([(vec3(3.0, -1.0, 0.0), 0.1), (vec3(3.0, 1.0, 0.0), 0.1)]);
    let tracer = hair.tracer();
    let ray = Ray { origin: vec3(0.5, 0.0, 0.01), direction: Vec3::X, t_max: f32::INFINITY, time: 0.0 };
    let hit = tracer.closest(&ray, None).unwrap();
    assert_eq!(segment(hit.primitive), (1, 0));
    let short = Ray { t_max: 2.0, ..ray };
    assert!(!tracer.occluded(&short, None));
}

#[test]
fn a_primitive_that_is_not_there_changes_nothing() {
    let mut random = Random(31);
    let hair = wander(&mut random, 1.0, Vec3::ZERO, 0.1, 0.5);
    let tracer = hair.tracer();
    let all = [u32::MAX, 0, 7];
    for object in all {
        for strand in all {
            for segment in [u32::MAX, 1000] {
                let ray = Ray {
                    origin: Vec3::splat(3.0),
                    direction: Vec3::splat(-1.0).normalize(),
                    t_max: 9.0,
                    time: 0.0,
                };
                let wrong = Primitive::Segment { object, strand, segment };
                assert_eq!(tracer.closest(&ray, Some(wrong)), tracer.closest(&ray, None));
                let wrong = Primitive::Triangle { object, triangle: segment };
                assert_eq!(tracer.closest(&ray, Some(wrong)), tracer.closest(&ray, None));
            }
        }
    }
}
