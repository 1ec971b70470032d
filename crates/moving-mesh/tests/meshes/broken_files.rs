//! Broken and strange glTF files are read or refused, never a panic.

use std::fs;

use glam::Vec3;
use moving_mesh::{MeshError, MeshOptions, TriangleMesh};
use proptest::prelude::*;

use crate::support::{Gltf, data, glb, open_as};

/// A GLB of one triangle, 42 bytes of buffer: positions, then u16 indices, with a node that moves it.
fn one_triangle(json_extra: &str) -> Vec<u8> {
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"mesh":0,"translation":[0,0,5]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
        {{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":6}}],
        "buffers":[{{"byteLength":42}}]{json_extra}}}"#
    );
    let mut binary: Vec<u8> =
        [0f32, 0., 0., 1., 0., 0., 0., 1., 0.].iter().flat_map(|x| x.to_le_bytes()).collect();
    binary.extend([0u16, 1, 2].iter().flat_map(|x| x.to_le_bytes()));
    glb(json.as_bytes(), &binary)
}

fn open(bytes: &[u8]) -> Result<TriangleMesh, MeshError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mesh.glb");
    fs::write(&path, bytes).unwrap();
    TriangleMesh::open(&path)
}

#[test]
fn the_node_moves_the_triangle() {
    let mesh = open(&one_triangle("")).unwrap();
    assert_eq!(mesh.triangles, [[0, 1, 2]]);
    assert_eq!(mesh.positions, [Vec3::new(0., 0., 5.), Vec3::new(1., 0., 5.), Vec3::new(0., 1., 5.)]);
}

#[test]
fn truncation_at_every_byte_is_an_error() {
    let bytes = one_triangle("");
    for length in 0..bytes.len() {
        let error = open(&bytes[..length]).unwrap_err();
        assert!(matches!(error, MeshError::Invalid { .. }), "{length}: {error}");
    }
}

#[test]
fn numbers_that_lie_are_refused() {
    let text = String::from_utf8_lossy(&one_triangle("")).into_owned();
    let json = text[20..text.rfind('}').unwrap() + 1].to_owned();
    let binary = [0u8; 44];
    let lies = [
        (r#""count":3,"type":"VEC3""#, r#""count":4,"type":"VEC3""#),
        (r#""count":3,"type":"VEC3""#, r#""count":1000000000000000,"type":"VEC3""#),
        (r#""byteOffset":36"#, r#""byteOffset":18446744073709551615"#),
        (r#""byteOffset":36"#, r#""byteOffset":40"#),
        (r#""byteLength":42"#, r#""byteLength":420"#),
        (r#""POSITION":0"#, r#""POSITION":2"#),
        (r#""indices":1"#, r#""indices":2"#),
        (r#""nodes":[0]"#, r#""nodes":[7]"#),
        (r#""mesh":0"#, r#""mesh":0,"children":[0]"#),
        (r#""type":"SCALAR""#, r#""type":"VEC2""#),
    ];
    for (truth, lie) in lies {
        assert!(json.contains(truth), "{truth}");
        let result = open(&glb(json.replace(truth, lie).as_bytes(), &binary));
        assert!(matches!(result, Err(MeshError::Invalid { .. })), "{lie}: {result:?}");
    }
}

#[test]
fn compressed_geometry_is_unsupported_and_says_so() {
    let extra = r#","extensionsRequired":["KHR_draco_mesh_compression"],"extensionsUsed":["KHR_draco_mesh_compression"]"#;
    let error = open(&one_triangle(extra)).unwrap_err();
    assert!(matches!(error, MeshError::Unsupported { .. }), "{error}");
    assert!(error.to_string().contains("KHR_draco_mesh_compression"));
}

#[test]
fn malformed_files_of_other_projects_do_not_panic() {
    let Some(root) = data("meshes/malformed") else { return };
    let mut folders = vec![root];
    let mut seen = 0;
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "gltf" || e == "glb") {
                seen += 1;
                match TriangleMesh::open(&path) {
                    Ok(mesh) => println!("{}: {} triangles", path.display(), mesh.triangles.len()),
                    Err(error) => println!("{error}"),
                }
            }
        }
    }
    assert!(seen > 10, "{seen} files");
}

#[test]
fn real_meshes_have_the_counts_their_makers_say() {
    for (file, vertices) in [("Fox.glb", 1728), ("jolt_face.glb", 9376), ("tressfx_bear.glb", 31175)] {
        let Some(path) = data("meshes").map(|p| p.join(file)) else { return };
        let mesh = TriangleMesh::open(&path).unwrap();
        assert_eq!(mesh.positions.len(), vertices, "{file}");
    }
}

/// Joint 1 stands at z = 5 with an inverse bind matrix that takes 2 off x; the mesh node's own place does
/// not count (glTF 2.0, section 3.7.3.3), and weights that sum to 2 are normalised.
#[test]
fn a_skin_places_its_vertices_by_joints_alone() {
    let json = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,1]}],
        "nodes":[{"mesh":0,"skin":0,"translation":[9,9,9]},{"translation":[0,0,5]}],
        "skins":[{"joints":[1],"inverseBindMatrices":3}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":1,"WEIGHTS_0":2}}]}],
        "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
        {"bufferView":0,"byteOffset":36,"componentType":5121,"count":3,"type":"VEC4"},
        {"bufferView":0,"byteOffset":48,"componentType":5126,"count":3,"type":"VEC4"},
        {"bufferView":0,"byteOffset":96,"componentType":5126,"count":1,"type":"MAT4"}],
        "bufferViews":[{"buffer":0,"byteLength":160}],"buffers":[{"byteLength":160}]}"#;
    let floats = |values: &[f32]| values.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let corners = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
    let weights = floats(&[2., 0., 0., 0.].repeat(3));
    let bind = floats(&[1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., -2., 0., 0., 1.]);
    let mesh = open(&glb(json.as_bytes(), &[corners, vec![0; 12], weights, bind].concat())).unwrap();
    assert_eq!(mesh.positions, [Vec3::new(-2., 0., 5.), Vec3::new(-1., 0., 5.), Vec3::new(-2., 1., 5.)]);
}

#[test]
fn sparse_accessors_are_applied() {
    let Some(folder) = data("meshes/malformed/gltf-rs") else { return };
    let [embedded, beside] =
        ["box_sparse.glb", "box_sparse.gltf"].map(|f| TriangleMesh::open(folder.join(f)).unwrap());
    assert_eq!(embedded, beside);
}

/// A few bytes of text each make the same large array count once more.
#[test]
fn arrays_that_are_named_again_and_again_take_no_memory() {
    let told = |members: &dyn Fn(&mut Gltf) -> String| {
        let mut gltf = Gltf::default();
        gltf.floats("VEC3", &[1.0; 3 * 3000]);
        let members = members(&mut gltf);
        open_as("a.glb", &gltf.file(&members), &MeshOptions::default()).map(|_| ()).unwrap_err().to_string()
    };
    let mesh = r#""meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}]"#;
    let nodes = vec![r#"{"mesh":0}"#; 3000].join(",");
    let error = told(&|_| format!(r#"{mesh},"nodes":[{nodes}]"#));
    assert!(error.contains("meshes[0].primitives[0]: 6000 vertices, corners and keys after"), "{error}");
    let targets = vec![r#"{"POSITION":0}"#; 3000].join(",");
    let morphs = mesh.replace("}}]}]", &format!(r#"}},"targets":[{targets}]}}]}}]"#));
    let error = told(&|_| format!(r#"{morphs},"nodes":[{{"mesh":0}}]"#));
    assert!(error.contains("meshes[0].primitives[0]: 3000 vertices, corners and keys after"), "{error}");
    let channel = r#"{"sampler":0,"target":{"node":0,"path":"translation"}}"#;
    let channels = vec![channel; 4000].join(",");
    let error = told(&|gltf| {
        let times = gltf.floats("SCALAR", &[0.0; 3000]);
        let samplers = format!(r#""samplers":[{{"input":{times},"output":0}}]"#);
        format!(r#"{mesh},"nodes":[{{"mesh":0}}],"animations":[{{{samplers},"channels":[{channels}]}}]"#)
    });
    assert!(error.contains("animations[0].samplers[0]: 6000 vertices, corners and keys after"), "{error}");
}

#[test]
fn skins_that_are_wrong_are_told() {
    let told = |joints: &str, weights: [f32; 12], nodes: &str| {
        let mut gltf = Gltf::default();
        gltf.floats("VEC3", &[0., 0., 0., 1., 0., 0., 0., 1., 0.]);
        let weights = gltf.floats("VEC4", &weights);
        let view = gltf.view(&[0; 12]);
        let numbers =
            gltf.accessor(&format!(r#""bufferView":{view},"componentType":5121,"count":3,"type":"VEC4""#));
        let file = gltf.file(&format!(
            r#""scenes":[{{"nodes":{nodes}}}],"nodes":[{{"mesh":0,"skin":0}},{{"name":"neck"}},{{"name":"jaw"}}],
            "skins":[{{"joints":{joints}}}],"meshes":[{{"primitives":[{{"attributes":
            {{"POSITION":0,"WEIGHTS_0":{weights},"JOINTS_0":{numbers}}}}}]}}]"#
        ));
        open_as("a.glb", &file, &MeshOptions::default()).map(|_| ()).map_err(|error| error.to_string())
    };
    let whole = [1., 0., 0., 0.].repeat(3).try_into().unwrap();
    assert_eq!(told("[1,2]", whole, "[0,1,2]"), Ok(()));
    let error = told("[1,2]", whole, "[0,1]").unwrap_err();
    assert!(error.contains("skins[0].joints[1]: node 2 is outside the scene"), "{error}");
    let error = told("[2,1,2]", whole, "[0,1,2]").unwrap_err();
    assert!(error.contains("skins[0].joints[2]: \"jaw\" is joint 0 already"), "{error}");
    for (vertex, weight, word) in
        [(1, 0.0, "no skin weight"), (2, -1.0, "weight -1"), (0, f32::NAN, "weight NaN")]
    {
        let mut weights = whole;
        weights[4 * vertex] = weight;
        let error = told("[1,2]", weights, "[0,1,2]").unwrap_err();
        assert!(error.contains(word) && error.contains(&format!("vertex {vertex}")), "{error}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]
    #[test]
    fn flipped_bytes_do_not_panic(at in prop::collection::vec((0usize..2000, any::<u8>()), 1..4)) {
        let mut bytes = one_triangle("");
        for (i, value) in at {
            let i = i % bytes.len();
            bytes[i] = value;
        }
        let _ = open(&bytes);
    }
}

/// u16 positions every 8 bytes, which are 0 to 1 of what the node makes of them; no bounds in the file.
#[test]
fn quantised_meshes_are_read() {
    let json = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
        "extensionsUsed":["KHR_mesh_quantization"],"extensionsRequired":["KHR_mesh_quantization"],
        "nodes":[{"mesh":0,"scale":[2,2,2],"translation":[1,0,0]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
        "accessors":[{"bufferView":0,"componentType":5123,"normalized":true,"count":3,"type":"VEC3"}],
        "bufferViews":[{"buffer":0,"byteLength":24,"byteStride":8}],"buffers":[{"byteLength":24}]}"#;
    let words = [0u16, 0, 0, 0, 65535, 0, 0, 0, 0, 13107, 0, 0];
    let mesh = open(&glb(json.as_bytes(), &words.map(u16::to_le_bytes).concat())).unwrap();
    assert_eq!(mesh.positions, [Vec3::X, Vec3::X * 3.0, Vec3::new(1.0, 0.4, 0.0)]);
}
