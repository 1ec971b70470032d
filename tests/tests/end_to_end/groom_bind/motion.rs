//! Motion that is known: where strands must be, and how fast.

use glam::{Quat, Vec3};

use super::support::{bind, bind_json, farthest, frames, hair, head, moving_square, names_in, three_strands};

const RATE: f32 = 25.0;

#[test]
fn strands_go_where_the_square_goes_with_its_velocity() {
    let folder = tempfile::tempdir().unwrap();
    let (_, groom) = three_strands(folder.path());
    let step = Vec3::new(0.1, -0.05, 0.2);
    moving_square(folder.path(), 5, |frame, corner| corner + step * frame as f32);
    let words =
        bind(folder.path(), &["three.usda", "--mesh", "square.####.obj", "--fps", "25", "-o", "out.usdc"]);
    assert!(words.contains("5 frames") && !words.contains("warning"), "{words}");
    let (loaded, seen) = frames(&folder.path().join("out.usdc"));
    assert_eq!(loaded.frame_rate, Some(25.0));
    assert_eq!(seen.iter().map(|frame| frame.time).collect::<Vec<_>>(), [0.0, 1.0, 2.0, 3.0, 4.0]);
    for (i, frame) in seen.iter().enumerate() {
        let expected: Vec<Vec3> = groom.positions().iter().map(|&p| p + step * i as f32).collect();
        assert!(farthest(&frame.positions, &expected) < 1e-6, "frame {i}");
        let velocities = frame.velocities.as_ref().unwrap();
        assert!(velocities.iter().all(|v| v.distance(step * RATE) < 1e-3), "frame {i}: {}", velocities[0]);
    }
}

#[test]
fn a_turning_square_turns_its_strands() {
    let folder = tempfile::tempdir().unwrap();
    let (_, groom) = three_strands(folder.path());
    // Small steps: an OBJ sequence runs straight from frame to frame, a turn does not.
    let turn = |frame: u32| Quat::from_axis_angle(Vec3::new(1.0, 1.0, 0.0).normalize(), 0.01 * frame as f32);
    moving_square(folder.path(), 9, |frame, corner| turn(frame) * corner);
    bind(
        folder.path(),
        &["three.usda", "--mesh", "square.####.obj", "--fps", "25", "--accelerations", "-o", "out.usdc"],
    );
    let (_, seen) = frames(&folder.path().join("out.usdc"));
    let spin = Vec3::new(1.0, 1.0, 0.0).normalize() * 0.01 * RATE;
    for (i, frame) in seen.iter().enumerate() {
        let expected: Vec<Vec3> = groom.positions().iter().map(|&p| turn(i as u32) * p).collect();
        assert!(farthest(&frame.positions, &expected) < 2e-6, "frame {i}");
        assert_eq!(frame.accelerations.as_ref().unwrap().len(), expected.len());
        if (1..8).contains(&i) {
            let velocities = frame.velocities.as_ref().unwrap();
            let speeds: Vec<Vec3> = expected.iter().map(|&p| spin.cross(p)).collect();
            assert!(farthest(velocities, &speeds) < 2e-3, "frame {i}: {}", farthest(velocities, &speeds));
        }
    }
}

#[test]
fn a_jump_gives_no_velocity_when_it_is_told_of() {
    let folder = tempfile::tempdir().unwrap();
    three_strands(folder.path());
    // Stands, and is elsewhere from frame 2 on.
    moving_square(folder.path(), 4, |frame, corner| if frame < 2 { corner } else { corner + Vec3::X * 50.0 });
    let arguments = ["three.usda", "--mesh", "square.####.obj", "--fps", "25", "-o", "out.usdc"];
    let fastest = || {
        let (_, seen) = frames(&folder.path().join("out.usdc"));
        let all = seen.into_iter().flat_map(|frame| frame.velocities.unwrap());
        all.map(|velocity| velocity.length()).fold(0.0, f32::max)
    };
    bind(folder.path(), &arguments);
    assert!(fastest() > 100.0);
    let done = bind_json(folder.path(), &[&arguments[..], &["--teleport", "10"]].concat());
    assert!(done["teleported"].as_u64().unwrap() >= 3, "{done}");
    assert_eq!(fastest(), 0.0);
}

#[test]
fn samples_of_a_shutter_are_the_points_at_their_times() {
    let folder = tempfile::tempdir().unwrap();
    let (mesh, hair) = (head(), hair("straight.hair"));
    let common = [&hair, "--mesh", &mesh, "--up", "y", "--no-velocity"];
    bind(
        folder.path(),
        &[&common[..], &["--frames", "4-6", "--shutter-samples", "3", "-o", "a.usdc"]].concat(),
    );
    bind(folder.path(), &[&common[..], &["--frames", "3-7:0.25", "-o", "b.usdc"]].concat());
    let (_, samples) = frames(&folder.path().join("a.usdc"));
    let (_, fine) = frames(&folder.path().join("b.usdc"));
    let times: Vec<f64> = samples.iter().map(|frame| frame.time).collect();
    assert_eq!(times, [3.75, 4.0, 4.25, 4.75, 5.0, 5.25, 5.75, 6.0, 6.25]);
    for sample in &samples {
        let same = fine.iter().find(|frame| frame.time == sample.time).unwrap();
        assert!(sample.velocities.is_none() && sample.positions == same.positions, "{}", sample.time);
    }
}

#[test]
fn roots_stay_where_they_were_bound_and_segments_keep_their_length() {
    let folder = tempfile::tempdir().unwrap();
    let (mesh, hair) = (head(), hair("wavy.hair"));
    for animation in ["Nod", "1"] {
        let done = bind_json(
            folder.path(),
            &[&hair, "--mesh", &mesh, "--up", "y", "--animation", animation, "-o", "out.usdc"],
        );
        let size = done["mesh_size"].as_f64().unwrap();
        assert_eq!((done["frames"].as_u64(), done["frame_rate"].as_f64()), (Some(25), Some(24.0)));
        assert!(done["root_error"].as_f64().unwrap() <= 1e-5 * size, "{done}");
        let (loaded, seen) = frames(&folder.path().join("out.usdc"));
        let rest = groom_formats::read(hair.as_ref(), &Default::default()).unwrap().groom;
        assert_eq!(loaded.groom.offsets(), rest.offsets());
        // The animation is of one second, and ends where it began: at rest.
        assert!(farthest(&seen[0].positions, rest.positions()) < 1e-6);
        assert!(farthest(&seen[24].positions, rest.positions()) < 1e-6);
        assert!(farthest(&seen[6].positions, rest.positions()) > 0.01);
        for frame in &seen {
            for strand in 0..rest.strand_count() {
                let range = rest.strand_range(strand);
                let pairs = rest.positions()[range.clone()].windows(2).zip(frame.positions[range].windows(2));
                for (before, after) in pairs {
                    let change = before[0].distance(before[1]) - after[0].distance(after[1]);
                    assert!(change.abs() < 1e-6, "frame {}, strand {strand}: {change}", frame.time);
                }
            }
        }
    }
    assert_eq!(names_in(folder.path()), ["out.usdc"]);
}
