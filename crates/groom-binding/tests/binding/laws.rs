//! What rigid carrying keeps, over random poses.

use glam::{DMat3, DQuat, DVec3, Vec3};
use groom::Groom;
use groom_binding::{BindOptions, Binding, RootFrames, carry_rigid};
use moving_mesh::Pose;
use proptest::prelude::*;

use crate::shapes::egg;
use crate::strands;

fn vector(most: f64) -> impl Strategy<Value = DVec3> {
    [-most..most, -most..most, -most..most].prop_map(DVec3::from)
}

fn turn() -> impl Strategy<Value = DQuat> {
    vector(3.0).prop_map(DQuat::from_scaled_axis)
}

/// A bend that is no affine motion.
fn bent(p: DVec3, by: DVec3) -> DVec3 {
    DQuat::from_scaled_axis(by * p.y) * p + 0.2 * by * (3.0 * p.x).sin()
}

/// Lengths of all segments in f64.
fn lengths(groom: &Groom, points: &[DVec3]) -> Vec<f64> {
    let of =
        |s: usize| points[groom.strand_range(s)].windows(2).map(|p| p[0].distance(p[1])).collect::<Vec<_>>();
    (0..groom.strand_count()).flat_map(of).collect()
}

/// The points where the frames' motions take them, not rounded.
fn carried(groom: &Groom, frames: &RootFrames<'_>) -> Vec<DVec3> {
    let motions: Vec<_> = frames.motions().collect();
    let strand =
        |s: usize| groom.strand(s).iter().map(|p| motions[s].apply(p.as_dvec3())).collect::<Vec<_>>();
    (0..groom.strand_count()).flat_map(strand).collect()
}

/// What holds at any pose, whatever the mesh does: see `carry_rigid`.
fn check_laws(
    groom: &Groom,
    binding: &Binding,
    frames: &RootFrames<'_>,
    pose: &Pose,
    triangles: &[[u32; 3]],
) {
    let points = carried(groom, frames);
    let extent = pose.positions.iter().fold(1.0f64, |most, p| most.max(p.length()));
    for (strand, root) in binding.roots().iter().enumerate() {
        let [a, b, c] = triangles[root.triangle as usize].map(|v| pose.positions[v as usize]);
        let place = root.barycentrics.x * a + root.barycentrics.y * b + root.barycentrics.z * c;
        let at = points[groom.offsets()[strand] as usize];
        assert!((at.distance(place) - root.height.abs()).abs() < 1e-14 * extent, "strand {strand}: {root:?}");
        // The whole offset is kept in the frame.
        let rest_root = groom.strand(strand)[0].as_dvec3();
        let before = root.rest.rotation.conjugate() * (rest_root - root.rest.origin);
        let frame = frames.frames()[strand];
        let mut after = frame.rotation.conjugate() * (at - frame.origin);
        after.z *= if frames.mirrored() { -1.0 } else { 1.0 };
        assert!(before.distance(after) < 1e-13 * extent, "strand {strand}: {before} {after}");
    }
    let rest: Vec<DVec3> = groom.positions().iter().map(|p| p.as_dvec3()).collect();
    for (before, after) in lengths(groom, &rest).into_iter().zip(lengths(groom, &points)) {
        assert!((after / before - 1.0).abs() < 1e-12 * extent, "{before} {after}");
    }
    let mut out = vec![Vec3::NAN; 1];
    carry_rigid(groom, frames, DVec3::ZERO, &mut out).unwrap();
    let rounded: Vec<Vec3> = points.iter().map(|p| p.as_vec3()).collect();
    assert_eq!(out, rounded);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    #[test]
    fn heights_offsets_and_lengths_are_kept(
        bend in vector(1.5),
        columns in [vector(2.0), vector(2.0), vector(2.0)],
        shift in vector(5.0),
        off in 0.0..0.5f32,
    ) {
        let mesh = egg(9, 13);
        let groom = strands(150, off, 7);
        let (binding, _) = Binding::new(&groom, &mesh.surface(), &BindOptions::default()).unwrap();
        let mut frames = RootFrames::new(&binding, mesh.surface()).unwrap();
        let shear = DMat3::from_cols_array_2d(&columns.map(|c| c.to_array()));
        for pose in [mesh.posed(|p| bent(p, bend) + shift), mesh.posed(|p| shear * p), mesh.rest.clone()] {
            frames.follow(&pose).unwrap();
            check_laws(&groom, &binding, &frames, &pose, &mesh.triangles);
        }
    }

    /// A mesh that moves as a rigid body takes its hair with it as one, wherever it goes and however large it is.
    #[test]
    fn a_rigid_motion_is_made_exactly(turn in turn(), shift in vector(1e6), scale in -6..=6i32, mirror in any::<bool>()) {
        let size = 10f64.powi(scale);
        let mut mesh = egg(9, 13);
        for p in &mut mesh.rest.positions {
            *p *= size;
        }
        let mut groom = strands(150, 0.3, 11);
        for p in groom.positions_mut() {
            *p *= size as f32;
        }
        let sense = if mirror { DVec3::new(-1.0, 1.0, 1.0) } else { DVec3::ONE };
        let shift = shift * size;
        let moved = |p: DVec3| turn * (sense * p) + shift;
        let (binding, _) = Binding::new(&groom, &mesh.surface(), &BindOptions::default()).unwrap();
        let mut frames = RootFrames::new(&binding, mesh.surface()).unwrap();
        frames.follow(&mesh.posed(moved)).unwrap();
        prop_assert_eq!(frames.mirrored(), mirror);
        prop_assert_eq!(frames.held(), 0);
        for (point, at) in groom.positions().iter().zip(carried(&groom, &frames)) {
            // 1e6 sizes away a vertex is known to 1e-10 sizes, and a triangle of a tenth shows it.
            let error = at.distance(moved(point.as_dvec3()));
            prop_assert!(error < 1e-8 * size, "{} of {}", error, size);
        }
    }
}

/// The same nod here and 1e6 away, told from where the character is: the shape differs by what f64 loses there.
#[test]
fn far_from_the_origin_strands_keep_their_shape() {
    let mesh = egg(40, 60);
    let groom = strands(2000, 0.1, 3);
    let (binding, _) = Binding::new(&groom, &mesh.surface(), &BindOptions::default()).unwrap();
    let far = DVec3::new(1e6, -1e6, 1e6);
    let (mut near_frames, mut far_frames) = (
        RootFrames::new(&binding, mesh.surface()).unwrap(),
        RootFrames::new(&binding, mesh.surface()).unwrap(),
    );
    let (mut near, mut away) = (Vec::new(), Vec::new());
    let (mut worst, mut plain) = (0f32, 0f32);
    for step in 0..12 {
        let bend = DVec3::new(0.1, 0.05, -0.07) * f64::from(step);
        near_frames.follow(&mesh.posed(|p| bent(p, bend))).unwrap();
        far_frames.follow(&mesh.posed(|p| bent(p, bend) + far)).unwrap();
        carry_rigid(&groom, &near_frames, DVec3::ZERO, &mut near).unwrap();
        carry_rigid(&groom, &far_frames, far, &mut away).unwrap();
        let difference =
            |a: &[Vec3], b: &[Vec3]| a.iter().zip(b).fold(0f32, |most, (a, b)| most.max(a.distance(*b)));
        worst = worst.max(difference(&near, &away));
        // What becomes of them in f32 without a place of their own.
        carry_rigid(&groom, &far_frames, DVec3::ZERO, &mut away).unwrap();
        let back: Vec<Vec3> = away.iter().map(|p| *p - far.as_vec3()).collect();
        plain = plain.max(difference(&near, &back));
    }
    assert!(worst < 1e-6, "{worst}");
    assert!(plain > 1e-2, "f32 at 1e6 has steps of 1/16: {plain}");
}
