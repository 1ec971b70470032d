//! What several of these tests need.

use std::fmt::Write as _;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use glam::DVec3;
use moving_mesh::{MeshError, MeshOptions, MovingMesh, Pose};
use usd_core::UsdCoreError;

/// A file or folder of other people's, when it is there.
pub fn data(below: &str) -> Option<PathBuf> {
    let root = std::env::var_os("GROOMKIT_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from);
    let path = root.join(below);
    if !path.exists() {
        skipped(&format!("{below} is not in $GROOMKIT_DATA"));
        return None;
    }
    Some(path)
}

/// Says that a test was left out; not by `eprintln!`, which the test harness hides.
pub fn skipped(why: &str) {
    let _ = writeln!(std::io::stderr(), "skipped: {why}");
}

pub fn glb(json: &[u8], binary: &[u8]) -> Vec<u8> {
    let padded = |bytes: &[u8], pad: u8| {
        let mut bytes = bytes.to_vec();
        bytes.resize(bytes.len().next_multiple_of(4), pad);
        bytes
    };
    let (json, binary) = (padded(json, b' '), padded(binary, 0));
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let word = |n: usize| (n as u32).to_le_bytes().to_vec();
    [b"glTF".to_vec(), word(2), word(length), word(json.len()), b"JSON".to_vec(), json]
        .into_iter()
        .chain([word(binary.len()), b"BIN\0".to_vec(), binary])
        .collect::<Vec<_>>()
        .concat()
}

/// A mesh from the bytes of a file of that name.
pub fn open_as(name: &str, bytes: &[u8], options: &MeshOptions) -> Result<MovingMesh, MeshError> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    fs::write(&path, bytes).unwrap();
    MovingMesh::open(&path, options)
}

/// As [`open_as`], of a file that needs usd-core; nothing where that is not installed.
pub fn open_as_or_skip(name: &str, bytes: &[u8], options: &MeshOptions) -> Option<MovingMesh> {
    match open_as(name, bytes, options) {
        Err(MeshError::UsdCore { source: UsdCoreError::Missing { .. }, .. }) => {
            skipped("usd-core is not installed");
            None
        }
        mesh => Some(mesh.unwrap()),
    }
}

/// The length of the diagonal of the box around a pose.
pub fn size(pose: &Pose) -> f64 {
    let low = pose.positions.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = pose.positions.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    (high - low).length()
}

/// Positions of the corners of all triangles.
pub fn corners<'a>(mesh: &'a MovingMesh, pose: &'a Pose) -> impl Iterator<Item = DVec3> + 'a {
    mesh.triangles().iter().flatten().map(|&vertex| pose.positions[vertex as usize])
}

/// A glTF document in the making: its accessors and their bytes.
#[derive(Default)]
pub struct Gltf {
    accessors: Vec<String>,
    views: Vec<String>,
    pub bytes: Vec<u8>,
}

impl Gltf {
    /// Bytes that something is read from; the number of their view.
    pub fn view(&mut self, bytes: &[u8]) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.views.push(format!(
            r#"{{"buffer":0,"byteOffset":{},"byteLength":{}}}"#,
            self.bytes.len(),
            bytes.len()
        ));
        self.bytes.extend(bytes);
        self.views.len() - 1
    }

    /// An accessor of floats; its number.
    pub fn floats(&mut self, kind: &str, values: &[f32]) -> usize {
        let width = ["SCALAR", "VEC2", "VEC3", "VEC4", "MAT4"].iter().position(|k| *k == kind).unwrap();
        let count = values.len() / [1, 2, 3, 4, 16][width];
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let view = self.view(&bytes);
        self.accessor(&format!(r#""bufferView":{view},"componentType":5126,"count":{count},"type":"{kind}""#))
    }

    /// An accessor as its text says; its number.
    pub fn accessor(&mut self, text: &str) -> usize {
        self.accessors.push(format!("{{{text}}}"));
        self.accessors.len() - 1
    }

    /// The file, with these further members of the document.
    pub fn file(&self, members: &str) -> Vec<u8> {
        let mut json = String::from(r#"{"asset":{"version":"2.0"},"#);
        write!(json, r#""accessors":[{}],"#, self.accessors.join(",")).unwrap();
        write!(json, r#""bufferViews":[{}],"#, self.views.join(",")).unwrap();
        write!(json, r#""buffers":[{{"byteLength":{}}}],{members}}}"#, self.bytes.len()).unwrap();
        glb(json.as_bytes(), &self.bytes)
    }
}
