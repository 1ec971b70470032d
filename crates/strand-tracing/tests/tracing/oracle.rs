//! What is hit, where and how, against ternary search over swept spheres.

use crate::support::{Hair, Random, Span, Swept, wander};
use glam::{DVec3, Vec3};
use strand_tracing::{Hit, HitKind, Primitive, Ray};

/// Scale of the scene, its distance from the origin, radius relative to the scale.
const SCENES: [(f32, f32, f32); 9] = [
    (1.0, 0.0, 0.05),
    (1.0, 0.0, 0.3),
    (1.0, 0.0, 1e-6),
    (1e-6, 0.0, 0.05),
    (1e-6, 0.01, 0.05),
    (1e3, 1e6, 0.05),
    (10.0, 1e6, 0.3),
    (1e6, 1e6, 0.01),
    (1e6, 0.0, 1e-4),
];

#[test]
fn agrees_with_brute_force_from_outside() {
    let mut random = Random(11);
    let mut compared = 0;
    for (scene, &(scale, far, thickness)) in SCENES.iter().enumerate() {
        let offset = Vec3::new(far, -far, 0.5 * far);
        let hair = wander(&mut random, scale, offset, thickness, 0.8);
        let tracer = hair.tracer();
        let all = hair.spheres();
        for _ in 0..700 {
            let ray = aimed(&mut random, &hair, scale, thickness);
            if all.iter().any(|(.., s)| s.distance(ray.origin.as_dvec3()) < 0.1 * s.ra.max(s.rb)) {
                continue;
            }
            let spans: Vec<_> =
                all.iter().filter_map(|(a, b, s)| Some((*a, *b, *s, s.span(&ray)?))).collect();
            let first = spans
                .iter()
                .filter(|(.., span)| span.enter > 0.0)
                .min_by(|x, y| x.3.enter.total_cmp(&y.3.enter));
            let hit = tracer.closest(&ray, None);
            assert_eq!(hit.is_some(), tracer.occluded(&ray, None));
            if spans.iter().any(|(.., span)| span.depth < 1e-4) {
                continue;
            }
            let Some((_, _, swept, span)) = first else {
                assert!(hit.is_none(), "scene {scene}: {hit:?} where nothing is");
                continue;
            };
            let hit = hit.unwrap_or_else(|| panic!("scene {scene}: missed {span:?} {swept:?} {ray:?}"));
            compare(&hair, &ray, &hit, swept, span);
            compared += 1;
        }
    }
    assert!(compared > 2000, "{compared}");
}

/// A ray at some point of some strand, from anywhere; every fourth along an axis.
fn aimed(random: &mut Random, hair: &Hair, scale: f32, thickness: f32) -> Ray {
    let point = ((random.next() * hair.positions.len() as f32) as usize).min(hair.positions.len() - 1);
    let across = random.direction() * (random.next() * 1.5 * scale * thickness);
    let target = hair.positions[point] + across;
    let direction = if random.next() < 0.25 {
        [Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z][(random.next() * 6.0) as usize]
    } else {
        random.direction()
    };
    let origin = target - direction * (scale * 4.0 * random.next());
    let direction = if direction.abs().max_element() == 1.0 {
        direction
    } else {
        (target - origin).as_dvec3().normalize_or(direction.as_dvec3()).as_vec3()
    };
    Ray { origin, direction, t_max: f32::INFINITY, time: 0.0 }
}

fn compare(hair: &Hair, ray: &Ray, hit: &Hit, swept: &Swept, span: &Span) {
    let radius = swept.radius(span.u);
    let ulp = f64::from(f32::EPSILON);
    let (o, d) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let size = hit.position.as_dvec3().abs().max_element();
    let t_error = (f64::from(hit.t) - span.enter).abs();
    assert!(t_error <= 1e-5 * radius + ulp * span.enter, "t {t_error} of {radius}");
    let off = (hit.position.as_dvec3() - (o + d * span.enter)).length();
    assert!(off <= 1e-5 * radius + ulp * size, "position {off} of {radius}");
    let Primitive::Segment { object: 0, strand, segment } = hit.primitive else { panic!() };
    let HitKind::Segment { u, tangent, h, radius: found, normal } = hit.kind else { panic!() };
    let at = (hair.offsets[strand as usize] + segment) as usize;
    let along = hair.positions[at + 1].as_dvec3() - hair.positions[at].as_dvec3();
    assert!((tangent.as_dvec3() - along.normalize()).length() < 1e-6);
    assert!((f64::from(found) - radius).abs() < 1e-3 * radius, "{found} {radius}");
    assert!((0.0..=1.0).contains(&u) && (-1.0..=1.0).contains(&h));
    assert!(normal.is_normalized() && normal.as_dvec3().dot(d) < 1e-5);

    // The frame as the renderer builds it.
    let x = tangent.as_dvec3();
    let z = -d - x * x.dot(-d);
    if z.length() < 1e-3 {
        return;
    }
    let y = z.normalize().cross(x);
    let outward: DVec3 = o + d * span.enter - swept.centre(span.u);
    assert!((outward.normalize() - normal.as_dvec3()).length() < 1e-3);
    assert!((outward.dot(y) / radius - f64::from(h)).abs() < 1e-3, "h {h} {}", outward.dot(y) / radius);
}

#[test]
fn joints_do_not_leak() {
    let mut random = Random(5);
    for bend in [0.1, 1.0, 8.0] {
        let hair = wander(&mut random, 1.0, Vec3::ZERO, 0.02, bend);
        let tracer = hair.tracer();
        for range in hair.offsets.windows(2) {
            for joint in range[0] as usize + 1..range[1] as usize - 1 {
                for _ in 0..40 {
                    let inside = random.direction() * (hair.radii[joint] * 0.999 * random.next().cbrt());
                    let direction = random.direction();
                    let origin = hair.positions[joint] + inside - direction * 3.0;
                    let ray = Ray { origin, direction, t_max: 3.0 + hair.radii[joint], time: 0.0 };
                    assert!(tracer.occluded(&ray, None));
                    assert!(tracer.closest(&ray, None).is_some());
                }
            }
        }
    }
}

#[test]
fn distances_are_respected() {
    let mut random = Random(3);
    let hair = wander(&mut random, 1.0, Vec3::ZERO, 0.1, 0.8);
    let tracer = hair.tracer();
    let mut hits = 0;
    for _ in 0..5000 {
        let ray = aimed(&mut random, &hair, 1.0, 0.1);
        let Some(hit) = tracer.closest(&ray, None) else { continue };
        hits += 1;
        assert!(hit.t >= 0.0);
        let shorter = Ray { t_max: hit.t * (1.0 - 1e-6), ..ray };
        assert!(tracer.closest(&shorter, None).is_none() && !tracer.occluded(&shorter, None));
        let longer = Ray { t_max: hit.t * (1.0 + 1e-6), ..ray };
        assert_eq!(tracer.closest(&longer, None), Some(hit));
        assert!(tracer.occluded(&longer, None));
    }
    assert!(hits > 1000);
}
