//! OBJ files and sequences of them.

use std::fs;
use std::path::Path;

use glam::{DVec3, Vec2, Vec3};
use moving_mesh::{MeshOptions, MovingMesh};

/// A square whose last corner is at `height`; point 1 has two texture coordinates.
fn square(height: f32) -> String {
    format!(
        "mtllib skin.mtl\no square\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 {height}\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 0.5 0.5\n\
         vn 0 0 1\nusemtl skin\nf 1/1/1 2/2/1 3/3/1\nf 1/5/1 3/3/1 4/4/1\n"
    )
}

fn sequence(folder: &Path) -> String {
    for (frame, height) in [(8, 0.0), (9, 2.0), (10, 6.0)] {
        fs::write(folder.join(format!("walk.{frame:03}.obj")), square(height)).unwrap();
    }
    folder.join("walk.###.obj").display().to_string()
}

#[test]
fn frames_are_linear_between_their_files() {
    let folder = tempfile::tempdir().unwrap();
    let pattern = sequence(folder.path());
    let at =
        |fps| MovingMesh::open(&pattern, &MeshOptions { frame_rate: fps, ..MeshOptions::default() }).unwrap();
    let mesh = at(Some(10.0));
    assert_eq!((mesh.frame_rate(), mesh.time_range(), mesh.moves()), (Some(10.0), Some((0.8, 1.0)), true));
    assert_eq!(at(None).time_range(), Some((8.0 / 24.0, 10.0 / 24.0)));
    assert_eq!(mesh.vertex_count(), 5, "point 1 is two vertices");
    let highest = |time: f64| mesh.pose(time).unwrap().positions.iter().map(|p| p.z).fold(0.0, f64::max);
    for (time, height) in
        [(0.0, 0.0), (0.8, 0.0), (0.85, 1.0), (0.9, 2.0), (0.925, 3.0), (1.0, 6.0), (5.0, 6.0)]
    {
        assert!((highest(time) - height).abs() < 1e-9, "{time}: {}", highest(time));
    }
    assert_eq!(mesh.pose(0.85).unwrap().normals.unwrap(), [Vec3::Z; 5]);
    assert_eq!(mesh.rest().positions, mesh.pose(0.0).unwrap().positions);
    let (uvs, rest) = (mesh.uvs().unwrap(), mesh.rest());
    let at_origin: Vec<Vec2> = (0..5).filter(|&v| rest.positions[v] == DVec3::ZERO).map(|v| uvs[v]).collect();
    assert_eq!(at_origin, [Vec2::ZERO, Vec2::splat(0.5)]);
}

#[test]
fn a_frame_that_is_another_mesh_is_told_with_its_file() {
    let told = |change: &dyn Fn(String) -> String| {
        let folder = tempfile::tempdir().unwrap();
        let pattern = sequence(folder.path());
        let broken = folder.path().join("walk.010.obj");
        fs::write(&broken, change(fs::read_to_string(&broken).unwrap())).unwrap();
        let mesh = MovingMesh::open(&pattern, &MeshOptions::default()).unwrap();
        mesh.pose(9.0 / 24.0).unwrap();
        mesh.pose(9.5 / 24.0).unwrap_err().to_string()
    };
    let error = told(&|text| format!("{text}f 1/1/1 2/2/1 4/4/1\n"));
    assert!(
        error.contains("walk.010.obj: frame 10: object `square`: 3 triangles, expected the 2 of frame 8"),
        "{error}"
    );
    let error = told(&|text| text.replace("f 1/5/1 3/3/1 4/4/1", "f 1/5/1 4/4/1 3/3/1"));
    assert!(
        error.contains("frame 10: object `square`: triangle 1 joins other points than in frame 8"),
        "{error}"
    );
    let error = told(&|_| "v 0 0 0\n".into());
    assert!(
        error.contains("frame 10: object `unnamed_object`: 0 triangles, expected the 2 of frame 8"),
        "{error}"
    );
    let error = told(&|text| format!("{text}o more\nf 1 2 3\n"));
    assert!(error.contains("frame 10: topology: 2 objects with faces, expected the 1 of frame 8"), "{error}");
    let error = told(&|text| text.replace("v 1 1 0", "v 1 one 0"));
    assert!(error.contains("walk.010.obj: frame 10: OBJ text"), "{error}");
    let error = told(&|text| text.replace("v 1 1 0", "v 1 nan 0"));
    assert!(error.contains("is not finite"), "{error}");
}

#[test]
fn materials_are_those_of_the_library() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("square.obj");
    fs::write(&path, square(0.0)).unwrap();
    let open = || MovingMesh::open(&path, &MeshOptions::default()).unwrap();
    assert_eq!(open().parts()[0].material, None, "no library, no material");
    fs::write(folder.path().join("skin.mtl"), "newmtl skin\nKd 0.5 0.25 1\nmap_Kd skin.png\n").unwrap();
    let mesh = open();
    let part = &mesh.parts()[0];
    assert_eq!((part.material.as_deref(), part.base_color), (Some("skin"), Vec3::new(0.5, 0.25, 1.0)));
    assert!(part.texture().unwrap_err().to_string().contains("skin.png"));
    let image = image::RgbImage::from_pixel(1, 1, image::Rgb([255, 255, 255]));
    image.save(folder.path().join("skin.png")).unwrap();
    assert_eq!(part.texture().unwrap().unwrap().pixels, [Vec3::ONE]);
    assert_eq!((mesh.vertex_count(), mesh.moves(), mesh.frame_rate()), (5, false, None));
    // An address that reaches out of the folder is not followed.
    fs::write(folder.path().join("skin.mtl"), "newmtl skin\nmap_Kd ../skin.png\n").unwrap();
    assert!(open().parts()[0].texture().unwrap_err().to_string().contains("in the folder of the OBJ file"));
}
