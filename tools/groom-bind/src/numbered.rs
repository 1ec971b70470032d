//! `name.####.hair`: a file a frame.

use std::path::{Path, PathBuf};

/// A path whose name has a place for the number of a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Numbered {
    pattern: PathBuf,
    before: String,
    width: usize,
    after: String,
}

impl Numbered {
    /// `None` unless the name has a run of `#`; the last one counts.
    pub(crate) fn of(path: &Path) -> Option<Numbered> {
        let name = path.file_name()?.to_str()?;
        let end = name.rfind('#')? + 1;
        let before = name[..end].trim_end_matches('#');
        Some(Numbered {
            pattern: path.to_owned(),
            before: before.to_owned(),
            width: end - before.len(),
            after: name[end..].to_owned(),
        })
    }

    /// The file of a frame: its number with as many digits as there are `#`, or more where it needs them.
    pub(crate) fn at(&self, frame: i64) -> PathBuf {
        let sign = if frame < 0 { "-" } else { "" };
        let (digits, width) = (frame.unsigned_abs(), self.width);
        self.pattern.with_file_name(format!("{}{sign}{digits:0width$}{}", self.before, self.after))
    }

    /// Whether a file of this name is one of them.
    pub(crate) fn matches(&self, name: &str) -> bool {
        let number = name.strip_prefix(&self.before).and_then(|rest| rest.strip_suffix(&self.after));
        let digits = number.map(|number| number.strip_prefix('-').unwrap_or(number));
        digits.is_some_and(|d| d.len() >= self.width && d.bytes().all(|b| b.is_ascii_digit()))
    }

    pub(crate) fn pattern(&self) -> &Path {
        &self.pattern
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_padded() {
        let numbered = Numbered::of(Path::new("a/b#.####.hair")).unwrap();
        assert_eq!(numbered.at(7), Path::new("a/b#.0007.hair"));
        assert_eq!(numbered.at(-7), Path::new("a/b#.-0007.hair"));
        assert_eq!(numbered.at(12345), Path::new("a/b#.12345.hair"));
        assert!(numbered.matches("b#.-0007.hair") && !numbered.matches("b#.007.hair"));
        assert_eq!(Numbered::of(Path::new("##/b.hair")), None);
    }
}
