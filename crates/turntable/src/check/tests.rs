use crate::expand::of_text;

fn found(text: &str) -> Vec<String> {
    of_text(text, &[]).err().unwrap_or_default().iter().map(ToString::to_string).collect()
}

#[test]
fn samples_that_cannot_be_grown_are_refused() {
    let with = |sample: &str| found(&GOOD.replace("sample: {}", &format!("sample: {{{sample}}}")));
    assert!(with("points: 2")[0].starts_with("turn.yaml:2:26: groom.sample.points: is 2, expected 3..=1000"));
    for (sample, good) in
        [("points: 3", true), ("points: 1001", false), ("strands: 0", false), ("strands: 4000001", false)]
    {
        assert_eq!(with(sample).is_empty(), good, "{sample}");
    }
    assert_eq!(with("strands: 4000000, points: 1000"), Vec::<String>::new());
}

const GOOD: &str = "version: 1\ngroom: {sample: {}}\nlights: {environment: {studio: true}}\n";

#[test]
fn a_small_pipeline_is_enough() {
    assert_eq!(found(GOOD), Vec::<String>::new());
}

#[test]
fn every_fault_is_found_at_once_with_its_place() {
    let text =
        "version: 2\ngroom:\n  file: no/such.hair\nrender:\n  spp: 0\n  aovs: [R, TTR]\ncamera: {fov: 200}\n";
    let all = found(text);
    for start in [
        "turn.yaml:1:10: version: is 2",
        "turn.yaml:3:9: groom.file: no file at `no/such.hair`",
        "turn.yaml:5:8: render.spp: is 0, expected at least 1",
        "turn.yaml:6:13: render.aovs.1: unknown pass `TTR`, did you mean `",
        "turn.yaml:7:15: camera.fov: is 200.0, expected above 0, below 180 degrees",
        "turn.yaml: lights: holds nothing that shines",
    ] {
        assert!(all.iter().any(|f| f.starts_with(start)), "no {start:?} in {all:#?}");
    }
    assert_eq!(all.len(), 6);
}

#[test]
fn contradictions_and_escapes_are_refused() {
    for (more, words) in [
        ("material: {color: [1, 1, 1], melanin: 0.5}\n", "keep one"),
        ("material: {redness: 0.5}\n", "needs `melanin`"),
        ("material: {beta_m: 0}\n", "turn.yaml:4:20: material.beta_m: must lie in [0.001, 1], found 0"),
        ("material: {color: [2, 0, 0]}\n", "three numbers in 0..1"),
        ("material: {absorption: [.inf, 0, 0]}\n", "material.absorption: "),
        ("material: {preset: human}\n", "turn.yaml:4:20: material.preset: unknown preset `human`"),
        ("material: {file: none.yaml}\n", "turn.yaml:4:18: material.file: none.yaml: "),
        ("attributes: {width: 1, width_ramp: [1, 0]}\n", "keep one"),
        ("attributes: {width: .nan}\n", "a diameter"),
        ("convert: [../out.txt]\n", "inside the output folder"),
        ("convert: [/out.txt]\n", "inside the output folder"),
        ("convert: [out.xyz]\n", "no ending that can be written (.hair"),
        ("convert: [a.txt, a.txt]\n", "made twice"),
        (
            "convert: [a.txt, b.txt, a.txt/c.txt]\n",
            "convert.2: `a.txt/c.txt` and another output are a file and its",
        ),
        (
            "convert: [a.txt/c.txt, b.txt, a.txt]\n",
            "convert.2: `a.txt` and another output are a file and its folder",
        ),
        (
            "material: {texture: {file: none.png}}\n",
            "turn.yaml:4:28: material.texture.file: none.png: No such file",
        ),
        ("sheet: {file: sheet.jpg}\n", "ends in .png"),
        ("turntable: {frames: 0}\n", "1..=9999"),
        ("turntable: {degrees: 361}\n", "-360..360"),
        ("mesh: {file: none.obj}\n", "no file at"),
        ("mesh: {}\n", "turn.yaml:4:7: mesh: needs `file: PATH`"),
        ("attributes: {width: -1}\n", "attributes.width: is -1.0, expected"),
        ("material: {melanin: 3}\n", "material.melanin: is 3, expected 0..1"),
        ("camera: {target: [.nan, 0, 0]}\n", "three finite numbers"),
        ("render: {width: 60000, height: 60000}\n", "render: is 60000 x 60000 pixels"),
        ("turntable: {frames: 9999}\nrender: {width: 900}\nsheet: {}\n", "sheet: is "),
        ("bind: {}\n", "turn.yaml:4:7: bind: needs a `mesh`"),
        ("mesh: {file: head.####.obj}\n", "no file of the sequence `head.####.obj` is there"),
        ("motion: {fps: 0}\n", "motion.fps: is 0.0, expected above 0 frames a second"),
        ("motion: {shape: round}\n", "turn.yaml:4:17: motion.shape: "),
        ("motion: {shutter: [1, 0]}\n", "turn.yaml:4:19: motion.shutter: "),
        ("motion: {shutter: [0, 0], blur: positions}\n", "nothing can be blurred"),
        ("motion: {samples: 1}\n", "2..=255"),
        ("camera: {elevation_to: 91}\n", "-90..90 degrees"),
        ("camera: {position: [1, 2, 3], distance: 2}\n", "camera.distance: contradicts `position`"),
        ("camera: {position: [1, 2, 3], target: [1, 2, 3]}\n", "a point away from the target"),
        ("camera: {file: {}}\n", "camera.file: needs `path: PATH`"),
        ("camera: {file: {path: none.glb}}\n", "camera.file.path: no file at"),
        ("lights: {cornell: {room: 1}}\n", "lights.cornell.room: is 1.0, expected above 1"),
        (
            "comp: {weights: {TT: 2}}\n",
            "turn.yaml:4:22: comp.weights.TT: needs the pass: add `TT` to `render.aovs`",
        ),
        ("comp: {weights: {TTR: 2}}\n", "unknown pass `TTR`"),
        ("comp: {weights: {R: -1}}\nrender: {aovs: [all]}\n", "a finite factor of at least 0"),
        ("comp: {plate: none.png}\n", "comp.plate: no file at"),
        ("video: [{file: a.avi}]\n", "a name that ends in .mp4 or .mov"),
        ("video: [{codec: prores4444}]\n", "video.0.codec: ProRes goes into a .mov file"),
        ("video: [{}, {crf: 3}]\n", "video.1.file: `turntable.mp4` is made twice"),
        ("video: [{crf: 52}]\n", "0..=51"),
        ("video: [{fps: 0}]\n", "above 0, at most 1000"),
        ("page: {file: page.htm}\n", "a name that ends in .html"),
        ("page: {size: 8}\n", "16..=4096 pixels"),
        ("page: {file: report.html}\n", "a place of the program's own"),
        ("sheet: {captions: [frame, frame]}\n", "sheet.captions.1: is there twice"),
        ("simulate: {gravity: 1}\n", "turn.yaml:4:1: simulate: strands cannot be simulated here"),
    ] {
        let good = if more.starts_with("lights") {
            GOOD.split_inclusive("lights").next().unwrap_or_default().trim_end_matches("lights")
        } else {
            GOOD
        };
        let all = found(&format!("{good}{more}"));
        assert!(all.len() == 1 && all[0].contains(words), "{more}: {all:?}");
    }
}

#[test]
fn strands_are_bound_in_ways_that_agree() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = folder.path().join("head.0001.obj");
    std::fs::write(&mesh, "").unwrap();
    let mesh = folder.path().join("head.####.obj").display().to_string();
    for (bind, words) in [
        ("{}", ""),
        ("{rest: 3, beyond: drop, limit: 0.5}", ""),
        ("{rest: nodes}", ""),
        ("{rest: nods}", "bind.rest: expected `bind`, `nodes` or the number of a frame"),
        ("{beyond: drop}", "needs `limit`"),
        ("{by: id, limit: 1}", "names the triangle itself"),
        ("{keep_length: true}", "is for `mode: blended`"),
        ("{mode: blended, keep_length: true}", ""),
        ("{limit: 0}", "a distance above 0"),
        ("{avoid_penetration: -1}", "a distance of at least 0"),
        ("{scale: 0}", "a finite number above 0"),
        ("{matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}", ""),
        ("{matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 0], [0, 0, 0, 1]]}", "determinant 0"),
        ("{matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 1, 1]]}", "the last [0, 0, 0, 1]"),
        (
            "{scale: 2, matrix: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]}",
            "contradicts `scale`",
        ),
    ] {
        let all = found(&format!("{GOOD}mesh: {{file: '{mesh}'}}\nbind: {bind}\n"));
        match words {
            "" => assert_eq!(all, Vec::<String>::new(), "{bind}"),
            _ => assert!(all.len() == 1 && all[0].contains(words), "{bind}: {all:?}"),
        }
    }
}

#[test]
fn a_file_that_is_not_there_is_told_with_the_one_that_may_be_meant() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["curly.hair", "sky.hdr"] {
        std::fs::write(folder.path().join(name), "").unwrap();
    }
    std::fs::create_dir(folder.path().join("curlz.hair")).unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    let all = found(&format!(
        "version: 1\ngroom: {{file: '{}'}}\nlights: {{environment: {{file: '{}'}}}}\n",
        at("curlx.hair"),
        at("mountain.hdr"),
    ));
    assert_eq!(all.len(), 2, "{all:#?}");
    assert!(all[0].ends_with(", did you mean `curly.hair`?"), "{all:#?}");
    assert!(all[1].contains("mountain.hdr") && !all[1].contains("did you mean"), "{all:#?}");
}
