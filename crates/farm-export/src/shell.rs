//! Words as `sh` reads them.

/// `word` as one word of a POSIX shell: as it is where that is safe, else in single quotes.
///
/// ```
/// assert_eq!(farm_export::sh_quoted("frames/a-1.exr"), "frames/a-1.exr");
/// assert_eq!(farm_export::sh_quoted("it's $HOME"), r"'it'\''s $HOME'");
/// ```
#[must_use]
pub fn sh_quoted(word: &str) -> String {
    // No `=` (an assignment in front of a command), no `~`, `{` or `!`, nothing beyond ASCII: shells differ.
    let plain = |b: u8| b.is_ascii_alphanumeric() || b"-_./,:+@%".contains(&b);
    if !word.is_empty() && word.bytes().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', r"'\''"))
    }
}

/// A whole command.
pub(crate) fn sh_line<'a>(words: impl IntoIterator<Item = &'a String>) -> String {
    words.into_iter().map(|word| sh_quoted(word)).collect::<Vec<_>>().join(" ")
}
