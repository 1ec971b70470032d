//! What a pose costs: a skinned character, on one core.
//!
//! The bear of `$GROOMKIT_DATA` (31,175 vertices with normals, 80 joints of 6 skins) when it is there, else a made-up
//! tube of its size.

#![allow(missing_docs)] // criterion's macros

use std::f32::consts::TAU;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use moving_mesh::{MeshOptions, MovingMesh, Pose};

/// Of the tube: rings, vertices a ring, joints.
const RINGS: usize = 625;
const AROUND: usize = 50;
const JOINTS: usize = 80;

fn bear() -> Option<PathBuf> {
    let root = std::env::var_os("GROOMKIT_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from);
    Some(root.join("meshes/tressfx_bear.glb")).filter(|path| path.exists())
}

/// A tube along y whose joints all turn, two to a vertex.
fn tube(folder: &Path) -> std::io::Result<PathBuf> {
    let mut bytes = Vec::new();
    let mut views = String::new();
    let mut accessors = String::new();
    let mut put = |values: &[f32], kind: &str, width: usize| {
        let comma = if views.is_empty() { "" } else { "," };
        let (start, count) = (bytes.len(), values.len() / width);
        bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        let _ = write!(
            views,
            r#"{comma}{{"buffer":0,"byteOffset":{start},"byteLength":{}}}"#,
            bytes.len() - start
        );
        let view = views.matches("buffer\"").count() - 1;
        let _ = write!(
            accessors,
            r#"{comma}{{"bufferView":{view},"componentType":5126,"count":{count},"type":"{kind}"}}"#
        );
    };
    let vertices =
        || (0..RINGS).flat_map(|ring| (0..AROUND).map(move |i| (ring, i as f32 / AROUND as f32 * TAU)));
    let normals: Vec<f32> = vertices().flat_map(|(_, angle)| [angle.cos(), 0.0, angle.sin()]).collect();
    let points: Vec<f32> =
        vertices().flat_map(|(ring, angle)| [angle.cos(), ring as f32 * 0.1, angle.sin()]).collect();
    let weights: Vec<f32> = vertices().flat_map(|_| [0.6, 0.4, 0.0, 0.0]).collect();
    put(&points, "VEC3", 3);
    put(&normals, "VEC3", 3);
    put(&weights, "VEC4", 4);
    put(&[0.0, 1.0], "SCALAR", 1);
    put(&[0.0, 0.0, 0.0, 1.0, 0.02, 0.0, 0.0, 0.9998], "VEC4", 4);
    let joints = bytes.len();
    let joint = |ring: usize| (ring * (JOINTS - 1) / RINGS) as u8;
    bytes.extend(vertices().flat_map(|(ring, _)| [joint(ring), joint(ring) + 1, 0, 0]));
    let _ = write!(views, r#",{{"buffer":0,"byteOffset":{joints},"byteLength":{}}}"#, bytes.len() - joints);
    let _ = write!(
        accessors,
        r#",{{"bufferView":5,"componentType":5121,"count":{},"type":"VEC4"}}"#,
        RINGS * AROUND
    );
    let nodes: Vec<String> = (0..JOINTS)
        .map(|j| format!(r#"{{"translation":[0,{},0],"children":[{}]}}"#, f64::from(j > 0) * 0.78, j + 1))
        .collect();
    let numbers: Vec<String> = (0..JOINTS).map(|j| j.to_string()).collect();
    let channels: Vec<String> = (0..JOINTS)
        .map(|j| format!(r#"{{"sampler":0,"target":{{"node":{j},"path":"rotation"}}}}"#))
        .collect();
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"nodes":[{},{{"name":"end"}},{{"mesh":0,"skin":0}}],"skins":[{{"joints":[{}]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"JOINTS_0":5,"WEIGHTS_0":2}}}}]}}],
        "animations":[{{"samplers":[{{"input":3,"output":4}}],"channels":[{}]}}],
        "accessors":[{accessors}],"bufferViews":[{views}],"buffers":[{{"byteLength":{},"uri":"tube.bin"}}]}}"#,
        nodes.join(","),
        numbers.join(","),
        channels.join(","),
        bytes.len()
    );
    std::fs::write(folder.join("tube.bin"), bytes)?;
    let path = folder.join("tube.gltf");
    std::fs::write(&path, json)?;
    Ok(path)
}

fn poses(criterion: &mut Criterion) {
    let folder = tempfile::tempdir();
    let made = || folder.as_ref().ok().and_then(|folder| tube(folder.path()).ok());
    let Some(path) = bear().or_else(made) else { return };
    let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let Ok(mesh) = MovingMesh::open(&path, &MeshOptions::default()) else { return };
    let mut pose = Pose::default();
    let mut frame = 0_u32;
    criterion.bench_function(&format!("pose_into {name} ({} vertices)", mesh.vertex_count()), |bencher| {
        bencher.iter(|| {
            frame = (frame + 1) % 41;
            mesh.pose_into(f64::from(frame) / 30.0, &mut pose)
        });
    });
    criterion.bench_function(&format!("open {name}"), |bencher| {
        bencher.iter(|| MovingMesh::open(&path, &MeshOptions::default()).map(|mesh| mesh.vertex_count()));
    });
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(20).measurement_time(Duration::from_secs(2)).warm_up_time(Duration::from_millis(500));
    targets = poses
}
criterion_main!(benches);
