//! Texts that hold names of variables.

/// A part of a text.
#[derive(Debug, PartialEq)]
pub(crate) enum Piece<'t> {
    Plain(&'t str),
    Variable(&'t str),
}

/// The pieces of a text: `${name}` is a variable, `$${` a plain `${`.
pub(crate) fn pieces(text: &str) -> Result<Vec<Piece<'_>>, String> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while let Some(at) = rest.find("${") {
        let (before, from) = rest.split_at(at);
        let after = from.strip_prefix("${").unwrap_or_default();
        if let Some(before) = before.strip_suffix('$') {
            pieces.extend([Piece::Plain(before), Piece::Plain("${")]);
            rest = after;
            continue;
        }
        let (name, after) =
            after.split_once('}').ok_or("a `${` without its `}`; a plain one is written `$${`")?;
        if !is_name(name) {
            return Err(format!("`${{{name}}}` holds no name: letters, digits, `_` and `-`"));
        }
        pieces.extend([Piece::Plain(before), Piece::Variable(name)]);
        rest = after;
    }
    pieces.push(Piece::Plain(rest));
    pieces.retain(|piece| *piece != Piece::Plain(""));
    Ok(pieces)
}

pub(crate) fn is_name(name: &str) -> bool {
    let letters = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    name.chars().all(letters) && name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn dollars_and_names_are_told_apart() {
        use Piece::{Plain, Variable};
        for (text, expect) in [
            ("", vec![]),
            ("plain $5 }", vec![Plain("plain $5 }")]),
            ("${a}", vec![Variable("a")]),
            ("x${a-1}${_b}.exr", vec![Plain("x"), Variable("a-1"), Variable("_b"), Plain(".exr")]),
            ("$${a}", vec![Plain("${"), Plain("a}")]),
            ("$$${a}", vec![Plain("$"), Plain("${"), Plain("a}")]),
            ("$${${a}", vec![Plain("${"), Variable("a")]),
        ] {
            assert_eq!(pieces(text).unwrap(), expect, "{text}");
        }
        for text in ["${", "${a", "${}", "${a b}", "${1}", "x ${a.b}"] {
            assert!(pieces(text).is_err(), "{text}");
        }
    }
}
