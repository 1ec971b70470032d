//! Triangles: closed meshes stay closed, and brute force agrees.

use crate::support::Random;
use glam::{DVec3, Vec3, vec3};
use strand_tracing::{BuildOptions, HitKind, Primitive, Radii, Ray, Strands, Tracer, Triangles};

/// A sphere of `2 * n * n` triangles that share every edge.
fn sphere(n: u32, scale: f32, centre: Vec3) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    use std::f32::consts::{PI, TAU};
    let mut positions = vec![centre + Vec3::Y * scale, centre - Vec3::Y * scale];
    for ring in 1..n {
        for k in 0..n {
            let (theta, phi) = (PI * ring as f32 / n as f32, TAU * k as f32 / n as f32);
            let d = vec3(theta.sin() * phi.cos(), theta.cos(), theta.sin() * phi.sin());
            positions.push(centre + d * scale);
        }
    }
    let at = |ring: u32, k: u32| match ring {
        0 => 0,
        r if r == n => 1,
        r => 2 + (r - 1) * n + k % n,
    };
    let mut indices = Vec::new();
    for ring in 0..n {
        for k in 0..n {
            let [a, b, c, d] = [at(ring, k), at(ring, k + 1), at(ring + 1, k), at(ring + 1, k + 1)];
            if ring > 0 {
                indices.push([a, b, d]);
            }
            if ring + 1 < n {
                indices.push([a, d, c]);
            }
        }
    }
    (positions, indices)
}

fn tracer(positions: &[Vec3], indices: &[[u32; 3]]) -> Tracer {
    Tracer::build(&[], &[Triangles { positions, indices, moved: &[] }], &BuildOptions::default()).unwrap()
}

#[test]
fn a_closed_mesh_does_not_leak_at_edges_and_vertices() {
    let mut random = Random(2);
    for (scale, centre) in
        [(1.0, Vec3::ZERO), (1e-6, Vec3::ZERO), (50.0, vec3(1e6, -1e6, 3e5)), (1e6, Vec3::ONE)]
    {
        let (positions, indices) = sphere(24, scale, centre);
        let tracer = tracer(&positions, &indices);
        for triangle in &indices {
            let corners = triangle.map(|i| positions[i as usize]);
            for edge in 0..3 {
                for share in [0.0, 0.25, 0.5, 0.77] {
                    let target = corners[edge].lerp(corners[(edge + 1) % 3], share);
                    let origin = centre + random.cube() * scale * 0.3;
                    let direction = (target - origin).normalize();
                    let ray = Ray { origin, direction, t_max: f32::INFINITY, time: 0.0 };
                    let hit = tracer.closest(&ray, None).expect("a leak");
                    assert!(tracer.occluded(&ray, None));
                    let onward = Ray { origin: hit.position, ..ray };
                    let again = tracer.closest(&onward, Some(hit.primitive));
                    assert!(again.is_none_or(|a| a.t < 1e-3 * scale + 1.0), "{again:?}");
                }
            }
        }
    }
}

#[test]
fn agrees_with_brute_force() {
    let mut random = Random(4);
    let positions: Vec<Vec3> = (0..300).map(|_| random.cube()).collect();
    let indices: Vec<[u32; 3]> = (0..100).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let tracer = tracer(&positions, &indices);
    let mut hits = 0;
    for _ in 0..5000 {
        let ray = Ray { origin: random.cube() * 2.0, direction: random.direction(), t_max: 3.0, time: 0.0 };
        let mut expected: Option<(f64, u32)> = None;
        for (number, corners) in indices.iter().enumerate() {
            let corners = corners.map(|i| positions[i as usize].as_dvec3());
            if let Some(t) = plain(&ray, corners)
                && expected.is_none_or(|(nearest, _)| t < nearest)
            {
                expected = Some((t, number as u32));
            }
        }
        let found = tracer.closest(&ray, None);
        assert_eq!(found.is_some(), tracer.occluded(&ray, None));
        let (Some((t, number)), Some(hit)) = (expected, found) else {
            assert!(expected.is_none() && found.is_none(), "{expected:?} {found:?}");
            continue;
        };
        hits += 1;
        assert_eq!(hit.primitive, Primitive::Triangle { object: 0, triangle: number });
        assert!((f64::from(hit.t) - t).abs() < 1e-5);
        let HitKind::Triangle { barycentrics: [v, w], normal } = hit.kind else { panic!() };
        let [a, b, c] = indices[number as usize].map(|i| positions[i as usize]);
        assert!((a + (b - a) * v + (c - a) * w - hit.position).length() < 1e-5);
        assert!(((b - a).cross(c - a).normalize() - normal).length() < 1e-4);
        assert!((hit.position - ray.origin - ray.direction * hit.t).length() < 1e-5);
    }
    assert!(hits > 500);
}

/// Moller and Trumbore, in double precision.
fn plain(ray: &Ray, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let d = ray.direction.as_dvec3();
    let (e, f) = (b - a, c - a);
    let p = d.cross(f);
    let to = ray.origin.as_dvec3() - a;
    let u = to.dot(p) / e.dot(p);
    let q = to.cross(e);
    let v = d.dot(q) / e.dot(p);
    let t = f.dot(q) / e.dot(p);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && t <= f64::from(ray.t_max)).then_some(t)
}

#[test]
fn rays_along_axes_meet_flat_boxes() {
    let positions = [vec3(0.0, 0.0, 0.0), vec3(1.0, 0.0, 0.0), vec3(1.0, 1.0, 0.0), vec3(0.0, 1.0, 0.0)];
    let tracer = tracer(&positions, &[[0, 1, 2], [0, 2, 3]]);
    for (x, y) in [(0.0, 0.0), (0.5, 0.5), (1.0, 1.0), (0.0, 0.3), (1.0, 0.5), (0.2, 1.0), (0.7, 0.0)] {
        for way in [Vec3::Z, Vec3::NEG_Z] {
            let ray = Ray { origin: vec3(x, y, 0.0) - way * 2.0, direction: way, t_max: 2.0, time: 0.0 };
            let hit = tracer.closest(&ray, None).expect("a crossing");
            assert_eq!(hit.t, 2.0);
            let onward = Ray { origin: hit.position, ..ray };
            assert!(tracer.closest(&onward, Some(hit.primitive)).is_none());
        }
    }
    // In its plane a triangle has no width.
    let flat = Ray { origin: vec3(-1.0, 0.5, 0.0), direction: Vec3::X, t_max: 9.0, time: 0.0 };
    assert!(tracer.closest(&flat, None).is_none());
}

#[test]
fn hair_and_skin_are_traced_together() {
    let skin = [vec3(-1.0, 0.0, -1.0), vec3(1.0, 0.0, -1.0), vec3(0.0, 0.0, 1.0)];
    let hair = [Vec3::ZERO, Vec3::Y];
    let strands = Strands { offsets: &[0, 2], positions: &hair, radii: Radii::Constant(0.1), moved: &[] };
    let triangles = Triangles { positions: &skin, indices: &[[0, 1, 2]], moved: &[] };
    let empty = Triangles { positions: &[], indices: &[], moved: &[] };
    let tracer = Tracer::build(&[strands], &[empty, triangles], &BuildOptions::default()).unwrap();
    let down = |x| Ray { origin: vec3(x, 5.0, 0.0), direction: Vec3::NEG_Y, t_max: 9.0, time: 0.0 };
    let root = tracer.closest(&down(0.05), None).unwrap();
    assert_eq!(root.primitive, Primitive::Segment { object: 0, strand: 0, segment: 0 });
    // Through the fibre to the skin it grows from.
    let onward = Ray { origin: root.position, ..down(0.05) };
    let skin = tracer.closest(&onward, Some(root.primitive)).unwrap();
    assert_eq!(skin.primitive, Primitive::Triangle { object: 1, triangle: 0 });
    assert_eq!(tracer.closest(&down(0.5), None).unwrap().primitive, skin.primitive);
    assert_eq!((tracer.statistics().segments, tracer.statistics().triangles), (1, 1));
}

/// Nothing leaves a convex body outwards to meet it again, unless it stays within rounding of the surface
/// for longer than a triangle; and through the body there is always a far side.
#[test]
fn rays_that_leave_near_edges_do_not_meet_the_neighbours() {
    let mut random = Random(9);
    for (scale, centre, flattest) in
        [(1.0, Vec3::ZERO, -5.0), (1e-3, Vec3::ONE, -2.0), (50.0, vec3(1e4, -1e4, 3e3), -2.0)]
    {
        let (positions, indices) = sphere(24, scale, centre);
        let tracer = tracer(&positions, &indices);
        for triangle in &indices {
            let corners = triangle.map(|i| positions[i as usize]);
            for edge in 0..3 {
                for share in [0.0, 0.1, 0.5, 0.77] {
                    let target = corners[edge].lerp(corners[(edge + 1) % 3], share);
                    let origin = centre + (target - centre) * 3.0;
                    let direction = (target - origin).normalize();
                    let Some(hit) = tracer.closest(&Ray { origin, direction, t_max: 1e9, time: 0.0 }, None)
                    else {
                        continue;
                    };
                    let HitKind::Triangle { normal, .. } = hit.kind else { panic!() };
                    let out = normal * (hit.position - centre).dot(normal).signum();
                    for _ in 0..8 {
                        let along = random.direction().cross(out).normalize_or(Vec3::X);
                        let slope = 10.0_f32.powf(flattest * random.next());
                        let leave = |side: f32| Ray {
                            origin: hit.position,
                            direction: (along + out * (slope * side)).normalize(),
                            t_max: f32::INFINITY,
                            time: 0.0,
                        };
                        let again = tracer.closest(&leave(1.0), Some(hit.primitive));
                        assert_eq!(again, None, "slope {slope} from {hit:?}");
                        assert!(!tracer.occluded(&leave(1.0), Some(hit.primitive)));
                    }
                    let inwards =
                        Ray { origin: hit.position, direction: -out, t_max: f32::INFINITY, time: 0.0 };
                    assert!(tracer.occluded(&inwards, Some(hit.primitive)));
                }
            }
        }
    }
}

#[test]
fn a_neighbour_in_the_way_is_met() {
    // A floor and a wall on its edge.
    let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
    let tracer = tracer(&corners, &[[0, 1, 2], [0, 2, 3]]);
    for x in [0.3, 1e-3, 1e-5] {
        let origin = vec3(x, 0.3, 0.0);
        let ray =
            Ray { origin, direction: vec3(-1.0, 0.0, 0.5).normalize(), t_max: f32::INFINITY, time: 0.0 };
        let hit = tracer.closest(&ray, Some(Primitive::Triangle { object: 0, triangle: 0 })).unwrap();
        assert_eq!(hit.primitive, Primitive::Triangle { object: 0, triangle: 1 });
    }
}
