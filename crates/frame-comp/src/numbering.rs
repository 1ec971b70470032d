//! Names of outputs that keep the numbers of their inputs.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use crate::CompError;

/// An output for each of `frames`: `pattern` with its `#`s replaced by the frame's number, which is the last digits
/// in its name, and padded with zeros to as many places (`out.####.png` for `frame.0012.exr` is `out.0012.png`).
///
/// # Errors
/// [`CompError::Naming`] for several frames without `#` in the pattern, a frame without number, two that share one,
/// and outputs that are among the frames.
pub fn outputs(frames: &[PathBuf], pattern: &Path) -> Result<Vec<PathBuf>, CompError> {
    let fault = |path: &Path, reason: String| CompError::Naming { path: path.to_owned(), reason };
    let name = pattern.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let places = name.chars().filter(|&c| c == '#').count();
    let together = name.contains(&"#".repeat(places));
    if places == 0 && frames.len() > 1 {
        return Err(fault(pattern, format!("names one file for {} frames; say out.####.png", frames.len())));
    }
    if !together {
        return Err(fault(pattern, "has `#` in two places; one is for the number".into()));
    }
    let inputs: BTreeSet<PathBuf> = frames.iter().filter_map(|frame| frame.canonicalize().ok()).collect();
    let mut named = Vec::new();
    let mut seen = BTreeSet::new();
    for frame in frames {
        let output = if places == 0 {
            pattern.to_owned()
        } else {
            let Some(number) = number_in(frame) else {
                return Err(fault(frame, "has no number in its name to take the place of `#`".into()));
            };
            pattern.with_file_name(name.replace(&"#".repeat(places), &format!("{number:0>places$}")))
        };
        if output.canonicalize().is_ok_and(|output| inputs.contains(&output)) {
            return Err(fault(&output, "is one of the frames; it would be written over".into()));
        }
        if !seen.insert(output.clone()) {
            return Err(fault(&output, "would be written twice: two frames have the same number".into()));
        }
        named.push(output);
    }
    Ok(named)
}

/// The last digits in a file's name before its ending, without leading zeros.
fn number_in(path: &Path) -> Option<String> {
    let stem = path.file_stem()?.to_string_lossy().into_owned();
    let end = stem.rfind(|c: char| c.is_ascii_digit())? + 1;
    let start = stem[..end]
        .rfind(|c: char| !c.is_ascii_digit())
        .map_or(0, |at| at + stem[at..].chars().next().map_or(1, char::len_utf8));
    let digits = stem[start..end].trim_start_matches('0');
    Some(if digits.is_empty() { "0".to_owned() } else { digits.to_owned() })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(frames: &[&str], pattern: &str) -> Result<Vec<String>, String> {
        let frames: Vec<PathBuf> = frames.iter().map(PathBuf::from).collect();
        let outputs = outputs(&frames, Path::new(pattern)).map_err(|e| e.to_string())?;
        Ok(outputs.iter().map(|path| path.to_string_lossy().into_owned()).collect())
    }

    #[test]
    fn numbers_are_kept() {
        let two = ["a/frame.0001.exr", "a/frame.0012.exr"];
        assert_eq!(named(&two, "b/out.####.png").unwrap(), ["b/out.0001.png", "b/out.0012.png"]);
        assert_eq!(named(&two, "o#.png").unwrap(), ["o1.png", "o12.png"]);
        assert_eq!(named(&["x.exr"], "out.png").unwrap(), ["out.png"]);
        assert_eq!(named(&["take2_\u{e9}0100b.exr"], "##.png").unwrap(), ["100.png"]);
        assert_eq!(named(&["f.0000.exr"], "##.png").unwrap(), ["00.png"]);
    }

    #[test]
    fn what_has_no_number_is_refused() {
        for (frames, pattern, words) in [
            (&["a1.exr", "a2.exr"][..], "out.png", "####"),
            (&["a1.exr", "b1.exr"], "out.#.png", "twice"),
            (&["a.exr"], "out.#.png", "no number"),
            (&["a1.exr"], "#.#.png", "two places"),
        ] {
            let error = named(frames, pattern).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("f.0001.exr");
        std::fs::write(&path, b"x").unwrap();
        let error = outputs(&[path], &folder.path().join("f.####.exr")).unwrap_err();
        assert!(error.to_string().contains("written over"), "{error}");
    }
}
