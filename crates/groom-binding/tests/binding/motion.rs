//! Velocities and accelerations against the motion they are of.

use glam::{DQuat, DVec3, Vec3};
use groom::Groom;
use groom_binding::{
    BindOptions, Binding, BindingError, Blend, Carrier, CarryMode, CarryOptions, CarryReport, Moved,
    RootFrames, Stencil, velocity_accuracy,
};
use moving_mesh::Pose;

use crate::shapes::{Mesh, egg};
use crate::strands;

/// A mesh in motion: where a vertex is at a time.
pub type Motion = fn(DVec3, f64) -> DVec3;

/// Spins about an axis through its middle and another, while it goes its way.
pub fn spinning(p: DVec3, t: f64) -> DVec3 {
    let turn = DQuat::from_rotation_y(2.5 * t) * DQuat::from_rotation_x(0.8 * (3.0 * t).sin());
    turn * p + DVec3::new(1.5 * t, 0.4 * (2.0 * t).sin(), -0.7 * t * t)
}

/// The same with a body that breathes and bends.
pub fn morphing(p: DVec3, t: f64) -> DVec3 {
    let bent = DQuat::from_rotation_z(0.5 * (1.7 * t).sin() * p.y) * p;
    spinning(bent * DVec3::new(1.0 + 0.2 * (2.2 * t).sin(), 1.0, 1.0), t)
}

/// The groom at `time`, how it moves, and what is told of it: frames of `rate` a second.
fn at(
    carrier: &mut Carrier<'_>,
    mesh: &Mesh,
    motion: Motion,
    time: f64,
    rate: f64,
    range: Option<(f64, f64)>,
) -> Result<(Moved, CarryReport), BindingError> {
    let stencil = Stencil::new(time, 0.25 / rate, range)?;
    let [a, b, c] = stencil.times().map(|t| mesh.posed(|p| motion(p, t)));
    let mut moved = Moved::default();
    let report = carrier.moved(&stencil, [&a, &b, &c], true, &mut moved)?;
    Ok((moved, report))
}

/// Rates of change of `place`, by differences of the eighth order over f64: exact to 1e-9 here.
pub fn rates_of(place: impl Fn(f64) -> Vec<DVec3>, time: f64) -> (Vec<DVec3>, Vec<DVec3>) {
    const FIRST: [f64; 4] = [4.0 / 5.0, -1.0 / 5.0, 4.0 / 105.0, -1.0 / 280.0];
    const SECOND: [f64; 5] = [-205.0 / 72.0, 8.0 / 5.0, -1.0 / 5.0, 8.0 / 315.0, -1.0 / 560.0];
    let step = 0.01;
    let mut second: Vec<DVec3> = place(time).iter().map(|p| *p * SECOND[0]).collect();
    let mut first = vec![DVec3::ZERO; second.len()];
    for k in 1..=4 {
        let (ahead, behind) = (place(time + step * k as f64), place(time - step * k as f64));
        for i in 0..first.len() {
            first[i] += (ahead[i] - behind[i]) * FIRST[k - 1];
            second[i] += (ahead[i] + behind[i]) * SECOND[k];
        }
    }
    (first.iter().map(|v| *v / step).collect(), second.iter().map(|a| *a / (step * step)).collect())
}

/// Where the points of a groom are on a mesh that moves as a rigid body: they move with it.
fn spun(groom: &Groom) -> impl Fn(f64) -> Vec<DVec3> {
    |t| groom.positions().iter().map(|p| spinning(p.as_dvec3(), t)).collect()
}

/// Where frames that were found once for every time put the points.
fn framed(groom: &Groom, binding: &Binding, mesh: &Mesh, motion: Motion) -> impl Fn(f64) -> Vec<DVec3> {
    move |t| {
        let mut frames = RootFrames::new(binding, mesh.surface()).unwrap();
        frames.follow(&mesh.posed(|p| motion(p, t))).unwrap();
        let of = |s: usize| {
            let motion = frames.motion(s);
            groom.strand(s).iter().map(|p| motion.apply(p.as_dvec3())).collect::<Vec<_>>()
        };
        (0..groom.strand_count()).flat_map(of).collect()
    }
}

/// The greatest difference, as a part of the greatest value.
pub fn error(found: &[Vec3], expected: &[DVec3]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let most = expected.iter().map(|v| v.length()).fold(0.0, f64::max);
    let worst = found.iter().zip(expected).map(|(a, b)| a.as_dvec3().distance(*b)).fold(0.0, f64::max);
    worst / most
}

fn bound(groom: &Groom, mesh: &Mesh) -> Binding {
    Binding::new(groom, &mesh.surface(), &BindOptions::default()).unwrap().0
}

#[test]
fn velocities_and_accelerations_are_those_of_the_motion() {
    let mesh = egg(12, 16);
    let groom = strands(200, 0.1, 5);
    let binding = bound(&groom, &mesh);
    let mut carrier = Carrier::new(&groom, &binding, mesh.surface(), CarryOptions::default()).unwrap();
    for (motion, rigid) in [(spinning as Motion, true), (morphing, false)] {
        for time in [0.3, 1.1, 2.45] {
            let (first, second) = if rigid {
                rates_of(spun(&groom), time)
            } else {
                rates_of(framed(&groom, &binding, &mesh, motion), time)
            };
            let (moved, report) = at(&mut carrier, &mesh, motion, time, 24.0, None).unwrap();
            assert_eq!(report, CarryReport::default());
            let (v, a) = (error(&moved.velocities, &first), error(&moved.accelerations.unwrap(), &second));
            assert!(v < 1e-3 && a < 2e-3, "at {time}: velocities {v}, accelerations {a}");
            // The error falls with the square of the step: a tenth of it shows a hundredth.
            let (moved, _) = at(&mut carrier, &mesh, motion, time, 240.0, None).unwrap();
            assert!(error(&moved.velocities, &first) < 0.03 * v, "{v}");
        }
    }
}

/// The first and the last key of an animation, whose mesh holds still outside: the whole velocity, not half.
#[test]
fn velocities_are_whole_at_the_ends_of_an_animation() {
    fn held(p: DVec3, t: f64) -> DVec3 {
        spinning(p, t.clamp(0.5, 1.5))
    }
    let mesh = egg(12, 16);
    let groom = strands(100, 0.1, 6);
    let binding = bound(&groom, &mesh);
    let mut carrier = Carrier::new(&groom, &binding, mesh.surface(), CarryOptions::default()).unwrap();
    for time in [0.5, 1.5] {
        let (first, second) = rates_of(spun(&groom), time);
        let (moved, _) = at(&mut carrier, &mesh, held, time, 24.0, Some((0.5, 1.5))).unwrap();
        assert!(error(&moved.velocities, &first) < 1e-3, "{}", error(&moved.velocities, &first));
        assert!(error(&moved.accelerations.unwrap(), &second) < 0.1);
        let (half, _) = at(&mut carrier, &mesh, held, time, 24.0, None).unwrap();
        assert!(error(&half.velocities, &first) > 0.4);
    }
    for time in [0.2, 1.9] {
        let (still, _) = at(&mut carrier, &mesh, held, time, 24.0, Some((0.5, 1.5))).unwrap();
        assert!(
            still.velocities.iter().chain(still.accelerations.iter().flatten()).all(|v| *v == Vec3::ZERO)
        );
    }
}

#[test]
fn three_units_a_second_are_three_at_any_frame_rate() {
    fn along(p: DVec3, t: f64) -> DVec3 {
        p + DVec3::new(3.0 * t, 0.0, 0.0)
    }
    let mesh = egg(8, 10);
    let groom = strands(60, 0.1, 7);
    let binding = bound(&groom, &mesh);
    for mode in [
        CarryMode::Rigid,
        CarryMode::Blended(Blend::default()),
        CarryMode::Blended(Blend { restore_lengths: true, ..Blend::default() }),
    ] {
        let options = CarryOptions { mode, ..CarryOptions::default() };
        let mut carrier = Carrier::new(&groom, &binding, mesh.surface(), options).unwrap();
        for (rate, far) in [(24.0, 0.0), (30.0, 2.0), (120.0, 1000.0)] {
            let (moved, _) = at(&mut carrier, &mesh, along, far, rate, None).unwrap();
            assert!(moved.velocities.iter().all(|v| v.distance(Vec3::new(3.0, 0.0, 0.0)) < 1e-5));
            assert!(moved.accelerations.unwrap().iter().all(|a| a.length() < 1e-2));
        }
    }
}

#[test]
fn a_teleport_leaves_no_streak() {
    // Steady, but for a jump of 50 in the frame from 1.0 to 1.0 + 1 / 24.
    fn jumping(p: DVec3, t: f64) -> DVec3 {
        p + DVec3::new(0.0, 2.0 * t, 50.0 * ((t - 1.0) * 24.0).clamp(0.0, 1.0))
    }
    let mesh = egg(8, 10);
    let groom = strands(60, 0.1, 8);
    let binding = bound(&groom, &mesh);
    let options = CarryOptions { teleport: Some(10.0 * 24.0), ..CarryOptions::default() };
    let mut carrier = Carrier::new(&groom, &binding, mesh.surface(), options).unwrap();
    for (frame, velocity, jumped) in
        [(23.0, 2.0, 0), (24.0, 2.0, 60), (24.5, 0.0, 60), (25.0, 2.0, 60), (26.0, 2.0, 0)]
    {
        let (moved, report) = at(&mut carrier, &mesh, jumping, frame / 24.0, 24.0, None).unwrap();
        assert_eq!(report.teleported, jumped, "frame {frame}");
        let expected = Vec3::new(0.0, velocity, 0.0);
        assert!(moved.velocities.iter().all(|v| v.distance(expected) < 1e-4), "frame {frame}");
        assert!(moved.accelerations.unwrap().iter().all(|a| a.length() < 1e-2));
    }
    // Nobody said what a jump is: it is a motion.
    let mut carrier = Carrier::new(&groom, &binding, mesh.surface(), CarryOptions::default()).unwrap();
    let (moved, report) = at(&mut carrier, &mesh, jumping, 24.5 / 24.0, 24.0, None).unwrap();
    assert!(report.teleported == 0 && moved.velocities.iter().all(|v| v.z > 1000.0));
}

/// Sub-frames overlap: the stencil of one begins before that of the last one ends. A triangle that has collapsed keeps the
/// frame from before it did, not one that was seen after.
#[test]
fn no_frame_is_taken_from_a_time_after() {
    fn collapsing(p: DVec3, t: f64) -> DVec3 {
        // A point from 0.4 to 0.6; it goes on turning.
        let size = if (0.4..0.6).contains(&t) { 0.0 } else { 1.0 };
        DQuat::from_rotation_y(5.0 * t) * p * size
    }
    let mesh = egg(8, 10);
    let groom = strands(60, 0.1, 8);
    let binding = bound(&groom, &mesh);
    let mut carrier = Carrier::new(&groom, &binding, mesh.surface(), CarryOptions::default()).unwrap();
    let mut placed = |time: f64| {
        let stencil = Stencil::new(time, 0.02, None).unwrap();
        let [a, b, c] = stencil.times().map(|t| mesh.posed(|p| collapsing(p, t)));
        let mut moved = Moved::default();
        let report = carrier.moved(&stencil, [&a, &b, &c], false, &mut moved).unwrap();
        (report.held, moved.positions)
    };
    assert_eq!(placed(0.37).0, 0);
    let (held, before) = placed(0.5);
    assert_eq!(held, groom.strand_count());
    // This one ends where the mesh is back, and the next begins where it is not.
    assert_eq!(placed(0.59), (held, before.clone()));
    assert_eq!(placed(0.595), (held, before));
    assert_eq!(placed(0.63).0, 0);
}

/// What was in the buffers does not matter, nor how many were asked for before.
#[test]
fn buffers_may_hold_anything() {
    let mesh = egg(8, 10);
    let groom = strands(60, 0.1, 8);
    let binding = bound(&groom, &mesh);
    let mut carrier = Carrier::new(&groom, &binding, mesh.surface(), CarryOptions::default()).unwrap();
    let (clean, _) = at(&mut carrier, &mesh, spinning, 1.0, 24.0, None).unwrap();
    let stencil = Stencil::new(1.0, 0.25 / 24.0, None).unwrap();
    let [a, b, c] = stencil.times().map(|t| mesh.posed(|p| spinning(p, t)));
    let mut moved = Moved {
        positions: vec![Vec3::NAN; 7],
        velocities: vec![Vec3::ONE; 9000],
        accelerations: Some(Vec::new()),
    };
    carrier.moved(&stencil, [&a, &b, &c], false, &mut moved).unwrap();
    assert_eq!((&moved.positions, &moved.velocities), (&clean.positions, &clean.velocities));
    assert!(moved.accelerations.is_none());
    carrier.moved(&stencil, [&a, &b, &c], true, &mut moved).unwrap();
    assert_eq!(moved, clean);
    let mut positions = vec![Vec3::NAN; 3];
    carrier.positions(&b, &mut positions).unwrap();
    assert_eq!(positions, clean.positions);
    let short = Pose { positions: vec![DVec3::ZERO; 3], normals: None };
    assert!(carrier.moved(&stencil, [&a, &short, &c], true, &mut moved).is_err());
    assert_eq!(moved, clean);
}

#[test]
fn half_the_step_is_a_quarter_of_the_error() {
    let mesh = egg(12, 16);
    let groom = strands(60, 0.1, 9);
    let binding = bound(&groom, &mesh);
    let steps = [0.04, 0.02, 0.01];
    let pose = |t: f64| Ok::<_, BindingError>(mesh.posed(|p| morphing(p, t)));
    let rows = velocity_accuracy(&groom, &binding, mesh.surface(), 1.3, None, &steps, pose).unwrap();
    for (pair, step) in rows.windows(2).zip(steps) {
        assert_eq!(pair[0].value, step);
        let ratio = pair[0].error / pair[1].error;
        assert!((3.6..4.4).contains(&ratio), "{rows:?}");
    }
}
