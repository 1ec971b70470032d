//! Other people's hair on other people's characters, over every frame.

use std::io::Write;
use std::path::{Path, PathBuf};

use glam::{DVec3, Vec3};
use groom::Groom;
use groom_binding::{BindOptions, Binding, RootFrames, Surface, carry_rigid};
use moving_mesh::{MeshOptions, MovingMesh};

/// A file of other people's, when it is there.
fn data(below: &str) -> Option<PathBuf> {
    let root = std::env::var_os("GROOMKIT_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from);
    let path = root.join(below);
    if !path.exists() {
        // Not `eprintln!`, which the test harness hides.
        let _ = writeln!(std::io::stderr(), "skipped: {below} is not in $GROOMKIT_DATA");
        return None;
    }
    Some(path)
}

fn hair(path: &Path, place: impl Fn(Vec3) -> Vec3) -> Groom {
    let file = cyhair::HairFile::open(path).unwrap().file;
    let mut offsets = vec![0];
    offsets.extend(file.strand_ranges().map(|range| range.end as u32));
    let points = file.points.unwrap_or_default().into_iter().map(|p| place(Vec3::from(p))).collect();
    Groom::new(offsets, points).unwrap()
}

/// Roots keep their height and segments their length at every frame; prints how well.
fn check(name: &str, groom: &Groom, mesh: &MovingMesh) {
    let surface = Surface::of(mesh);
    let (binding, report) = Binding::new(groom, &surface, &BindOptions::default()).unwrap();
    let mut frames = RootFrames::new(&binding, surface).unwrap();
    let (start, end) = mesh.time_range().unwrap();
    let rate = mesh.frame_rate().unwrap_or(24.0);
    let (first, last) = ((start * rate).floor() as u32, (end * rate).ceil() as u32);
    let size = report.mesh_size;
    let (mut height, mut length, mut rounded, mut held) = (0f64, 0f64, 0f64, 0);
    let mut out = Vec::new();
    for frame in first..=last {
        let pose = mesh.pose(f64::from(frame) / rate).unwrap();
        frames.follow(&pose).unwrap();
        assert!(!frames.mirrored(), "{name}, frame {frame}");
        held += frames.held();
        carry_rigid(groom, &frames, DVec3::ZERO, &mut out).unwrap();
        for (strand, root) in binding.roots().iter().enumerate() {
            let range = groom.strand_range(strand);
            let (rest, moved) = (groom.strand(strand), &out[range]);
            let [a, b, c] = surface.triangles[root.triangle as usize].map(|v| pose.positions[v as usize]);
            let place = root.barycentrics.x * a + root.barycentrics.y * b + root.barycentrics.z * c;
            height = height.max((moved[0].as_dvec3().distance(place) - root.height.abs()).abs() / size);
            let motion = frames.motion(strand);
            for (before, after) in rest.windows(2).zip(moved.windows(2)) {
                let [p, q] = [before[0], before[1]].map(Vec3::as_dvec3);
                let at_rest = p.distance(q);
                if at_rest > 0.0 {
                    length = length.max((motion.apply(p).distance(motion.apply(q)) / at_rest - 1.0).abs());
                }
                let now = after[0].as_dvec3().distance(after[1].as_dvec3());
                rounded = rounded.max((now - at_rest).abs() / size);
            }
        }
        assert!(out.iter().all(|p| p.is_finite()), "{name}, frame {frame}");
    }
    println!(
        "{name}: {} strands, {} frames, size {size:.4}; roots off the mesh {:.4} (median), {:.4} (most); heights within \
         {height:.1e} of the size, lengths within {length:.1e} before rounding to f32 and {rounded:.1e} of the size \
         after; {held} frames of strands held",
        report.strands,
        last - first + 1,
        report.distance_at(0.5).unwrap_or(0.0),
        report.distance_at(1.0).unwrap_or(0.0),
    );
    assert!(height < 1e-5 && length < 1e-6 && rounded < 1e-6, "{height} {length} {rounded}");
    assert_eq!(report.without_frame, 0);
}

#[test]
fn the_bears_fur_on_the_walking_bear() {
    let (Some(fur), Some(bear)) = (data("hair/bear_fur.hair"), data("meshes/tressfx_bear.glb")) else {
        return;
    };
    let mesh = MovingMesh::open(bear, &MeshOptions::default()).unwrap();
    check("bear", &hair(&fur, |p| p), &mesh);
}

#[test]
fn straight_hair_on_the_head() {
    let (Some(straight), Some(face)) = (data("hair/straight.hair"), data("meshes/jolt_face.glb")) else {
        return;
    };
    let mesh = MovingMesh::open(face, &MeshOptions::default()).unwrap();
    // Yuksel's units are tenths of an inch, z up and looking along x.
    check("head", &hair(&straight, |p| 0.00254 * Vec3::new(p.y, p.z, p.x)), &mesh);
}
