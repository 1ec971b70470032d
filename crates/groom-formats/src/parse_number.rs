//! Text as 32-bit numbers, rounded as exactly as the standard library does it and several times as fast.

/// Digits that fit the 53 bits a 64-bit float counts exactly.
const DIGITS: usize = 15;

/// Powers of ten that are 64-bit floats, as all up to 10^22 are.
const POWERS: [f64; DIGITS + 1] =
    [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15];

/// The number that `word` is, by the rules of [`str::parse`]; `None` when it is none.
#[inline]
pub(crate) fn parse_f32(word: &[u8]) -> Option<f32> {
    plain(word).or_else(|| std::str::from_utf8(word).ok()?.parse().ok())
}

/// A number of up to 15 digits, perhaps with a sign and a point; `None` for others and for those where
/// rounding twice is not rounding once.
///
/// The digits and the power of ten are exact in 64 bits, so their quotient is the number rounded once
/// (Clinger 1990). Rounding that to 32 bits is right unless it lies in the middle between two 32-bit
/// numbers, where the first rounding may have hidden on which side the number is.
#[inline]
fn plain(word: &[u8]) -> Option<f32> {
    const MIDDLE: u64 = 1 << 28;
    let (negative, unsigned) = match word {
        [b'-', rest @ ..] => (true, rest),
        _ => (false, word),
    };
    let (mut digits, mut whole, mut after_point) = (0_u64, 0, None);
    for &byte in unsigned.get(..unsigned.len().min(DIGITS + 2))? {
        match byte {
            b'0'..=b'9' => {
                digits = digits * 10 + u64::from(byte - b'0');
                whole += 1;
                after_point = after_point.map(|count: usize| count + 1);
            }
            b'.' if after_point.is_none() => after_point = Some(0),
            _ => return None,
        }
    }
    let is_short = (1..=DIGITS).contains(&whole) && unsigned.len() < DIGITS + 2;
    let power = POWERS.get(after_point.unwrap_or(0)).filter(|_| is_short)?;
    let value = digits as f64 / power;
    let hides_a_side = value.to_bits() & (2 * MIDDLE - 1) == MIDDLE;
    if hides_a_side || (value != 0.0 && value < f64::from(f32::MIN_POSITIVE)) {
        return None;
    }
    Some(if negative { -(value as f32) } else { value as f32 })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn check(word: &str) {
        let (ours, theirs) = (parse_f32(word.as_bytes()), word.parse::<f32>().ok());
        assert_eq!(ours.map(f32::to_bits), theirs.map(f32::to_bits), "{word}");
    }

    #[test]
    fn words_that_are_numbers_and_words_that_are_not() {
        for word in [
            "",
            "-",
            "+",
            ".",
            "-.",
            "1.",
            ".5",
            "-0",
            "0",
            "+1",
            "1e5",
            "1E-5",
            "0x1",
            "1.2.3",
            "1-",
            "--1",
            "nan",
            "inf",
            "000000000000000000001",
            "123456789012345",
            "1234567890123456",
            "99999999999999.9",
            "0.00000000000001",
            "999999999999999",
            "16777217",
            "16777219",
            "33554433.5",
            "0.1",
            "1_0",
            "1 ",
        ] {
            check(word);
        }
        assert_eq!(parse_f32(b"\xff"), None);
        assert_eq!(plain(b"16777217"), None, "in the middle");
        assert_eq!(plain(b"16777218.5"), Some(16_777_218.0));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn shortest_texts(bits in any::<u32>()) {
            check(&f32::from_bits(bits).to_string());
        }

        #[test]
        fn digits_and_points(word in "-?[0-9]{0,12}\\.?[0-9]{0,9}") {
            check(&word);
        }

        #[test]
        fn middles_and_beside(bits in 0x3000_0000_u32..0x5f00_0000, beside in -1_i64..=1) {
            let middle = (f64::from(f32::from_bits(bits)) + f64::from(f32::from_bits(bits + 1))) / 2.0;
            check(&f64::from_bits((middle.to_bits() as i64 + beside) as u64).to_string());
        }

        #[test]
        fn any_word(word in "[-+.0-9eEinfa]{0,8}") {
            check(&word);
        }
    }
}
