//! `name.####.hair`: a file a frame.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

/// The files of a sequence, in the order of their frames.
pub(crate) struct Sequence {
    pub(crate) files: Vec<(u64, PathBuf)>,
}

/// Whether a path stands for a sequence: its name has a run of `#` and no file is called so.
pub(crate) fn is_sequence(path: &Path) -> bool {
    split(path).is_some() && !path.exists()
}

/// Finds the files: the run of `#` stands for a number of at least as many digits.
pub(crate) fn find(pattern: &Path, wanted: Option<(u64, u64)>) -> Result<Sequence> {
    let Some((before, width, after)) = split(pattern) else { bail!("{}: no run of #", pattern.display()) };
    let folder = pattern.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).with_context(|| folder.display().to_string())? {
        let name = entry.with_context(|| folder.display().to_string())?.file_name();
        let digits = name.to_str().and_then(|name| name.strip_prefix(before)?.strip_suffix(after));
        let Some(digits) = digits.filter(|d| d.len() >= width && d.bytes().all(|b| b.is_ascii_digit()))
        else {
            continue;
        };
        // Written with more zeros than asked for, it would be a frame twice.
        let padded = digits.len() > width && digits.starts_with('0');
        if let (Ok(frame), false) = (digits.parse::<u64>(), padded) {
            files.push((frame, folder.join(name)));
        }
    }
    files.retain(|(frame, _)| wanted.is_none_or(|(first, last)| (first..=last).contains(frame)));
    files.sort();
    if files.is_empty() {
        bail!(
            "{}: no file of this sequence is there; # stands for digits, as in name.0001.hair",
            pattern.display()
        );
    }
    Ok(Sequence { files })
}

/// What stands before the last run of `#`, how long it is, and what stands behind it.
fn split(path: &Path) -> Option<(&str, usize, &str)> {
    let name = path.file_name()?.to_str()?;
    let end = name.rfind('#')? + 1;
    let start = name[..end].trim_end_matches('#').len();
    Some((&name[..start], end - start, &name[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_come_in_the_order_of_their_numbers() {
        let folder = tempfile::tempdir().unwrap();
        for name in ["a.0010.hair", "a.0002.hair", "a.12345.hair", "a.x.hair", "a.00001.hair", "b.0001.hair"]
        {
            fs::write(folder.path().join(name), b"").unwrap();
        }
        let pattern = folder.path().join("a.####.hair");
        assert!(is_sequence(&pattern) && !is_sequence(&folder.path().join("a.0010.hair")));
        let frames =
            |wanted| find(&pattern, wanted).unwrap().files.iter().map(|(f, _)| *f).collect::<Vec<_>>();
        assert_eq!(frames(None), [2, 10, 12345]);
        assert_eq!(frames(Some((3, 100))), [10]);
        assert!(find(&folder.path().join("c.#.hair"), None).is_err());
    }
}
