//! Lists of numbers as the value of an option.

/// `N` finite numbers, with commas or spaces between them.
#[must_use]
pub fn numbers<const N: usize>(text: &str) -> Option<[f64; N]> {
    let words = text.split([',', ' ']).filter(|word| !word.is_empty());
    let numbers: Vec<f64> = words.map(|word| word.parse().ok()).collect::<Option<_>>()?;
    <[f64; N]>::try_from(numbers).ok().filter(|numbers| numbers.iter().all(|n| n.is_finite()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_as_wanted_and_all_finite() {
        assert_eq!(numbers("1, -2 3e1"), Some([1.0, -2.0, 30.0]));
        for text in ["", "1,2", "1,2,3,4", "1,2,x", "1,2,inf"] {
            assert_eq!(numbers::<3>(text), None, "{text}");
        }
    }
}
