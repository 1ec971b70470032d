//! Triangles that tell no frame.

use glam::{DQuat, DVec3, Vec3};
use groom::Groom;
use groom_binding::{BindOptions, Binding, RootFrames};

use crate::shapes::{Mesh, egg, sheet};

/// One strand at the middle of each triangle.
fn one_a_triangle(mesh: &Mesh) -> Groom {
    let mut points = Vec::new();
    for t in &mesh.triangles {
        let middle = t.iter().map(|&v| mesh.rest.positions[v as usize]).sum::<DVec3>() / 3.0;
        points.extend([middle.as_vec3(), 1.2 * middle.as_vec3()]);
    }
    Groom::new((0..=mesh.triangles.len() as u32).map(|s| 2 * s).collect(), points).unwrap()
}

struct Bound {
    mesh: Mesh,
    binding: Binding,
}

impl Bound {
    fn new(mesh: Mesh) -> Self {
        let (binding, _) =
            Binding::new(&one_a_triangle(&mesh), &mesh.surface(), &BindOptions::default()).unwrap();
        Bound { mesh, binding }
    }

    fn frames(&self) -> RootFrames<'_> {
        RootFrames::new(&self.binding, self.mesh.surface()).unwrap()
    }

    /// The strand on a triangle.
    fn strand_on(&self, triangle: u32) -> usize {
        self.binding.roots().iter().position(|root| root.triangle == triangle).unwrap()
    }
}

#[test]
fn a_collapsed_triangle_keeps_the_last_frame_and_moves() {
    let bound = Bound::new(egg(10, 14));
    let mut frames = bound.frames();
    let turn = DQuat::from_rotation_x(0.4);
    frames.follow(&bound.mesh.posed(|p| turn * p)).unwrap();
    let triangle = 101;
    let strand = bound.strand_on(triangle);
    let last = frames.frames()[strand];
    // Its three vertices meet in one point, and all moves on.
    let shift = DVec3::new(3.0, 0.0, 0.0);
    let mut pose = bound.mesh.posed(|p| turn * turn * p + shift);
    let [a, b, c] = bound.mesh.triangles[triangle as usize].map(|v| v as usize);
    let met = (pose.positions[a] + pose.positions[b] + pose.positions[c]) / 3.0;
    for v in [a, b, c] {
        pose.positions[v] = met;
    }
    frames.follow(&pose).unwrap();
    let now = frames.frames()[strand];
    assert_eq!(now.rotation, last.rotation);
    assert!(now.origin.distance(met) < 1e-12);
    assert!(frames.held() >= 1);
    // It opens again, and has a frame of its own again.
    frames.follow(&bound.mesh.posed(|p| turn * turn * p + shift)).unwrap();
    assert_eq!(frames.held(), 0);
    let motion = frames.motion(strand);
    let expected = glam::DMat3::from_quat(turn * turn);
    assert!(motion.turn.abs_diff_eq(expected, 1e-12));
}

#[test]
fn a_triangle_turned_over_keeps_the_last_frame() {
    let bound = Bound::new(sheet(8));
    let mut frames = bound.frames();
    frames.follow(&bound.mesh.rest).unwrap();
    let before: Vec<DQuat> = frames.frames().iter().map(|f| f.rotation).collect();
    // The inner vertex (4, 4) is pulled over its neighbours' far edges.
    let mut pose = bound.mesh.rest.clone();
    pose.positions[4 * 9 + 4] = DVec3::new(5.6, 0.0, 5.7);
    frames.follow(&pose).unwrap();
    assert!(frames.held() > 0);
    for (strand, frame) in frames.frames().iter().enumerate() {
        let [a, b, c] = bound.mesh.triangles[bound.binding.roots()[strand].triangle as usize]
            .map(|v| pose.positions[v as usize]);
        if (b - a).cross(c - a).y < 0.0 {
            assert_eq!(frame.rotation, before[strand], "strand {strand}");
        }
        assert!((frame.rotation * DVec3::Y).y > 0.99, "no strand looks down: {strand}");
    }
}

/// A whole sheet that is turned over is turned, however it is done; no triangle holds still.
#[test]
fn a_neighbourhood_that_turns_is_no_flip() {
    let bound = Bound::new(sheet(4));
    let mut frames = bound.frames();
    for pose in [bound.mesh.posed(|p| -p.with_z(-p.z)), bound.mesh.posed(|p| p.with_x(-p.x))] {
        frames.follow(&pose).unwrap();
        assert_eq!((frames.held(), frames.mirrored()), (0, false));
        assert!(frames.motions().all(|m| (m.turn * DVec3::Y).y < -0.99));
    }
}

#[test]
fn a_mesh_that_collapses_to_a_point_and_comes_back() {
    let bound = Bound::new(egg(6, 9));
    let mut frames = bound.frames();
    let turn = |angle| DQuat::from_rotation_z(angle);
    frames.follow(&bound.mesh.posed(|p| turn(0.3) * p)).unwrap();
    let last: Vec<DQuat> = frames.frames().iter().map(|f| f.rotation).collect();
    for size in [1e-3, 0.0, 0.0] {
        frames.follow(&bound.mesh.posed(|p| turn(0.3) * p * size)).unwrap();
        for (frame, last) in frames.frames().iter().zip(&last) {
            assert!(frame.origin.length() <= 1.4 * size && frame.rotation.angle_between(*last) < 1e-6);
        }
    }
    assert_eq!(frames.held(), bound.binding.strand_count());
    frames.follow(&bound.mesh.rest).unwrap();
    assert_eq!(frames.held(), 0);
    assert!(frames.motions().all(|m| m.turn.abs_diff_eq(glam::DMat3::IDENTITY, 1e-12)));
}

/// A mesh that is a point at rest: there is no frame to be had, and nothing is not a number.
#[test]
fn a_mesh_without_any_area() {
    let mut mesh = egg(4, 5);
    mesh.rest.positions.iter_mut().for_each(|p| *p = DVec3::ONE);
    let groom = Groom::new(vec![0, 1, 3], vec![Vec3::ZERO, Vec3::X, Vec3::Y]).unwrap();
    let (binding, report) = Binding::new(&groom, &mesh.surface(), &BindOptions::default()).unwrap();
    assert_eq!(report.without_frame, 2);
    let mut frames = RootFrames::new(&binding, mesh.surface()).unwrap();
    frames.follow(&egg(4, 5).rest).unwrap();
    let place = frames.frames()[0].origin;
    assert!(place.is_finite());
    for motion in frames.motions() {
        assert_eq!(motion.apply(DVec3::ONE), place);
        assert_eq!(motion.turn, glam::DMat3::IDENTITY, "moved, not turned");
    }
}

#[test]
fn triangles_without_an_area_are_not_bound_to_while_there_are_others() {
    let mut mesh = egg(6, 9);
    // First in the list, so that by number alone they would win on their edges.
    let slivers: Vec<[u32; 3]> = mesh.triangles.iter().map(|t| [t[0], t[1], t[1]]).collect();
    let count = slivers.len();
    mesh.triangles = [slivers, mesh.triangles].concat();
    let points: Vec<Vec3> = mesh.rest.positions.iter().map(|p| p.as_vec3()).collect();
    let groom = Groom::new((0..=points.len() as u32).collect(), points).unwrap();
    let (binding, report) = Binding::new(&groom, &mesh.surface(), &BindOptions::default()).unwrap();
    assert!(binding.roots().iter().all(|root| root.triangle as usize >= count));
    assert_eq!(report.without_frame, 0);
}
