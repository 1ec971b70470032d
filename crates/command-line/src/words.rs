//! The command line this program was started with, and words for whoever started it.

use std::env;
use std::ffi::OsStr;
use std::io::Write;

/// The words of the command line, quoted where a shell would ask for it, so that it can be given again.
/// Names that are not Unicode are written as well as can be.
#[must_use]
pub fn words() -> String {
    env::args_os().map(|word| quoted(&word)).collect::<Vec<_>>().join(" ")
}

/// Says a line on stderr.
pub fn say(line: &str) {
    // `eprintln!` would panic when nobody reads stderr any more.
    let _ = writeln!(std::io::stderr(), "{line}");
}

fn quoted(word: &OsStr) -> String {
    let word = word.to_string_lossy();
    let plain = |c: char| c.is_alphanumeric() || "-_./,:=+@%".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.into_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_only_where_a_shell_needs_it() {
        for (word, expected) in [
            ("a/b-c.hair", "a/b-c.hair"),
            ("", "''"),
            ("my hair", "'my hair'"),
            ("it's", r"'it'\''s'"),
            ("髪.hair", "髪.hair"),
        ] {
            assert_eq!(quoted(OsStr::new(word)), expected);
        }
    }
}
