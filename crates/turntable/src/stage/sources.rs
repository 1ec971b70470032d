//! The files that a file named in a pipeline stands for.

use std::path::{Path, PathBuf};

use crate::TurntableError;

/// The files of a mesh: the frames of a sequence (`walk.####.obj`), the buffers of a glTF document beside it, else the
/// one it is.
pub(super) fn of_mesh(path: &Path) -> Result<Vec<PathBuf>, TurntableError> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    if name.contains('#') {
        return sequence(path, &name);
    }
    let mut files = vec![path.to_owned()];
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("gltf")) {
        files.extend(buffers(path)?);
    }
    Ok(files)
}

fn sequence(path: &Path, name: &str) -> Result<Vec<PathBuf>, TurntableError> {
    let parent = path.parent().filter(|parent| !parent.as_os_str().is_empty());
    let folder = parent.unwrap_or(Path::new("."));
    let (before, rest) = name.split_at(name.find('#').unwrap_or_default());
    let after = rest.trim_start_matches('#');
    let is_frame = |found: &str| {
        let number = found.strip_prefix(before).and_then(|found| found.strip_suffix(after));
        let number = number.map(|number| number.strip_prefix('-').unwrap_or(number));
        number.is_some_and(|number| !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()))
    };
    let entries = std::fs::read_dir(folder).map_err(|e| TurntableError::io(folder, "read", e))?;
    let names = entries.flatten().map(|entry| entry.file_name());
    let mut files: Vec<PathBuf> =
        names.filter(|found| is_frame(&found.to_string_lossy())).map(|found| folder.join(found)).collect();
    files.sort();
    Ok(files)
}

/// The buffers that a glTF document names; of one that cannot be understood its reader says what is wrong.
fn buffers(path: &Path) -> Result<Vec<PathBuf>, TurntableError> {
    let text = std::fs::read(path).map_err(|e| TurntableError::io(path, "read", e))?;
    let Ok(document) = serde_json::from_slice::<serde_json::Value>(&text) else { return Ok(Vec::new()) };
    let buffers = document.get("buffers").and_then(serde_json::Value::as_array);
    let names = buffers.into_iter().flatten().filter_map(|buffer| buffer.get("uri")?.as_str());
    let folder = path.parent().unwrap_or(Path::new(""));
    let files = names.filter(|uri| !uri.starts_with("data:")).map(|uri| folder.join(uri));
    // Names may be percent-encoded; their reader knows.
    Ok(files.filter(|file| file.is_file()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sequence_is_its_frames_and_a_document_its_buffers() {
        let folder = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
        for name in ["walk.0002.obj", "walk.0010.obj", "walk.obj", "walk.x.obj", "walk.0001.ply", "a.bin"] {
            write(name, "");
        }
        write("a.gltf", r#"{"buffers":[{"uri":"a.bin"},{"uri":"data:;base64,AA"},{"uri":"none.bin"}]}"#);
        let names = |name: &str| -> Vec<String> {
            let files = of_mesh(&folder.path().join(name)).unwrap();
            files.iter().map(|f| f.file_name().unwrap().to_string_lossy().into_owned()).collect()
        };
        assert_eq!(names("walk.####.obj"), ["walk.0002.obj", "walk.0010.obj"]);
        assert_eq!(names("a.gltf"), ["a.gltf", "a.bin"]);
        assert_eq!(names("walk.obj"), ["walk.obj"]);
    }
}
