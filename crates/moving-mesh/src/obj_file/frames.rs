//! The files of a sequence.

use std::path::{Path, PathBuf};

use crate::error::Fault;

/// Numbers and files that `pattern` stands for, by number: the one run of `#` in its name is the place of the
/// digits, and as many as there must be at least, filled up with zeros.
///
/// # Errors
/// A folder that cannot be read, no such file, or files whose numbers are not evenly spaced.
pub(super) fn find(pattern: &Path) -> Result<Vec<(u32, PathBuf)>, Fault> {
    let name = pattern.file_name().unwrap_or_default().to_string_lossy();
    let width = name.chars().filter(|&c| c == '#').count();
    let Some((before, after)) = name.split_once(&"#".repeat(width)) else {
        return Err(Fault::invalid("name", "several places with `#`, expected one, as in name.####.obj"));
    };
    let folder = pattern.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let io = |source| Fault::Io { path: folder.to_owned(), source };
    let mut frames = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(io)? {
        let path = entry.map_err(io)?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let digits = name.strip_prefix(before).and_then(|rest| rest.strip_suffix(after));
        if let Some(number) = digits.and_then(|digits| number(digits, width)) {
            frames.push((number, path));
        }
    }
    frames.sort();
    if frames.is_empty() {
        return Err(Fault::invalid(
            "name",
            format!("no file in {} has this name with digits for `#`", folder.display()),
        ));
    }
    let step = frames.windows(2).map(|pair| pair[1].0 - pair[0].0).min().unwrap_or(1);
    if let Some(pair) = frames.windows(2).find(|pair| pair[1].0 - pair[0].0 != step) {
        let (last, next, missing) = (pair[0].0, pair[1].0, pair[0].0 + step);
        let fault = format!("missing between {last} and {next}, expected every frame or every n-th");
        return Err(Fault::invalid(format!("frame {missing}"), fault));
    }
    Ok(frames)
}

fn number(digits: &str, width: usize) -> Option<u32> {
    let as_written = digits.len() == width || digits.len() > width && !digits.starts_with('0');
    let all_digits = digits.bytes().all(|byte| byte.is_ascii_digit());
    (as_written && all_digits).then(|| digits.parse().ok()).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(names: &[&str], pattern: &str) -> Result<Vec<u32>, String> {
        let folder = tempfile::tempdir().unwrap();
        for name in names {
            std::fs::write(folder.path().join(name), "").unwrap();
        }
        match find(&folder.path().join(pattern)) {
            Ok(frames) => Ok(frames.into_iter().map(|(number, _)| number).collect()),
            Err(Fault::Invalid { place, fault }) => Err(format!("{place}: {fault}")),
            Err(other) => Err(format!("{other:?}")),
        }
    }

    #[test]
    fn files_are_found_by_their_digits() {
        let names =
            ["a.0098.obj", "a.0100.obj", "a.0099.obj", "a.99.obj", "a.x100.obj", "b.0001.obj", "a.0101.mtl"];
        assert_eq!(found(&names, "a.####.obj"), Ok(vec![98, 99, 100]));
        assert_eq!(found(&["a9.obj", "a10.obj", "a011.obj"], "a#.obj"), Ok(vec![9, 10]));
        assert_eq!(found(&["a.2.obj", "a.6.obj", "a.4.obj"], "a.#.obj"), Ok(vec![2, 4, 6]));
    }

    #[test]
    fn what_is_no_sequence_is_told() {
        let told = |names: &[&str], pattern| found(names, pattern).unwrap_err();
        assert!(
            told(&["a.1.obj", "a.2.obj", "a.4.obj"], "a.#.obj")
                .starts_with("frame 3: missing between 2 and 4")
        );
        assert!(told(&["a.obj"], "a.##.obj").contains("no file in"));
        assert!(told(&["a.1.1.obj"], "a.#.#.obj").contains("several places with `#`"));
        assert!(told(&["a.99999999999.obj"], "a.#.obj").contains("no file in"));
    }
}
