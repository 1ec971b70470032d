//! "Did you mean": the known name nearest to a mistyped one.

/// The member of `known` with the fewest edits to `name`, if those are few enough to be a slip.
///
/// ```
/// assert_eq!(strict_yaml::nearest("widht", ["width", "height"]), Some("width"));
/// assert_eq!(strict_yaml::nearest("colour", ["width", "height"]), None);
/// ```
#[must_use]
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let slip = (name.chars().count() / 3).max(2);
    known
        .into_iter()
        .map(|candidate| (distance(name, candidate), candidate))
        .filter(|&(edits, candidate)| edits <= slip && edits < candidate.chars().count())
        .min()
        .map(|(_, candidate)| candidate)
}

/// Edits between two names: letters added, dropped, changed or swapped with their neighbour (the
/// restricted Damerau-Levenshtein distance); letter case and `-` or space for `_` are no edits.
fn distance(a: &str, b: &str) -> usize {
    let letters = |s: &str| -> Vec<char> {
        s.chars().map(|c| if matches!(c, '-' | ' ') { '_' } else { c.to_ascii_lowercase() }).collect()
    };
    let (a, b) = (letters(a), letters(b));
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let changed = usize::from(a[i - 1] != b[j - 1]);
            let mut edits = (rows[i - 1][j] + 1).min(row[j - 1] + 1).min(rows[i - 1][j - 1] + changed);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                edits = edits.min(rows[i - 2][j - 2] + 1);
            }
            row.push(edits);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_understood_and_strangers_are_not() {
        let known = ["width", "height", "spp", "seed", "max_bounces", "melanin"];
        for (name, expect) in [
            ("widht", Some("width")),
            ("Width", Some("width")),
            ("hight", Some("height")),
            ("sp", Some("spp")),
            ("max-bounces", Some("max_bounces")),
            ("bounces", None),
            ("melanine", Some("melanin")),
            ("xyz", None),
            ("", None),
        ] {
            assert_eq!(nearest(name, known), expect, "{name}");
        }
    }
}
