//! The YAML library's messages in the words of somebody who writes the file.

use crate::nearest::nearest;

/// A message in plain words, with the right name of a mistyped one.
pub(crate) fn plain(text: &str) -> String {
    unknown(text)
        .or_else(|| doubled(text))
        .or_else(|| mistaken(text))
        .or_else(|| counted(text))
        .unwrap_or_else(|| text.to_owned())
}

fn unknown(text: &str) -> Option<String> {
    let (at, kind) = match (text.find("unknown field `"), text.find("unknown variant `")) {
        (Some(at), _) => (at, "key"),
        (None, at) => (at?, "word"),
    };
    let (before, rest) = text.split_at(at);
    let mut quoted = rest.split('`').skip(1).step_by(2);
    let unknown = quoted.next().unwrap_or_default();
    let known: Vec<&str> = quoted.collect();
    Some(match nearest(unknown, known.iter().copied()) {
        Some(meant) => format!("{before}unknown {kind} `{unknown}`, did you mean `{meant}`?"),
        None => format!("{before}unknown {kind} `{unknown}`, expected one of `{}`", known.join("`, `")),
    })
}

fn doubled(text: &str) -> Option<String> {
    let (before, key) = text.split_once("duplicate field ")?;
    Some(format!("{before}the key {key} is there twice"))
}

/// A list of the wrong length.
fn counted(text: &str) -> Option<String> {
    let (before, rest) = text.split_once("invalid length ")?;
    let (found, expected) = rest.split_once(", expected ")?;
    let count =
        |words: &str| words.split(|c: char| !c.is_ascii_digit()).rfind(|d| !d.is_empty()).map(str::to_owned);
    let expected = count(expected).unwrap_or_else(|| expected.to_owned());
    Some(format!("{before}is a list of {found}, expected {expected} entries"))
}

/// A value of the wrong type or size: the library names Rust's types.
fn mistaken(text: &str) -> Option<String> {
    let kinds = ["invalid type: ", "invalid value: "];
    let (before, rest) = kinds.into_iter().find_map(|kind| text.split_once(kind))?;
    let (found, expected) = rest.rsplit_once(", expected ")?;
    let found = [
        ("unit value", "empty"),
        ("map", "keys and values"),
        ("sequence", "a list"),
        ("string ", "text "),
        ("boolean ", "a yes-or-no "),
        ("integer ", "a whole number "),
        ("floating point ", "a number "),
    ]
    .into_iter()
    .find_map(|(theirs, ours)| Some(format!("{ours}{}", found.strip_prefix(theirs)?)))
    .unwrap_or_else(|| found.to_owned());
    let expected = match expected {
        "u32" => "a whole number in 0..=4294967295",
        "u64" | "usize" => "a whole number of at least 0",
        "f32" | "f64" => "a number",
        "a boolean" => "true or false",
        "a string" => "text",
        "path string" => "a path",
        "a sequence" => "a list",
        "field identifier" => "a key",
        "a map" => "keys and values",
        _ if expected.starts_with("an array of length ") || expected.starts_with("a tuple of size ") => {
            "a list"
        }
        _ if expected.starts_with("struct ") => "keys and values",
        _ => expected,
    };
    Some(format!("{before}is {found}, expected {expected}"))
}
