use std::path::Path;

use serde_json::json;

use crate::{open, refused, said};

#[test]
fn mappings_merge_and_anything_else_replaces() {
    let document = open(&[
        ("dir/a.yaml", "include: [one.yaml, sub/two.yaml]\nrender: {spp: 4}\nlist: [9]\nsheet:\n"),
        ("dir/one.yaml", "render: {spp: 1, width: 10, tone: {a: 1}}\nlist: [1, 2, 3]\nsheet: {columns: 4}\n"),
        ("dir/sub/two.yaml", "include: ../three.yaml\nrender: {width: 20, tone: {b: 2}}\n"),
        ("dir/three.yaml", "render: {height: 30, width: 30}\nlast: true\n"),
    ])
    .unwrap();
    assert_eq!(
        said(&document),
        json!({
            "render": {"spp": 4, "width": 20, "tone": {"a": 1, "b": 2}, "height": 30},
            "list": [9], "sheet": null, "last": true
        })
    );
    let files: Vec<_> = document.files().iter().map(|f| f.to_str().unwrap()).collect();
    assert_eq!(files, ["dir/a.yaml", "dir/one.yaml", "dir/sub/two.yaml", "dir/three.yaml"]);
    // Keys come in the order they were first written, the deepest file first.
    assert_eq!(document.root().keys().collect::<Vec<_>>(), ["render", "list", "sheet", "last"]);
    // Paths count from the file they are written in.
    let folder = |path: &str| document.folder_of(document.root().at(path).unwrap());
    assert_eq!(folder("render.spp"), Path::new(""));
    assert_eq!(folder("render.tone.a"), Path::new(""));
    assert_eq!(folder("render.tone.b"), Path::new("sub"));
    assert_eq!(folder("last"), Path::new("sub/.."));
}

#[test]
fn paths_are_made_to_count_from_the_first_files_folder() {
    let mut document = open(&[
        ("dir/a.yaml", "include: sub/b.yaml\nvariables: {own: own.hair}\nmesh: {file: a.obj}\n"),
        ("dir/sub/b.yaml", "variables: {own: none, lower: low.hair}\ngroom: {file: '${own}', name: b}\nsky: {file: x/sky.hdr}\nlist: [{file: '${lower}'}, {file: /abs}, {}]\n"),
    ])
    .unwrap();
    document.lay(&strict_yaml::Setting::set("list.2.file=here.txt")).unwrap();
    let mut document = document.with_variables().unwrap().0;
    document.join_folders(&["groom.file", "mesh.file", "sky.file", "list.*.file", "none.file"]);
    assert_eq!(
        said(&document),
        json!({
            "groom": {"file": "own.hair", "name": "b"}, "mesh": {"file": "a.obj"}, "sky": {"file": "sub/x/sky.hdr"},
            "list": [{"file": "sub/low.hair"}, {"file": "/abs"}, {"file": "here.txt"}]
        })
    );
}

#[test]
fn what_cannot_be_included_is_told_where_it_is_asked_for() {
    assert_eq!(
        refused(&[
            ("a.yaml", "x: 1\ninclude: [b.yaml, none.yaml, 4, '${x}.yaml']\n"),
            ("b.yaml", "include: no.yaml\n")
        ]),
        [
            "b.yaml:1:10: include: no file at `no.yaml` (entity not found)",
            "a.yaml:2:19: include: no file at `none.yaml` (entity not found)",
            "a.yaml:2:30: include: is a whole number `4`, expected a path or a list of paths",
            "a.yaml:2:33: include: `${x}.yaml`: variables are known only when all files are read",
        ]
    );
    let own = refused(&[("d/a.yaml", "include: ../d/b.yaml\n"), ("d/b.yaml", "include: [./a.yaml]\n")]);
    assert_eq!(own, ["d/b.yaml:1:11: include: `d/a.yaml` includes itself, by `d/a.yaml` -> `d/b.yaml`"]);
}

#[test]
fn every_file_tells_its_own_faults() {
    assert_eq!(
        refused(&[
            ("a.yaml", "include: [b.yaml, c.yaml, d.yaml]\n"),
            ("b.yaml", "x: 1\ny: {x: 2, x: 3}\n"),
            ("c.yaml", "- 1\n"),
            ("d.yaml", "x: !tag 1\n"),
        ]),
        [
            "b.yaml:2:11: y: the key `x` is there twice",
            "c.yaml:1:1: is a list, expected keys and values",
            "d.yaml:1:4: x: tags (`!name`) mean nothing here",
        ]
    );
    assert!(refused(&[("a.yaml", "x: [1\n")])[0].starts_with("a.yaml:2:1: "));
    assert_eq!(said(&open(&[("a.yaml", "# nothing\n")]).unwrap()), json!({}));
}
