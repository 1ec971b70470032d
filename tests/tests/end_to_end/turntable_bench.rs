//! Small turntables in folders of their own, and what must come of them.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

use end_to_end_tests::program;
use exr::prelude::{ReadChannels as _, ReadLayers as _};

/// A frame's digest and all its channels, or any other file's bytes.
#[derive(PartialEq, Eq)]
pub enum Content {
    Frame { digest: String, pixels: Vec<u8> },
    Bytes(Vec<u8>),
}

/// Converted files, three frames and a sheet, made in no time.
pub const SMALL: &str = "version: 1
groom: {sample: {style: wavy, strands: 40, points: 6}}
convert: [groom.txt, groom.hair]
lights: {environment: {constant: [1, 0.9, 0.8]}}
turntable: {frames: 3}
render: {width: 16, height: 16, spp: 2, max_bounces: 4, aovs: [R]}
sheet: {columns: 3, gap: 2}
";

/// The frames of [`SMALL`].
pub const FRAMES: [&str; 3] = ["frames/frame.0001.exr", "frames/frame.0002.exr", "frames/frame.0003.exr"];

/// A pipeline in a folder of its own.
pub struct Bench {
    pub folder: tempfile::TempDir,
}

/// [`SMALL`] in a folder of its own.
pub fn small() -> Bench {
    Bench::new(SMALL)
}

impl Bench {
    pub fn new(pipeline: &str) -> Bench {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("turn.yaml"), pipeline).unwrap();
        Bench { folder }
    }

    pub fn pipeline(&self) -> PathBuf {
        self.folder.path().join("turn.yaml")
    }

    pub fn out(&self) -> PathBuf {
        self.folder.path().join("out")
    }

    pub fn command(&self, more: &[&str]) -> Command {
        let mut command = Command::new(program("turntable"));
        command.arg(self.pipeline()).arg("--out").arg(self.out()).args(more);
        command
    }

    /// Runs to the end, which must be a good one.
    pub fn make(&self, more: &[&str]) {
        self.made(more);
    }

    /// Runs to the end and returns the names of the files made, the report left out.
    pub fn made(&self, more: &[&str]) -> Vec<String> {
        let output = self.command(&[more, &["--json"]].concat()).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        let summary: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let names = summary["made"].as_array().unwrap().iter().map(|v| v.as_str().unwrap().to_owned());
        names.filter(|name| !name.starts_with("report.")).collect()
    }
}

/// Every file below `out` that must be the same whenever the pipeline is: not the reports, the page and the manifest,
/// which tell of seconds.
pub fn contents(out: &Path) -> BTreeMap<PathBuf, Content> {
    let tells_of_seconds =
        |path: &Path| matches!(path.extension().and_then(|e| e.to_str()), Some("json" | "jsonl" | "html"));
    let files = files_below(out).into_iter().filter(|path| !tells_of_seconds(path));
    files.map(|path| (path.strip_prefix(out).unwrap().to_owned(), content(&path).unwrap())).collect()
}

/// Says which files are not as they should be; silent when all are.
pub fn assert_same(found: &BTreeMap<PathBuf, Content>, wanted: &BTreeMap<PathBuf, Content>) {
    let names: Vec<_> = found.keys().chain(wanted.keys()).collect();
    let other: Vec<_> = names.iter().filter(|name| found.get(**name) != wanted.get(**name)).collect();
    assert!(other.is_empty(), "other bits than an undisturbed run's, or not in both: {other:?}");
}

pub fn content(path: &Path) -> Result<Content, String> {
    if path.extension().is_some_and(|e| e == "exr") {
        return frame(path);
    }
    std::fs::read(path).map(Content::Bytes).map_err(|error| error.to_string())
}

/// Reads the whole of a frame.
fn frame(path: &Path) -> Result<Content, String> {
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_file(path)
        .map_err(|error| error.to_string())?;
    let layer = &image.layer_data;
    let attribute = |name: &str| {
        let text = exr::prelude::Text::from(name);
        let own = layer.attributes.other.get(&text).or_else(|| image.attributes.other.get(&text));
        own.map(|value| format!("{value:?}"))
    };
    let channels = layer.channel_data.list.iter();
    let pixels = channels
        .flat_map(|c| c.sample_data.values_as_f32().flat_map(|v| v.to_bits().to_le_bytes()))
        .collect();
    Ok(Content::Frame { digest: attribute("digest").unwrap_or_default(), pixels })
}

/// Every file below a folder, those with hidden names too.
pub fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() { folders.push(path) } else { found.push(path) }
        }
    }
    found.sort();
    found
}

pub fn is_hidden(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name.to_string_lossy().starts_with('.'))
}
