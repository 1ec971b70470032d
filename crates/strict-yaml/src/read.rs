//! YAML to a struct.

use serde::de::DeserializeOwned;

use crate::fault::{Place, YamlFault, place_of};
use crate::{twins, words};

/// Reads a `T`; keys are refused where `T` refuses them (`serde(deny_unknown_fields)`).
///
/// An empty text is a `T` that says nothing: the default.
///
/// # Errors
/// A [`YamlFault`] with the place of whatever is no YAML, twice there, of another type or unknown; an
/// unknown key comes with the name that may have been meant.
pub fn parse<T: DeserializeOwned + Default>(text: &str) -> Result<T, YamlFault> {
    if says_nothing(text) {
        return Ok(T::default());
    }
    check_nesting(text)?;
    let fault = |error: &serde_yaml::Error| YamlFault { place: place_of(error), message: in_words(error) };
    serde_yaml::from_str(text).map_err(|error| match twins::second_of_a_pair(text) {
        // The library places a doubled key at the beginning of the mapping it is in.
        Some(place) if error.to_string().contains("duplicate field") => {
            YamlFault { place: Some(place), ..fault(&error) }
        }
        _ => fault(&error),
    })
}

/// Whether there are only empty lines and remarks.
pub(crate) fn says_nothing(text: &str) -> bool {
    text.lines().all(|line| line.trim().is_empty() || line.trim_start().starts_with('#'))
}

/// The library's message without its place, which is told apart, in plain words.
pub(crate) fn in_words(error: &serde_yaml::Error) -> String {
    let full = error.to_string();
    let cut = full.rfind(" at line ").filter(|_| error.location().is_some());
    words::plain(&full[..cut.unwrap_or(full.len())])
}

/// Brackets deeper than this are an attack: the library takes quadratic time for them.
const DEEPEST: usize = 128;

/// Counts brackets; those of remarks, which often leave one open, `[0, 1)`, do not count.
pub(crate) fn check_nesting(text: &str) -> Result<(), YamlFault> {
    let mut depth = 0_usize;
    for (index, line) in text.lines().enumerate() {
        for (column, c) in before_remark(line).chars().enumerate() {
            match c {
                '[' | '{' => depth += 1,
                ']' | '}' => depth = depth.saturating_sub(1),
                _ => {}
            }
            if depth > DEEPEST {
                let place = Some(Place { line: index + 1, column: column + 1 });
                return Err(YamlFault { place, message: format!("more than {DEEPEST} brackets are open") });
            }
        }
    }
    Ok(())
}

/// A line as far as its remark, where it is certain that it has one: where there is a quote in it, `#` may stand in
/// a text that ends further on.
fn before_remark(line: &str) -> &str {
    if line.contains(['"', '\'']) {
        return line;
    }
    let begins = |(at, _): &(usize, &str)| {
        line.get(..*at).is_some_and(|before| !before.ends_with(|c: char| !c.is_whitespace()))
    };
    line.match_indices('#').find(begins).and_then(|(at, _)| line.get(..at)).unwrap_or(line)
}
