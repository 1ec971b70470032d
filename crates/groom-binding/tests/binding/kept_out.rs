//! Strands kept out of the mesh.

use glam::{DQuat, DVec3, Vec3, dvec3};
use groom::Groom;
use groom_binding::{BindOptions, Binding, Carrier, CarryOptions, CarryReport};
use moving_mesh::Pose;

use crate::shapes::{Mesh, egg};
use crate::strands;

/// How often the mesh winds round a place: 1 inside, 0 outside (van Oosterom, Strackee: The Solid Angle of a Plane
/// Triangle, 1983).
fn winding(mesh: &Mesh, pose: &Pose, place: DVec3) -> f64 {
    let angle = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| pose.positions[v as usize] - place);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    mesh.triangles.iter().map(angle).sum::<f64>() / (4.0 * std::f64::consts::PI)
}

fn carried(groom: &Groom, mesh: &Mesh, keep_out: Option<f64>, pose: &Pose) -> (Vec<Vec3>, CarryReport) {
    let binding = Binding::new(groom, &mesh.surface(), &BindOptions::default()).unwrap().0;
    let options = CarryOptions { keep_out, ..CarryOptions::default() };
    let mut out = Vec::new();
    let report =
        Carrier::new(groom, &binding, mesh.surface(), options).unwrap().positions(pose, &mut out).unwrap();
    (out, report)
}

/// Strands from the surface of the egg to anywhere, most of them through it.
fn wild(count: u32) -> Groom {
    let mut groom = strands(count, 0.0, 9);
    for strand in 0..groom.strand_count() {
        let range = groom.strand_range(strand);
        let root = groom.positions()[range.start] * 1.001;
        let turn = glam::Quat::from_axis_angle(Vec3::new(0.6, 0.0, 0.8), strand as f32);
        for p in &mut groom.positions_mut()[range] {
            *p = root + turn * (*p - root);
        }
    }
    groom
}

fn pinched(p: DVec3) -> DVec3 {
    DQuat::from_rotation_z(0.6 * p.y) * (p * dvec3(1.0, 1.0 - 0.3 * p.x, 1.0)) + dvec3(4.0, 0.0, 1.0)
}

#[test]
fn no_point_is_left_inside_and_no_length_is_changed() {
    let (mesh, groom) = (egg(20, 30), wild(400));
    for pose in [mesh.rest.clone(), mesh.posed(pinched)] {
        let (through, _) = carried(&groom, &mesh, None, &pose);
        let (out, report) = carried(&groom, &mesh, Some(0.02), &pose);
        let (mut before, mut after) = (0, 0);
        for strand in 0..groom.strand_count() {
            let range = groom.strand_range(strand);
            assert_eq!(out[range.start], through[range.start], "roots stay");
            for i in range.clone().skip(1) {
                before += usize::from(winding(&mesh, &pose, through[i].as_dvec3()) > 0.5);
                after += usize::from(winding(&mesh, &pose, out[i].as_dvec3()) > 0.5);
            }
            for i in range.skip(1) {
                let (now, then) =
                    (out[i].distance(out[i - 1]), groom.positions()[i].distance(groom.positions()[i - 1]));
                assert!((now - then).abs() < 2e-6, "strand {strand}: {now} {then}");
            }
        }
        assert!(before > 200 && report.pushed >= before, "{before} {report:?}");
        // What is told is what another method sees.
        assert_eq!((report.inside, after), (0, 0), "{report:?}");
        assert_eq!(report.deepest, 0.0);
    }
}

#[test]
fn strands_that_touch_nothing_keep_their_bits() {
    let (mesh, groom) = (egg(20, 30), wild(400));
    let pose = mesh.posed(pinched);
    let (through, _) = carried(&groom, &mesh, None, &pose);
    let (out, report) = carried(&groom, &mesh, Some(0.0), &pose);
    let untouched = (0..groom.strand_count())
        .filter(|&s| {
            let range = groom.strand_range(s);
            range.clone().skip(1).all(|i| winding(&mesh, &pose, through[i].as_dvec3()) < 0.5)
        })
        .inspect(|&s| assert_eq!(out[groom.strand_range(s)], through[groom.strand_range(s)], "strand {s}"))
        .count();
    assert!(untouched > 100 && report.pushed > 100, "{untouched} {report:?}");
}

/// The upper half of an egg, open below.
fn dome() -> Mesh {
    let mut mesh = egg(20, 30);
    let middle = |t: &[u32; 3]| t.iter().map(|&v| mesh.rest.positions[v as usize].y).sum::<f64>() / 3.0;
    let upper = mesh.triangles.iter().copied().filter(|t| middle(t) > 0.0).collect();
    mesh.triangles = upper;
    mesh
}

/// Hair longer than the head is high: where the mesh ends below it there is no inside to be pushed out of, though the
/// border's triangles face away.
#[test]
fn what_hangs_past_the_border_of_an_open_mesh_hangs_on() {
    let mesh = dome();
    let mut points = Vec::new();
    for strand in 0..60 {
        let turn = glam::Quat::from_rotation_y(strand as f32 * 0.1);
        points.extend([0.3_f32, 0.1, -0.1, -0.4, -1.0].map(|y| turn * Vec3::new(1.05, y, 0.0)));
        // And in the open, under the rim's middle.
        points.extend(
            [0.3_f32, 0.1, -0.1, -0.4, -1.0].map(|y| turn * Vec3::new(1.02 + 0.6 * y.min(0.0), y, 0.0)),
        );
    }
    let groom = Groom::new((0..=120).map(|s| 5 * s).collect(), points).unwrap();
    let (through, _) = carried(&groom, &mesh, None, &mesh.rest);
    let (out, report) = carried(&groom, &mesh, Some(0.001), &mesh.rest);
    assert_eq!((report.pushed, report.inside), (0, 0), "{report:?}");
    assert_eq!(out, through);
    // What is inside of the dome is pushed out all the same.
    let (_, report) = carried(&wild(400), &mesh, Some(0.001), &mesh.rest);
    assert!(report.pushed > 100, "{report:?}");
}

/// Triangles without an area lie on the edges of others and have no sides; they hide nobody's.
#[test]
fn slivers_do_not_hide_the_inside() {
    let mut mesh = egg(20, 30);
    let groom = wild(400);
    let (plain, told) = carried(&groom, &mesh, Some(0.02), &mesh.rest);
    let mut slivers = Vec::new();
    for &[a, b, c] in &mesh.triangles {
        let [from, to] = [b, c].map(|v| mesh.rest.positions[v as usize]);
        slivers.extend([[b, mesh.rest.positions.len() as u32, c], [a, b, b], [a, a, a]]);
        mesh.rest.positions.push(from.midpoint(to));
        mesh.uvs.push(mesh.uvs[a as usize]);
    }
    // First in number, so that they would be taken where they are as near as others.
    mesh.triangles.splice(0..0, slivers);
    let (out, report) = carried(&groom, &mesh, Some(0.02), &mesh.rest);
    assert!(report.inside == 0 && report.pushed.abs_diff(told.pushed) < 10, "{report:?}, {told:?}");
    let apart = out.iter().zip(&plain).filter(|(a, b)| a.distance(**b) > 1e-3).count();
    assert!(apart < 20, "{apart}");
}

/// A strand whose root is deep inside and that is shorter than the way out stays inside, and is told of.
#[test]
fn what_cannot_come_out_is_told() {
    let mesh = egg(20, 30);
    let points = vec![Vec3::new(0.3, 0.0, 0.0), Vec3::new(0.3, 0.1, 0.0), Vec3::new(0.3, 0.2, 0.0)];
    let groom = Groom::new(vec![0, 3], points).unwrap();
    let (_, report) = carried(&groom, &mesh, Some(0.01), &mesh.rest);
    assert_eq!((report.pushed, report.inside), (2, 2), "{report:?}");
    assert!(report.deepest > 0.4 && report.deepest < 0.7, "{report:?}");
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let (mesh, groom) = (egg(20, 30), wild(400));
    let pose = mesh.posed(pinched);
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| carried(&groom, &mesh, Some(0.02), &pose))
    };
    assert_eq!(on(1), on(5));
}
