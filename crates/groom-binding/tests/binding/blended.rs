//! Strands that follow the deformation of the mesh.

use glam::{DMat3, DQuat, DVec3, Vec3, dvec3};
use groom::Groom;
use groom_binding::{
    BindOptions, Binding, Blend, Carrier, CarryMode, CarryOptions, CarryReport, Moved, RootFrames, Stencil,
    blending_accuracy,
};
use moving_mesh::Pose;

use crate::shapes::{Mesh, egg};
use crate::strands;

fn blended(blend: Blend) -> CarryOptions {
    CarryOptions { mode: CarryMode::Blended(blend), ..CarryOptions::default() }
}

fn bound(groom: &Groom, mesh: &Mesh) -> Binding {
    Binding::new(groom, &mesh.surface(), &BindOptions::default()).unwrap().0
}

fn carried(groom: &Groom, mesh: &Mesh, options: CarryOptions, pose: &Pose) -> (Vec<Vec3>, CarryReport) {
    let binding = bound(groom, mesh);
    let mut out = Vec::new();
    let report =
        Carrier::new(groom, &binding, mesh.surface(), options).unwrap().positions(pose, &mut out).unwrap();
    (out, report)
}

fn worst(a: &[Vec3], b: &[Vec3]) -> f32 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

/// Where the points go on a mesh under an affine motion: the frame's motion, and what the affine differs by from
/// it as seen from the root, times how far along the strand the point is.
fn expected(groom: &Groom, frames: &RootFrames<'_>, affine: DMat3, power: f64) -> Vec<DVec3> {
    let along = groom.along_strands();
    let of = |s: usize| {
        let motion = frames.motion(s);
        let root = groom.strand(s)[0].as_dvec3();
        let place = |(p, t): (&Vec3, f32)| {
            let p = p.as_dvec3();
            motion.apply(p) + (affine - motion.turn) * (p - root) * f64::from(t).powf(power)
        };
        let along = groom.strand_range(s).map(|i| along[i]).collect::<Vec<_>>();
        groom.strand(s).iter().zip(along).map(place).collect::<Vec<_>>()
    };
    (0..groom.strand_count()).flat_map(of).collect()
}

#[test]
fn at_rest_nothing_moves() {
    let (mesh, groom) = (egg(12, 16), strands(300, 0.2, 1));
    for blend in [Blend::default(), Blend { restore_lengths: true, ..Blend::default() }] {
        let (out, report) = carried(&groom, &mesh, blended(blend), &mesh.rest);
        assert_eq!(report, CarryReport { anchors: 96, ..CarryReport::default() });
        assert!(worst(&out, groom.positions()) < 3e-7, "{}", worst(&out, groom.positions()));
    }
}

#[test]
fn a_rigid_motion_is_rigid_however_many_anchors() {
    let (mesh, groom) = (egg(12, 16), strands(300, 0.2, 2));
    let turn = DQuat::from_scaled_axis(dvec3(0.9, -1.4, 0.3));
    let pose = mesh.posed(|p| turn * p + dvec3(3.0, 1.0, -2.0));
    let (rigid, _) = carried(&groom, &mesh, CarryOptions::default(), &pose);
    for anchors in [4, 20, 200] {
        let (out, report) = carried(&groom, &mesh, blended(Blend { anchors, ..Blend::default() }), &pose);
        assert!(report.anchors <= anchors && report.anchors >= 4);
        assert!(worst(&out, &rigid) < 1e-6, "{anchors}: {}", worst(&out, &rigid));
    }
}

#[test]
fn tips_follow_an_affine_motion_and_roots_their_frames() {
    let (mesh, groom) = (egg(12, 16), strands(300, 0.2, 3));
    let affine = DMat3::from_quat(DQuat::from_rotation_x(0.7)) * DMat3::from_diagonal(dvec3(1.2, 2.0, 0.7));
    let pose = mesh.posed(|p| affine * p);
    let binding = bound(&groom, &mesh);
    let mut frames = RootFrames::new(&binding, mesh.surface()).unwrap();
    frames.follow(&pose).unwrap();
    for power in [0.5, 1.0, 2.0] {
        let blend = Blend { power, ..Blend::default() };
        let (out, _) = carried(&groom, &mesh, blended(blend), &pose);
        let expected = expected(&groom, &frames, affine, f64::from(power));
        let worst = out.iter().zip(&expected).map(|(a, b)| a.as_dvec3().distance(*b)).fold(0.0, f64::max);
        assert!(worst < 2e-6, "{power}: {worst}");
        // With the lengths restored the roots are where they were.
        let blend = Blend { restore_lengths: true, ..blend };
        let (restored, _) = carried(&groom, &mesh, blended(blend), &pose);
        for strand in 0..groom.strand_count() {
            let range = groom.strand_range(strand);
            assert!(restored[range.start].distance(out[range.start]) < 1e-6);
            let length = |p: &[Vec3]| p.windows(2).map(|p| p[0].distance(p[1])).collect::<Vec<_>>();
            for (now, then) in length(&restored[range]).into_iter().zip(length(groom.strand(strand))) {
                assert!((now - then).abs() < 1e-6, "{now} {then}");
            }
        }
    }
}

/// Under an affine motion that changes with time all rates are known.
#[test]
fn velocities_are_those_of_the_deformation() {
    let (mesh, groom) = (egg(12, 16), strands(200, 0.2, 4));
    let binding = bound(&groom, &mesh);
    let affine = |t: f64| {
        DMat3::from_quat(DQuat::from_rotation_y(2.0 * t))
            * DMat3::from_diagonal(dvec3(1.0, 1.0 + 0.5 * (3.0 * t).sin(), 1.0 - 0.2 * t))
    };
    let (time, step) = (0.4, 0.25 / 24.0);
    let places = |t: f64| {
        let mut frames = RootFrames::new(&binding, mesh.surface()).unwrap();
        frames.follow(&mesh.posed(|p| affine(t) * p)).unwrap();
        expected(&groom, &frames, affine(t), 1.0)
    };
    let (first, second) = crate::motion::rates_of(places, time);
    let stencil = Stencil::new(time, step, None).unwrap();
    let [a, b, c] = stencil.times().map(|t| mesh.posed(|p| affine(t) * p));
    let mut moved = Moved::default();
    let mut carrier = Carrier::new(&groom, &binding, mesh.surface(), blended(Blend::default())).unwrap();
    carrier.moved(&stencil, [&a, &b, &c], true, &mut moved).unwrap();
    let (v, a) = (
        crate::motion::error(&moved.velocities, &first),
        crate::motion::error(&moved.accelerations.unwrap(), &second),
    );
    assert!(v < 1e-3 && a < 2e-3, "velocities {v}, accelerations {a}");
}

/// A sheet says nothing of what is beside it but by its normals.
#[test]
fn a_flat_mesh_turns_its_strands_with_it() {
    let mut mesh = egg(10, 12);
    for p in &mut mesh.rest.positions {
        p.z = 0.0;
    }
    // One side only, or its two sides would lie on each other.
    mesh.triangles.retain(|t| {
        let [a, b, c] = t.map(|v| mesh.rest.positions[v as usize]);
        (b - a).cross(c - a).z > 1e-9
    });
    let mut groom = strands(100, 0.1, 5);
    groom.positions_mut().iter_mut().for_each(|p| p.z = p.z.abs());
    let turn = DQuat::from_scaled_axis(dvec3(1.3, 0.4, -0.2));
    let pose = mesh.posed(|p| turn * p);
    let (rigid, _) = carried(&groom, &mesh, CarryOptions::default(), &pose);
    let (out, report) = carried(&groom, &mesh, blended(Blend::default()), &pose);
    assert!(report.anchors >= 40 && worst(&out, &rigid) < 1e-6, "{report:?} {}", worst(&out, &rigid));
}

/// A mesh that is one line deforms nothing round it: its strands are carried rigidly, and the report says so.
#[test]
fn a_mesh_without_breadth_carries_rigidly() {
    let mut mesh = egg(10, 12);
    for p in &mut mesh.rest.positions {
        *p = dvec3(0.0, p.y, 0.0);
    }
    let groom = strands(50, 0.1, 6);
    let pose = mesh.posed(|p| p + DVec3::X);
    let (rigid, _) = carried(&groom, &mesh, CarryOptions::default(), &pose);
    let (out, report) = carried(&groom, &mesh, blended(Blend::default()), &pose);
    assert!(report.anchors == 0 && out == rigid);
}

#[test]
fn options_out_of_range_are_refused() {
    let (mesh, groom) = (egg(6, 8), strands(5, 0.1, 7));
    let binding = bound(&groom, &mesh);
    let good = CarryOptions::default();
    for bad in [
        blended(Blend { anchors: 3, ..Blend::default() }),
        blended(Blend { anchors: 2001, ..Blend::default() }),
        blended(Blend { power: f32::NAN, ..Blend::default() }),
        CarryOptions { keep_out: Some(-1.0), ..good },
        CarryOptions { keep_out: Some(f64::INFINITY), ..good },
        CarryOptions { teleport: Some(0.0), ..good },
        CarryOptions { teleport: Some(f64::NAN), ..good },
        CarryOptions { origin: DVec3::splat(f64::NAN), ..good },
    ] {
        assert!(Carrier::new(&groom, &binding, mesh.surface(), bad).is_err(), "{bad:?}");
    }
}

#[test]
fn more_anchors_are_nearer_to_all_vertices() {
    let (mesh, groom) = (egg(12, 16), strands(100, 0.2, 8));
    let binding = bound(&groom, &mesh);
    let bent = |p: DVec3| DQuat::from_rotation_z(0.8 * p.y) * (p * (1.0 + 0.2 * p.x));
    let rows =
        blending_accuracy(&groom, &binding, mesh.surface(), &[mesh.posed(bent)], &[4, 16, 64, 2000], 2000)
            .unwrap();
    for pair in rows.windows(2) {
        assert!(pair[1].error < 0.6 * pair[0].error && pair[1].worst < pair[0].worst, "{rows:?}");
    }
    assert!(rows[3].error == 0.0 && rows[2].error < 2e-3, "{rows:?}");
}
