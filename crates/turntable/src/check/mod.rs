//! What a pipeline's types alone cannot say: ranges, files that are not there, keys that disagree.
//!
//! A file for each section. Every fault is a key, as `render.spp`, with words; where it was written is
//! `expand`'s to know.

mod camera;
mod comp;
mod groom;
mod lights;
mod motion;
mod outputs;
mod render;

use std::path::Path;

use hair_render::Aov;
use strict_yaml::nearest;

use crate::schema::Pipeline;
use crate::stage::material;

/// A picture of more pixels than this is taken for a slip: it would need gigabytes.
const MOST_PIXELS: u64 = 1 << 28;

/// Collects faults by key.
struct Check<'a> {
    base: &'a Path,
    found: Vec<(String, String)>,
}

/// Everything wrong with `pipeline`, whose paths count from `base`: keys and words.
pub(crate) fn faults(pipeline: &Pipeline, base: &Path) -> Vec<(String, String)> {
    let mut check = Check { base, found: Vec::new() };
    check.version(pipeline.version);
    check.groom(&pipeline.groom, pipeline.mesh.is_some());
    check.mesh(pipeline.mesh.as_ref());
    check.attributes(&pipeline.attributes);
    check.bind(pipeline);
    check.motion(pipeline);
    check.outputs(pipeline);
    check.found.extend(material::faults(&pipeline.material, base));
    check.lights(&pipeline.lights);
    check.camera(&pipeline.camera);
    check.render(pipeline);
    check.comp(pipeline);
    check.found
}

/// Words for a picture of too many pixels.
pub(crate) fn too_many_pixels(width: u64, height: u64) -> Option<String> {
    let too_many = width.saturating_mul(height) > MOST_PIXELS;
    too_many.then(|| format!("is {width} x {height} pixels, expected at most {MOST_PIXELS} in all"))
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

    fn version(&mut self, version: Option<u32>) {
        match version {
            Some(1) => {}
            Some(other) => self.fault("version", format!("is {other}; this program reads version 1")),
            None => self.fault("version", "is missing; write `version: 1`"),
        }
    }

    /// A file that is read has to be there.
    fn file(&mut self, key: &str, path: &Path) {
        let full = self.base.join(path);
        match std::fs::metadata(&full) {
            Ok(data) if data.is_file() => {}
            Ok(_) => self.fault(key, format!("`{}` is no file", full.display())),
            Err(error) => {
                let meant = neighbour(&full).map(|name| format!(", did you mean `{name}`?"));
                let (shown, meant) = (full.display(), meant.unwrap_or_default());
                self.fault(key, format!("no file at `{shown}` ({error}){meant}"));
            }
        }
    }

    /// A file name has to end in one of `known`.
    fn ending(&mut self, key: &str, path: &Path, known: &[&str]) {
        if !path.extension().is_some_and(|e| known.iter().any(|k| e.eq_ignore_ascii_case(k))) {
            let (path, known) = (path.display(), known.join(", ."));
            self.fault(key, format!("`{path}` has no ending that can be read (.{known})"));
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

    /// A finite number above 0, where there is one.
    fn unit(&mut self, key: &str, value: Option<f64>) {
        self.above_zero(key, value, "a finite number above 0");
    }

    fn above_zero(&mut self, key: &str, value: Option<f64>, expected: &str) {
        let good = value.is_none_or(|v| v > 0.0 && v.is_finite());
        self.need(good, key, value.unwrap_or_default(), expected);
    }

    fn factor(&mut self, key: &str, value: f64) {
        self.need(value >= 0.0 && value.is_finite(), key, value, "a finite factor of at least 0");
    }

    fn pixels(&mut self, key: &str, width: u64, height: u64) {
        if let Some(words) = too_many_pixels(width, height) {
            self.fault(key, words);
        }
    }

    /// The pass called `name`; a fault where there is none.
    fn pass(&mut self, key: &str, name: &str) -> Option<Aov> {
        let pass = Aov::from_name(name);
        if pass.is_none() {
            let known = Aov::ALL.map(Aov::name);
            let meant = nearest(name, known).map_or_else(
                || format!("expected one of {}, all", known.join(", ")),
                |meant| format!("did you mean `{meant}`?"),
            );
            self.fault(key, format!("unknown pass `{name}`, {meant}"));
        }
        pass
    }
}

/// The file of the same folder that may have been meant.
fn neighbour(full: &Path) -> Option<String> {
    let name = full.file_name()?.to_str()?;
    let folder = full.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let there = std::fs::read_dir(folder).ok()?.flatten().filter(|entry| entry.path().is_file());
    let names: Vec<String> = there.filter_map(|entry| entry.file_name().into_string().ok()).collect();
    nearest(name, names.iter().map(String::as_str)).map(str::to_owned)
}

#[cfg(test)]
mod tests;
