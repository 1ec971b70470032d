//! Motions that no character should make: whatever comes, every number is one.

use glam::{DVec3, Vec3, dvec3};
use groom::Groom;
use groom_binding::{BindOptions, Binding, Blend, Carrier, CarryMode, CarryOptions, Moved, Stencil};

use crate::motion::{Motion, morphing};
use crate::shapes::{Mesh, egg};
use crate::strands;

fn collapsing(p: DVec3, t: f64) -> DVec3 {
    p * (1.0 - t).max(0.0)
}

fn flattened(p: DVec3, t: f64) -> DVec3 {
    p * dvec3(1.0, (1.0 - t).max(0.0), 1.0)
}

fn mirroring(p: DVec3, t: f64) -> DVec3 {
    p * dvec3(1.0 - 2.0 * t, 1.0, 1.0)
}

fn teleporting(p: DVec3, t: f64) -> DVec3 {
    p + if t < 0.99 { DVec3::ZERO } else { DVec3::splat(1e6) }
}

fn needles(p: DVec3, t: f64) -> DVec3 {
    // Every other ring runs into its neighbour.
    if (p.y * 7.0).floor() % 2.0 == 0.0 { p } else { dvec3(p.x, p.y * (1.0 - t), 0.0) }
}

const MOTIONS: [Motion; 6] = [collapsing, flattened, mirroring, teleporting, needles, morphing];

fn ways() -> Vec<CarryOptions> {
    let modes = [
        CarryMode::Rigid,
        CarryMode::Blended(Blend::default()),
        CarryMode::Blended(Blend { restore_lengths: true, anchors: 8, power: 2.0 }),
    ];
    let keeps = [None, Some(0.01)];
    let both = modes.into_iter().flat_map(|mode| keeps.map(|keep_out| (mode, keep_out)));
    both.map(|(mode, keep_out)| CarryOptions {
        mode,
        keep_out,
        teleport: Some(100.0),
        ..CarryOptions::default()
    })
    .collect()
}

/// Strands of one point, of points that are all the same, with their roots on vertices and edges, and others.
fn odd_strands(mesh: &Mesh) -> Groom {
    let some = strands(60, 0.2, 12);
    let (mut offsets, mut points) = (some.offsets().to_vec(), some.positions().to_vec());
    let place = |v: u32| mesh.rest.positions[v as usize].as_vec3();
    for triangle in mesh.triangles.iter().step_by(11) {
        let [a, b, _] = triangle.map(place);
        for strand in [vec![a, a * 1.2], vec![(a + b) / 2.0, a * 1.1, a * 1.3], vec![a], vec![b, b, b]] {
            points.extend(strand);
            offsets.push(points.len() as u32);
        }
    }
    Groom::new(offsets, points).unwrap()
}

#[test]
fn every_number_is_one() {
    // With triangles of no area, and vertices twice.
    let mut mesh = egg(8, 10);
    mesh.triangles.extend([[0, 0, 0], [5, 5, 9], [20, 31, 20]]);
    let groom = odd_strands(&mesh);
    let binding = Binding::new(&groom, &mesh.surface(), &BindOptions::default()).unwrap().0;
    let mut moved = Moved::default();
    for options in ways() {
        for (i, motion) in MOTIONS.into_iter().enumerate() {
            let mut carrier = Carrier::new(&groom, &binding, mesh.surface(), options).unwrap();
            for frame in 0..5 {
                let stencil = Stencil::new(f64::from(frame) * 0.25, 0.25 / 24.0, Some((0.0, 1.0))).unwrap();
                let [a, b, c] = stencil.times().map(|t| mesh.posed(|p| motion(p, t)));
                let report = carrier.moved(&stencil, [&a, &b, &c], true, &mut moved).unwrap();
                let all = moved
                    .positions
                    .iter()
                    .chain(&moved.velocities)
                    .chain(moved.accelerations.iter().flatten());
                assert!(all.into_iter().all(|v| v.is_finite()), "{options:?} motion {i} frame {frame}");
                assert!(report.deepest.is_finite());
                // No strand is torn out, whatever happens to its triangle.
                let far = |p: &Vec3| p.length() > 100.0;
                assert!(
                    i == 3 || i == 5 || !moved.positions.iter().any(far),
                    "{options:?} motion {i} frame {frame}"
                );
                // Nor is anything thrown away: at most a strand turns round from one pose to the next.
                let wild = |v: &Vec3| v.length() > 1000.0;
                assert!(!moved.velocities.iter().any(wild), "{options:?} motion {i} frame {frame}");
            }
        }
    }
}

/// Meshes of any size that f64 holds: nothing panics, and where single precision holds their strands all are numbers.
#[test]
fn meshes_of_absurd_size() {
    for size in [1e-300, 1e-160, 1e-30, 1e30, 1e160, 1e300] {
        let mut mesh = egg(6, 8);
        mesh.rest.positions.iter_mut().for_each(|p| *p *= size);
        let mut groom = strands(40, 0.2, 13);
        let fits = (1e-30..=1e30).contains(&size);
        if fits {
            groom.positions_mut().iter_mut().for_each(|p| *p *= size as f32);
        }
        let binding = Binding::new(&groom, &mesh.surface(), &BindOptions::default()).unwrap().0;
        for options in ways() {
            let mut carrier = Carrier::new(&groom, &binding, mesh.surface(), options).unwrap();
            let mut out = Vec::new();
            carrier.positions(&mesh.posed(|p| p * 0.5), &mut out).unwrap();
            assert!(!fits || out.iter().all(|p| p.is_finite()), "{size} {options:?}");
        }
    }
}
