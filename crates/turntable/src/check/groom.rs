//! Where strands and mesh come from, and what is changed of the strands.

use std::path::Path;

use groom_formats::Format;

use super::Check;
use crate::schema::{Attributes, GroomSource, MeshSource, SampleSource, Style};

/// What meshes are read from.
const MESHES: [&str; 7] = ["obj", "gltf", "glb", "usd", "usda", "usdc", "usdz"];

impl Check<'_> {
    pub(super) fn groom(&mut self, groom: &GroomSource, has_mesh: bool) {
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
                self.fur(sample, has_mesh);
            }
            (Some(_), Some(_)) => self.fault("groom", "has both `file` and `sample`; keep one"),
            (None, None) => self.fault("groom", "needs `file: PATH` or `sample: {...}`"),
        }
        self.unit("groom.meters_per_unit", groom.meters_per_unit);
    }

    fn fur(&mut self, sample: &SampleSource, has_mesh: bool) {
        let is_fur = sample.style == Style::Fur;
        if is_fur && !has_mesh {
            self.fault("groom.sample.style", "is `fur`, which grows on a `mesh`; there is none");
        }
        let keys = [
            ("length", sample.length),
            ("lean", sample.lean),
            ("curl", sample.curl),
            ("clump", sample.clump),
        ];
        for (name, value) in keys.into_iter().filter_map(|(name, value)| Some((name, value?))) {
            let key = format!("groom.sample.{name}");
            if !is_fur {
                self.fault(&*key, "is for `style: fur`");
            }
            let good = (0.0..=1.0).contains(&value) && (name != "length" || value > 0.0);
            let range = if name == "length" { "over 0, up to 1" } else { "0..1" };
            self.need(good, &key, value, range);
        }
    }

    pub(super) fn mesh(&mut self, mesh: Option<&MeshSource>) {
        let Some(mesh) = mesh else { return };
        if mesh.file.as_os_str().is_empty() {
            self.fault("mesh", "needs `file: PATH`");
        } else {
            self.mesh_file(&mesh.file);
            let gltf = mesh
                .file
                .extension()
                .is_some_and(|e| ["gltf", "glb"].iter().any(|g| e.eq_ignore_ascii_case(g)));
            if mesh.animation.is_some() && !gltf {
                self.fault("mesh.animation", "is for glTF files, which may hold several");
            }
        }
        self.color("mesh.albedo", Some(mesh.albedo), 1.0);
        self.unit("mesh.meters_per_unit", mesh.meters_per_unit);
    }

    fn mesh_file(&mut self, path: &Path) {
        let full = self.base.join(path);
        let name = full.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if name.contains('#') && !full.exists() {
            if !has_sequence(&full, &name) {
                let words = format!("no file of the sequence `{}` is there", full.display());
                self.fault("mesh.file", words);
            }
        } else {
            self.file("mesh.file", path);
        }
        self.ending("mesh.file", path, &MESHES);
    }

    pub(super) fn attributes(&mut self, attributes: &Attributes) {
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
}

/// Whether a file is there whose name has digits where `name` has `#`.
fn has_sequence(full: &Path, name: &str) -> bool {
    let (before, rest) = name.split_once('#').unwrap_or((name, ""));
    let after = rest.trim_start_matches('#');
    let folder = full.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let fits = |entry: std::fs::DirEntry| {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let number = name.strip_prefix(before).and_then(|rest| rest.strip_suffix(after));
        number.is_some_and(|n| !n.is_empty() && n.bytes().all(|b| b.is_ascii_digit()))
    };
    std::fs::read_dir(folder).into_iter().flatten().flatten().any(fits)
}
