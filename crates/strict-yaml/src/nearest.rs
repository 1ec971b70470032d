//! "Did you mean": the known name nearest to a mistyped one.

/// What is longer is no name, and would take long to compare.
const LONGEST: usize = 64;

/// The member of `known` with the fewest edits to `name`, if those are few enough to be a slip.
///
/// ```
/// assert_eq!(strict_yaml::nearest("widht", ["width", "height"]), Some("width"));
/// assert_eq!(strict_yaml::nearest("colour", ["width", "height"]), None);
/// ```
#[must_use]
pub fn nearest<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let name = letters(name);
    if name.len() > LONGEST {
        return None;
    }
    let slip = (name.len() / 3).max(2);
    let mut rows = Rows::default();
    let edits = |candidate: &'a str| {
        let known = letters(candidate);
        let near = known.len().abs_diff(name.len()) <= slip;
        let edits = near.then(|| rows.distance(&name, &known))?;
        (edits <= slip && edits < known.len()).then_some((edits, candidate))
    };
    known.into_iter().filter_map(edits).min().map(|(_, candidate)| candidate)
}

/// What is compared of a name: letter case and `-` or space for `_` are no edits.
fn letters(name: &str) -> Vec<char> {
    name.chars().map(|c| if matches!(c, '-' | ' ') { '_' } else { c.to_ascii_lowercase() }).collect()
}

/// The last rows of a table of edits, kept from one comparison to the next.
#[derive(Default)]
struct Rows {
    before: Vec<usize>,
    last: Vec<usize>,
    row: Vec<usize>,
}

impl Rows {
    /// Edits between two names: letters added, dropped, changed or swapped with their neighbour (the restricted
    /// Damerau-Levenshtein distance).
    fn distance(&mut self, a: &[char], b: &[char]) -> usize {
        let Rows { before, last, row } = self;
        row.clear();
        row.extend(0..=b.len());
        for i in 1..=a.len() {
            std::mem::swap(before, last);
            std::mem::swap(last, row);
            row.clear();
            row.push(i);
            for j in 1..=b.len() {
                let changed = usize::from(a[i - 1] != b[j - 1]);
                let mut edits = (last[j] + 1).min(row[j - 1] + 1).min(last[j - 1] + changed);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    edits = edits.min(before[j - 2] + 1);
                }
                row.push(edits);
            }
        }
        row[b.len()]
    }
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
            (&"width".repeat(100_000), None),
        ] {
            assert_eq!(nearest(name, known), expect, "{name}");
        }
    }
}
