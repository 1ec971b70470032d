//! Ranges and files a pipeline names: what its types alone cannot say.

use std::path::Path;

use groom_formats::Format;
use hair_render::Aov;
use strict_yaml::{Fault, locate, nearest};

use crate::outputs::sheet_layout;
use crate::schema::{Attributes, EnvironmentSource, Pipeline};
use crate::stage::material;

/// A picture of more pixels than this is taken for a slip: it would need gigabytes.
const MOST_PIXELS: u64 = 1 << 28;

/// Collects faults by key.
struct Check<'a> {
    base: &'a Path,
    found: Vec<(String, String)>,
}

/// Everything wrong with `pipeline`, which was read from `text` in `file`.
pub(crate) fn faults(pipeline: &Pipeline, file: &Path, text: &str) -> Vec<Fault> {
    let base = file.parent().unwrap_or(Path::new(""));
    let mut check = Check { base, found: Vec::new() };
    check.groom(pipeline);
    check.attributes(&pipeline.attributes);
    check.outputs(pipeline);
    check.found.extend(material::faults(&pipeline.material, base));
    check.lights(pipeline);
    check.views(pipeline);
    let in_text = |(key, message): (String, String)| {
        let path: Vec<&str> = key.split('.').collect();
        let place = locate(text, &path).map(|p| (p.line, p.column));
        Fault { file: file.to_owned(), place, key, message }
    };
    check.found.into_iter().map(in_text).collect()
}

impl Check<'_> {
    fn fault(&mut self, key: impl Into<String>, message: impl Into<String>) {
        self.found.push((key.into(), message.into()));
    }

    fn need(&mut self, good: bool, key: &str, found: impl std::fmt::Debug, expected: &str) {
        if !good {
            self.fault(key, format!("is {found:?}, expected {expected}"));
        }
    }

    fn file(&mut self, key: &str, path: &Path) {
        let full = self.base.join(path);
        match std::fs::metadata(&full) {
            Ok(data) if data.is_file() => {}
            Ok(_) => self.fault(key, format!("`{}` is no file", full.display())),
            Err(error) => self.fault(key, format!("no file at `{}` ({error})", full.display())),
        }
    }

    fn mesh_file(&mut self, path: &Path) {
        const KNOWN: [&str; 3] = ["obj", "gltf", "glb"];
        self.file("mesh.file", path);
        if !path.extension().is_some_and(|e| KNOWN.iter().any(|k| e.eq_ignore_ascii_case(k))) {
            let (path, known) = (path.display(), KNOWN.join(", ."));
            self.fault("mesh.file", format!("`{path}` has no ending that can be read (.{known})"));
        }
    }

    fn point(&mut self, key: &str, point: [f64; 3]) {
        self.need(point.iter().all(|v| v.is_finite()), key, point, "three finite numbers");
    }

    fn color(&mut self, key: &str, color: Option<[f32; 3]>, most: f32) {
        let good = color.is_none_or(|c| c.iter().all(|v| (0.0..=most).contains(v) && v.is_finite()));
        let expected =
            if most == 1.0 { "three numbers in 0..1" } else { "three finite numbers of at least 0" };
        self.need(good, key, color.unwrap_or_default(), expected);
    }

    fn groom(&mut self, pipeline: &Pipeline) {
        match pipeline.version {
            Some(1) => {}
            Some(other) => self.fault("version", format!("is {other}; this program reads version 1")),
            None => self.fault("version", "is missing; write `version: 1`"),
        }
        let groom = &pipeline.groom;
        match (&groom.file, &groom.sample) {
            (Some(file), None) => {
                self.file("groom.file", file);
                if !Format::from_path(file).is_some_and(Format::can_read) {
                    self.fault("groom.file", format!("`{}` has no ending that can be read", file.display()));
                }
            }
            (None, Some(sample)) => {
                // With these the generator's own limits (2^24 strands, fewer than 2^32 points) hold.
                let (strands, points) = (sample.strands, sample.points);
                self.need((1..=4_000_000).contains(&strands), "groom.sample.strands", strands, "1..=4000000");
                self.need((3..=1000).contains(&points), "groom.sample.points", points, "3..=1000");
            }
            (Some(_), Some(_)) => self.fault("groom", "has both `file` and `sample`; keep one"),
            (None, None) => self.fault("groom", "needs `file: PATH` or `sample: {...}`"),
        }
        self.unit("groom.meters_per_unit", groom.meters_per_unit);
        if let Some(mesh) = &pipeline.mesh {
            if mesh.file.as_os_str().is_empty() {
                self.fault("mesh", "needs `file: PATH`");
            } else {
                self.mesh_file(&mesh.file);
            }
            self.color("mesh.albedo", Some(mesh.albedo), 1.0);
            self.unit("mesh.meters_per_unit", mesh.meters_per_unit);
        }
    }

    fn attributes(&mut self, attributes: &Attributes) {
        self.need(attributes.stride != Some(0), "attributes.stride", 0, "at least 1");
        self.need(attributes.max_strands != Some(0), "attributes.max_strands", 0, "at least 1");
        self.unit("attributes.scale", attributes.scale.map(f64::from));
        self.color("attributes.color", attributes.color, 1.0);
        if let Some([root, tip]) = attributes.color_ramp {
            self.color("attributes.color_ramp.0", Some(root), 1.0);
            self.color("attributes.color_ramp.1", Some(tip), 1.0);
        }
        if attributes.color.is_some() && attributes.color_ramp.is_some() {
            self.fault("attributes.color_ramp", "contradicts `color`; keep one");
        }
        if let Some(stops) = attributes.color_variation {
            self.need((0.0..=8.0).contains(&stops), "attributes.color_variation", stops, "0..8 stops");
            if attributes.color.is_none() {
                self.fault("attributes.color_variation", "needs `color` beside it");
            }
        }
        let width = |w: f32| w >= 0.0 && w.is_finite();
        self.need(
            attributes.width.is_none_or(width),
            "attributes.width",
            attributes.width.unwrap_or_default(),
            "a diameter of at least 0",
        );
        let ramp = attributes.width_ramp;
        self.need(
            ramp.is_none_or(|r| r.into_iter().all(width)),
            "attributes.width_ramp",
            ramp.unwrap_or_default(),
            "two diameters of at least 0",
        );
        if attributes.width.is_some() && ramp.is_some() {
            self.fault("attributes.width_ramp", "contradicts `width`; keep one");
        }
    }

    fn unit(&mut self, key: &str, value: Option<f64>) {
        self.need(
            value.is_none_or(|v| v > 0.0 && v.is_finite()),
            key,
            value.unwrap_or_default(),
            "a finite number above 0",
        );
    }

    fn outputs(&mut self, pipeline: &Pipeline) {
        let sheet = pipeline.sheet.as_ref().map(|s| ("sheet.file".to_owned(), s.file.as_path()));
        let convert =
            pipeline.convert.iter().enumerate().map(|(i, path)| (format!("convert.{i}"), path.as_path()));
        let mut seen: Vec<&Path> = Vec::new();
        for (key, path) in convert.chain(sheet) {
            let shown = path.display();
            // An output that climbs out of its folder would overwrite what the pipeline does not own.
            let inside = path.components().all(|c| matches!(c, std::path::Component::Normal(_)));
            if !inside || path.as_os_str().is_empty() {
                self.fault(&*key, format!("`{shown}` must be a path inside the output folder"));
            }
            if key == "sheet.file" {
                let png = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("png"));
                self.need(png, &key, shown.to_string(), "a name that ends in .png");
            } else if !Format::from_path(path).is_some_and(Format::can_write) {
                let known: Vec<&str> =
                    Format::ALL.into_iter().filter(|f| f.can_write()).map(Format::name).collect();
                self.fault(
                    &*key,
                    format!("`{shown}` has no ending that can be written (.{})", known.join(", .")),
                );
            }
            if seen.contains(&path) {
                self.fault(&*key, format!("`{shown}` is made twice"));
            }
            seen.push(path);
        }
        if let Some(sheet) = &pipeline.sheet {
            self.need(sheet.columns != Some(0), "sheet.columns", 0, "at least 1");
            self.need(sheet.gap <= 1024, "sheet.gap", sheet.gap, "at most 1024 pixels");
            let (width, height) = sheet_layout(sheet, &pipeline.render).size(pipeline.turntable.frames);
            self.pixels("sheet", width, height);
        }
    }

    fn lights(&mut self, pipeline: &Pipeline) {
        let lights = &pipeline.lights;
        if let Some(environment) = &lights.environment {
            self.environment(environment);
        }
        for (i, area) in lights.area.iter().enumerate() {
            let key = |name: &str| format!("lights.area.{i}.{name}");
            self.color(&key("radiance"), Some(area.radiance), f32::MAX);
            self.point(&key("position"), area.position);
            self.point(&key("target"), area.target);
            let size = area.size.iter().all(|&s| s > 0.0 && s.is_finite());
            self.need(size, &key("size"), area.size, "two lengths above 0");
            self.need(
                area.position != area.target,
                &key("target"),
                area.target,
                "a point away from the position",
            );
        }
        if lights.environment.is_none() && lights.area.is_empty() {
            self.fault("lights", "holds nothing that shines; add `environment: {studio: true}`");
        }
    }

    fn pixels(&mut self, key: &str, width: u64, height: u64) {
        if width.saturating_mul(height) > MOST_PIXELS {
            self.fault(key, format!("is {width} x {height} pixels, expected at most {MOST_PIXELS} in all"));
        }
    }

    fn environment(&mut self, environment: &EnvironmentSource) {
        let EnvironmentSource { file, constant, studio, rotation, intensity } = environment;
        let kinds = [file.is_some(), constant.is_some(), *studio].into_iter().filter(|&k| k).count();
        if kinds != 1 {
            self.fault("lights.environment", "needs one of `file`, `constant`, `studio: true`");
        }
        if let Some(file) = file {
            self.file("lights.environment.file", file);
        }
        self.color("lights.environment.constant", *constant, f32::MAX);
        self.need(rotation.is_finite(), "lights.environment.rotation", rotation, "an angle in degrees");
        let good = *intensity >= 0.0 && intensity.is_finite();
        self.need(good, "lights.environment.intensity", intensity, "a finite factor of at least 0");
    }

    fn views(&mut self, pipeline: &Pipeline) {
        let camera = &pipeline.camera;
        self.need(
            camera.fov > 0.0 && camera.fov < 180.0,
            "camera.fov",
            camera.fov,
            "above 0, below 180 degrees",
        );
        self.need(camera.elevation.abs() <= 90.0, "camera.elevation", camera.elevation, "-90..90 degrees");
        self.unit("camera.distance", camera.distance);
        self.unit("camera.zoom", Some(camera.zoom));
        self.point("camera.target", camera.target.unwrap_or_default());
        let turn = &pipeline.turntable;
        self.need((1..=9999).contains(&turn.frames), "turntable.frames", turn.frames, "1..=9999");
        self.need(turn.start.is_finite(), "turntable.start", turn.start, "an angle in degrees");
        self.need(turn.degrees.abs() <= 360.0, "turntable.degrees", turn.degrees, "-360..360 degrees");
        let render = &pipeline.render;
        for (key, size) in [("render.width", render.width), ("render.height", render.height)] {
            self.need((1..=65_536).contains(&size), key, size, "1..=65536 pixels");
        }
        self.pixels("render", u64::from(render.width), u64::from(render.height));
        self.need(render.spp >= 1, "render.spp", render.spp, "at least 1");
        for (i, name) in render.aovs.iter().enumerate() {
            if Aov::from_name(name).is_none() && !name.eq_ignore_ascii_case("all") {
                let known = Aov::ALL.map(Aov::name);
                let meant = nearest(name, known).map_or_else(
                    || format!("expected one of {}, all", known.join(", ")),
                    |meant| format!("did you mean `{meant}`?"),
                );
                self.fault(format!("render.aovs.{i}"), format!("unknown pass `{name}`, {meant}"));
            }
        }
        let exposure = pipeline.tone.exposure;
        self.need(exposure.abs() <= 64.0, "tone.exposure", exposure, "-64..64 stops");
        self.color("tone.background", Some(pipeline.tone.background), 1.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Vec<String> {
        let pipeline = crate::expand::yaml::parse(text).unwrap();
        faults(&pipeline, Path::new("turn.yaml"), text).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn samples_that_cannot_be_grown_are_refused() {
        let with = |sample: &str| found(&GOOD.replace("sample: {}", &format!("sample: {{{sample}}}")));
        assert!(
            with("points: 2")[0].starts_with("turn.yaml:2:26: groom.sample.points: is 2, expected 3..=1000")
        );
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
        let text = "version: 2\ngroom:\n  file: no/such.hair\nrender:\n  spp: 0\n  aovs: [R, TTR]\ncamera: {fov: 200}\n";
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
        ] {
            let all = found(&format!("{GOOD}{more}"));
            assert!(all.len() == 1 && all[0].contains(words), "{more}: {all:?}");
        }
    }
}
