//! Files that others made.

use glam::DVec3;
use moving_mesh::{AnimationChoice, MeshOptions, MovingMesh, RestPose, TriangleMesh};

use crate::support::{data, size};

fn open(file: &str, options: &MeshOptions) -> Option<MovingMesh> {
    Some(MovingMesh::open(data(file)?, options).unwrap())
}

/// Two targets of a cube, keys at 0 to 4.19 s; figures from the file: the first weight is 1 at 1.0478 s.
#[test]
fn the_cube_morphs() {
    let Some(cube) = open("meshes/AnimatedMorphCube/AnimatedMorphCube.gltf", &MeshOptions::default()) else {
        return;
    };
    assert_eq!(cube.animations().len(), 1);
    let rest = cube.rest().clone();
    assert_eq!(cube.pose(0.0).unwrap(), rest);
    let largest = (0..=42)
        .map(|i| {
            let pose = cube.pose(f64::from(i) * 0.1).unwrap();
            pose.positions.iter().zip(&rest.positions).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max)
        })
        .fold(0.0, f64::max);
    assert!(largest > 0.5 * size(&rest) / 3.0_f64.sqrt(), "{largest} of {}", size(&rest));
}

#[test]
fn the_fox_has_three_animations() {
    let Some(fox) = open("meshes/Fox.glb", &MeshOptions::default()) else { return };
    let names: Vec<&str> = fox.animations().iter().map(|animation| animation.name.as_str()).collect();
    assert_eq!(names, ["Survey", "Walk", "Run"]);
    let run = MeshOptions { animation: AnimationChoice::Name("Run".into()), ..MeshOptions::default() };
    let Some(run) = open("meshes/Fox.glb", &run) else { return };
    assert_ne!(run.pose(0.3).unwrap(), fox.pose(0.3).unwrap());
    assert_eq!(run.parts()[0].material.as_deref(), Some("fox_material"));
    let texture = run.parts()[0].texture().unwrap().unwrap();
    assert_eq!(texture.pixels.len(), (texture.width * texture.height) as usize);
    assert!(texture.width >= 256);
    assert_eq!(run.skeleton().unwrap().joints.len(), 24);
}

/// The fur was made for the bear as it was modelled: its roots are 0.36 (median) to 4.67 (largest) off the body.
#[test]
fn the_bears_fur_sits_on_its_bind_pose() {
    let (Some(bear), Some(fur)) =
        (open("meshes/tressfx_bear.glb", &MeshOptions::default()), data("hair/bear_fur.hair"))
    else {
        return;
    };
    assert_eq!((bear.vertex_count(), bear.skeleton().unwrap().joints.len()), (31_175, 80));
    let roots = roots(&std::fs::read(fur).unwrap());
    assert_eq!(roots.len(), 48_113);
    // Every 80th root against every triangle.
    let off = |pose: &[DVec3]| {
        let triangles: Vec<[DVec3; 3]> =
            bear.triangles().iter().map(|t| t.map(|vertex| pose[vertex as usize])).collect();
        let nearest = |root: &DVec3| {
            triangles.iter().map(|t| (nearest_point(t, *root) - *root).length()).fold(f64::INFINITY, f64::min)
        };
        let mut distances: Vec<f64> = roots.iter().step_by(80).map(nearest).collect();
        distances.sort_by(f64::total_cmp);
        (distances[distances.len() / 2], distances[distances.len() - 1])
    };
    let (median, largest) = off(&bear.rest().positions);
    println!("bear: roots are {median:.3} (median), {largest:.3} (largest) off the bind pose");
    assert!((median - 0.36).abs() < 0.03 && (2.0..4.68).contains(&largest), "{median} {largest}");
    let (walking, _) = off(&bear.pose(0.5).unwrap().positions);
    assert!(walking > 2.0 * median, "the walk is elsewhere: {walking}");
}

/// Christer Ericson, Real-Time Collision Detection (2005), section 5.1.5.
fn nearest_point([a, b, c]: &[DVec3; 3], p: DVec3) -> DVec3 {
    let (ab, ac, ap) = (*b - *a, *c - *a, p - *a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    let (d3, d4) = (ab.dot(p - *b), ac.dot(p - *b));
    let (d5, d6) = (ab.dot(p - *c), ac.dot(p - *c));
    let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return *a + ab * (d1 / (d1 - d3));
    }
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return *a + ac * (d2 / (d2 - d6));
    }
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return *b + (*c - *b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    *a + (ab * vb + ac * vc) / (va + vb + vc)
}

/// First point of each strand of four, from a HAIR file without segments: 128 bytes of header, then points.
fn roots(hair: &[u8]) -> Vec<DVec3> {
    let float = |bytes: &[u8]| f64::from(f32::from_le_bytes(bytes.try_into().unwrap()));
    hair[128..]
        .chunks_exact(48)
        .map(|strand| DVec3::new(float(&strand[..4]), float(&strand[4..8]), float(&strand[8..12])))
        .collect()
}

#[test]
fn the_triangle_mesh_is_the_file_as_it_stands() {
    let nodes = MeshOptions { rest: RestPose::Nodes, ..MeshOptions::default() };
    let Some(fox) = open("meshes/Fox.glb", &nodes) else { return };
    let still = TriangleMesh::open(data("meshes/Fox.glb").unwrap()).unwrap();
    assert_eq!(still, fox.to_triangle_mesh(fox.rest()));
}
