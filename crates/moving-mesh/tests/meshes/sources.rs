//! The files that meshes and cameras are read from.

use std::fs;
use std::path::Path;

use moving_mesh::{MeshError, sources};

fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        let path = folder.path().join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    folder
}

fn names(folder: &Path, name: &str, pictures: bool) -> Vec<String> {
    let found = sources(folder.join(name), pictures).unwrap();
    let inside = |path: &std::path::PathBuf| path.strip_prefix(folder).unwrap().display().to_string();
    found.iter().map(inside).map(|name| name.replace('\\', "/")).collect()
}

#[test]
fn an_obj_has_libraries_and_they_have_pictures() {
    let obj = "mtllib looks of it.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl skin\nf 1 2 3\n";
    let folder = folder(&[
        ("a.obj", obj),
        ("looks of it.mtl", "newmtl skin\nmap_Kd skin.png\n"),
        ("skin.png", ""),
        ("walk.0001.obj", obj),
        ("walk.0002.obj", obj),
        ("walk.x.obj", obj),
        ("gap.1.obj", obj),
        ("gap.2.obj", obj),
        ("gap.4.obj", obj),
    ]);
    let names = |name, pictures| names(folder.path(), name, pictures);
    assert_eq!(names("a.obj", false), ["a.obj"]);
    assert_eq!(names("a.obj", true), ["a.obj", "looks of it.mtl", "skin.png"]);
    assert_eq!(names("walk.####.obj", false), ["walk.0001.obj", "walk.0002.obj"]);
    assert_eq!(names("walk.####.obj", true).len(), 4);
    let told = sources(folder.path().join("gap.#.obj"), false).unwrap_err();
    assert!(matches!(told, MeshError::Invalid { .. }), "{told}");
    // What is not there, or cannot be understood, its reader tells.
    assert_eq!(names("none.obj", true), ["none.obj"]);
    assert_eq!(names("skin.png", true), ["skin.png"]);
}

#[test]
fn a_gltf_document_has_buffers_and_pictures() {
    let document = r#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":1,"uri":"a%20b.bin"},
        {"byteLength":1,"uri":"lost.bin"}],"images":[{"uri":"skin.png"}]}"#;
    let folder = folder(&[("a.gltf", document), ("a b.bin", "x"), ("skin.png", "x"), ("bad.gltf", "{")]);
    assert_eq!(names(folder.path(), "a.gltf", false), ["a.gltf", "a b.bin"]);
    assert_eq!(names(folder.path(), "a.gltf", true), ["a.gltf", "a b.bin", "skin.png"]);
    assert_eq!(names(folder.path(), "bad.gltf", true), ["bad.gltf"]);
}

#[test]
fn a_stage_has_the_layers_it_is_composed_of() {
    let folder = folder(&[
        (
            "shot.usda",
            "#usda 1.0\n(\n    subLayers = [@./under.usda@, @gone.usda@]\n)\n\
             def \"A\" (references = @set/chair.usda@</Chair>)\n{\n    asset skin = @skin.png@\n}\n",
        ),
        ("under.usda", "#usda 1.0\ndef \"B\" (payload = @set/../set/body.usda@)\n{\n}\n"),
        ("set/chair.usda", "#usda 1.0\ndef \"Chair\" (references = @../shot.usda@</A>)\n{\n}\n"),
        (
            "set/body.usda",
            "#usda 1.0\ndef \"C\" (clips = { dictionary default = { asset[] assetPaths = [@clip.usda@] } })\n{\n}\n",
        ),
        ("set/clip.usda", "#usda 1.0\n"),
        ("skin.png", ""),
    ]);
    let names = |pictures| {
        let found = sources(folder.path().join("shot.usda"), pictures).unwrap();
        let mut names: Vec<String> = found
            .iter()
            .map(|path| path.canonicalize().unwrap())
            .map(|path| path.file_name().unwrap().to_string_lossy().into_owned())
            .collect();
        names[1..].sort();
        names
    };
    assert_eq!(names(false), ["shot.usda", "body.usda", "chair.usda", "clip.usda", "under.usda"]);
    assert_eq!(names(true).len(), 6);
}
