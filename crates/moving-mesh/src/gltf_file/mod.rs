//! glTF 2.0, its bytes checked by `gltf-bytes`.

mod rest_pose;

use std::path::Path;

use gltf_bytes::{Asset, GltfError};

use crate::TriangleMesh;
use crate::error::Fault;

/// Reads the default scene in its rest pose.
pub(crate) fn read(path: &Path) -> Result<TriangleMesh, Fault> {
    let bytes = std::fs::read(path).map_err(|source| Fault::Io { path: path.to_owned(), source })?;
    let asset = Asset::open(&bytes, path.parent())?;
    rest_pose::mesh(&asset)
}

impl From<GltfError> for Fault {
    fn from(error: GltfError) -> Self {
        match error {
            GltfError::Invalid { place, found, expected } => {
                Fault::invalid(place, format!("{found}, expected {expected}"))
            }
            GltfError::Unsupported { what, remedy } => Fault::Unsupported { what, remedy },
            GltfError::Io { path, source } => Fault::Io { path, source },
            other => Fault::invalid("glTF", other.to_string()),
        }
    }
}
