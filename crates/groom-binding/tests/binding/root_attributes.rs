//! What a groom learns from the mesh under its roots.

use std::fs;
use std::path::Path;

use glam::{Vec2, Vec3};
use groom::{Attribute, Groom, Values, names};
use groom_binding::{
    BindBy, BindOptions, Binding, GroupBy, ROOT_NORMAL, Surface, set_groups, set_root_colors,
    set_root_normals, set_root_triangles, set_root_uvs,
};
use moving_mesh::{MeshOptions, MovingMesh};

use crate::shapes::egg;
use crate::strands;

/// Two triangles in the plane of x and y: one of plain colour, one with a picture of a red and a white pixel.
const TWO_PARTS: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"materials":[{"name":"plain","pbrMetallicRoughness":{"baseColorFactor":[0.5,0.25,0,1]}},
{"name":"painted","pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1],"baseColorTexture":{"index":0}}}],
"textures":[{"source":0}],"images":[{"uri":"data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAIAAAABCAIAAAB7QOjdAAAAD0lEQVR42mP4z8Dw//9/AAv7A/1kbNMAAAAAAElFTkSuQmCC"}],
"meshes":[{"name":"two","primitives":[
{"material":0,"attributes":{"POSITION":0}},{"material":1,"attributes":{"POSITION":1,"TEXCOORD_0":2}}]}],
"accessors":[
{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5126,"count":3,"type":"VEC3","min":[2,0,0],"max":[3,1,0]},
{"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"}],
"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":36},{"buffer":0,"byteOffset":96,"byteLength":24}],
"buffers":[{"byteLength":120,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAQAAAAAAAAAAAAABAQAAAAAAAAAAAAAAAQAAAgD8AAAAAAACAPgAAAD8AAIA+AAAAPwAAgD4AAAA/AACAPgAAAD8AAEA/AAAAPwAAgD4AAAA/"}]}"#;

fn values<'g>(groom: &'g Groom, name: &str) -> &'g Values {
    &groom.attribute(name).unwrap().values
}

fn two_parts() -> MovingMesh {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.gltf");
    fs::write(&path, TWO_PARTS).unwrap();
    MovingMesh::open(&path, &MeshOptions::default()).unwrap()
}

#[test]
fn colours_coordinates_and_groups_of_two_materials() {
    let mesh = two_parts();
    let roots = [(0.25, 0.25), (2.0, 0.5), (3.0, 0.0), (2.5, 0.0)].map(|(x, y)| Vec3::new(x, y, 0.5));
    let mut groom = Groom::new((0..=4).collect(), roots.to_vec()).unwrap();
    let (binding, _) = Binding::new(&groom, &Surface::of(&mesh), &BindOptions::default()).unwrap();
    set_root_colors(&mut groom, &binding, &mesh).unwrap();
    set_root_uvs(&mut groom, &binding, &Surface::of(&mesh)).unwrap();
    // Red, white and half of each, as light, times the factor.
    let expected = [[0.5, 0.25, 0.0], [0.5, 0.0, 0.0], [0.5, 1.0, 1.0], [0.5, 0.5, 0.5]].map(Vec3::from);
    assert_eq!(*values(&groom, names::COLOR), Values::Vec3(expected.to_vec()));
    let expected = [[0.0, 0.0], [0.25, 0.5], [0.75, 0.5], [0.5, 0.5]].map(Vec2::from);
    let Values::Vec2(uvs) = values(&groom, names::ROOT_UV) else { panic!("vec2") };
    assert_eq!(uvs[1..], expected[1..]);
    let groups = set_groups(&mut groom, &binding, &mesh, GroupBy::Material).unwrap();
    assert_eq!(groups, ["plain", "painted"]);
    assert_eq!(*values(&groom, names::GROUP), Values::Int(vec![0, 1, 1, 1]));
    assert_eq!(set_groups(&mut groom, &binding, &mesh, GroupBy::Part).unwrap().len(), mesh.parts().len());
}

#[test]
fn a_picture_that_is_lost_is_told_and_changes_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("two.gltf");
    let start = TWO_PARTS.find("data:image").unwrap();
    let end = start + TWO_PARTS[start..].find('"').unwrap();
    fs::write(&path, format!("{}lost.png{}", &TWO_PARTS[..start], &TWO_PARTS[end..])).unwrap();
    let mesh = MovingMesh::open(&path, &MeshOptions::default()).unwrap();
    let bound = |x| {
        let groom = Groom::new(vec![0, 1], vec![Vec3::new(x, 0.1, 0.0)]).unwrap();
        let (binding, _) = Binding::new(&groom, &Surface::of(&mesh), &BindOptions::default()).unwrap();
        (groom, binding)
    };
    let (mut groom, binding) = bound(2.1);
    let error = set_root_colors(&mut groom, &binding, &mesh).unwrap_err().to_string();
    assert!(error.contains("lost.png"), "{error}");
    assert!(groom.colors().is_none());
    // Where no strand stands on it, nobody misses it.
    let (mut groom, binding) = bound(0.1);
    set_root_colors(&mut groom, &binding, &mesh).unwrap();
}

#[test]
fn the_sample_head_is_scalp_and_skin() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../samples/nodding_head.glb");
    let mesh = MovingMesh::open(path, &MeshOptions::default()).unwrap();
    let rest = &mesh.rest().positions;
    let mut groom =
        Groom::new((0..=rest.len() as u32).collect(), rest.iter().map(|p| p.as_vec3()).collect()).unwrap();
    let (binding, _) = Binding::new(&groom, &Surface::of(&mesh), &BindOptions::default()).unwrap();
    let names = set_groups(&mut groom, &binding, &mesh, GroupBy::Material).unwrap();
    set_root_colors(&mut groom, &binding, &mesh).unwrap();
    let (Values::Int(groups), Values::Vec3(colors)) =
        (values(&groom, names::GROUP), values(&groom, names::COLOR))
    else {
        panic!("ints and colours")
    };
    for (&group, &color) in groups.iter().zip(colors) {
        let expected = match names[group as usize].as_str() {
            "scalp" => Vec3::new(0.3, 0.17, 0.1),
            "skin" => Vec3::new(0.78, 0.5, 0.38),
            other => panic!("{other}"),
        };
        assert!(color.abs_diff_eq(expected, 1e-6), "{color}");
    }
    assert!(groups.contains(&0) && groups.contains(&1));
}

#[test]
fn normals_and_triangles() {
    let (mesh, mut groom) = (egg(20, 30), strands(200, 0.1, 3));
    let (binding, _) = Binding::new(&groom, &mesh.surface(), &BindOptions::default()).unwrap();
    set_root_normals(&mut groom, &binding).unwrap();
    let Some(Attribute { values: Values::Vec3(normals), .. }) = groom.attribute(ROOT_NORMAL) else {
        panic!("vec3")
    };
    for (normal, root) in normals.iter().zip(binding.roots()) {
        // An egg's normal: the gradient of x^2 + y^2 / 1.69 + z^2.
        let at = root.rest.origin.as_vec3();
        let expected = Vec3::new(at.x, at.y / 1.69, at.z).normalize();
        assert!(normal.dot(expected) > 0.99 && (normal.length() - 1.0).abs() < 1e-6, "{normal} {expected}");
    }
    // The groom can be bound again by the triangles it was given.
    set_root_triangles(&mut groom, &binding).unwrap();
    let by = BindOptions { by: BindBy::RootTriangle, ..BindOptions::default() };
    let (again, _) = Binding::new(&groom, &mesh.surface(), &by).unwrap();
    for (one, other) in binding.roots().iter().zip(again.roots()) {
        assert_eq!(one.triangle, other.triangle);
        assert!((one.height - other.height).abs() < 1e-14);
    }
}
