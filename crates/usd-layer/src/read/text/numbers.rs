//! Decimal numbers, quickly and to the nearest: as OpenUSD, to 64 bits first.

use half::f16;

use crate::Scalar;

/// Powers of ten that 64-bit floats hold exactly.
const EXACT: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
    1e19, 1e20, 1e21, 1e22,
];

/// The number at the start of the bytes and how many of them it takes.
#[inline]
pub(super) fn float(bytes: &[u8]) -> Option<(f64, usize)> {
    let mut at = 0;
    let negative = matches!(bytes.first(), Some(b'-'));
    at += usize::from(negative || matches!(bytes.first(), Some(b'+')));
    let (mut mantissa, mut digits, mut exponent) = (0_u64, 0_usize, 0_i32);
    while let Some(&byte @ b'0'..=b'9') = bytes.get(at) {
        mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
        digits += 1;
        at += 1;
    }
    if bytes.get(at) == Some(&b'.') {
        at += 1;
        while let Some(&byte @ b'0'..=b'9') = bytes.get(at) {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(byte - b'0'));
            digits += 1;
            exponent -= 1;
            at += 1;
        }
    }
    if digits == 0 {
        return special(bytes, at, negative);
    }
    if let Some(b'e' | b'E') = bytes.get(at) {
        let sign = matches!(bytes.get(at + 1), Some(b'-' | b'+'));
        let first = at + 1 + usize::from(sign);
        let count = bytes[first.min(bytes.len())..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        if count > 0 {
            let written = bytes[first..first + count].iter();
            let value =
                written.fold(0_i32, |v, &byte| v.saturating_mul(10).saturating_add(i32::from(byte - b'0')));
            exponent = exponent.saturating_add(if bytes[at + 1] == b'-' { -value } else { value });
            at = first + count;
        }
    }
    // 15 digits and a power of ten up to 22 are exact, and so one operation rounds once.
    let power = EXACT.get(exponent.unsigned_abs() as usize);
    let value = match power {
        Some(power) if digits <= 15 => {
            let mantissa = mantissa as f64;
            let value = if exponent < 0 { mantissa / power } else { mantissa * power };
            if negative { -value } else { value }
        }
        _ => std::str::from_utf8(&bytes[..at]).ok()?.parse().ok()?,
    };
    Some((value, at))
}

fn special(bytes: &[u8], at: usize, negative: bool) -> Option<(f64, usize)> {
    let value = match bytes.get(at..at + 3)? {
        b"inf" => f64::INFINITY,
        b"nan" => f64::NAN,
        _ => return None,
    };
    Some((if negative { -value } else { value }, at + 3))
}

/// What is left of a number in a type: a `half` or `float` is rounded to it.
#[inline]
pub(super) fn rounded(value: f64, scalar: Scalar) -> f64 {
    match scalar {
        Scalar::Float => (value as f32).into(),
        Scalar::Half => f16::from_f32(value as f32).into(),
        _ => value,
    }
}

/// The whole number at the start of the bytes and how many of them it takes.
#[inline]
pub(super) fn integer(bytes: &[u8]) -> Option<(i64, usize)> {
    let negative = matches!(bytes.first(), Some(b'-'));
    let mut at = usize::from(negative || matches!(bytes.first(), Some(b'+')));
    let first = at;
    let mut value = 0_u64;
    while let Some(&byte @ b'0'..=b'9') = bytes.get(at) {
        value = value.checked_mul(10)?.checked_add(u64::from(byte - b'0'))?;
        at += 1;
    }
    if at == first {
        return None;
    }
    let value = if negative { 0_i64.checked_sub_unsigned(value)? } else { i64::try_from(value).ok()? };
    Some((value, at))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_the_nearest() {
        for text in [
            "0",
            "-0",
            "1",
            "0.1",
            ".5",
            "5.",
            "1e3",
            "-1.5E-7",
            "123456789012345678",
            "1e22",
            "1e23",
            "4.9e-324",
            "1.7976931348623157e308",
            "9007199254740993",
            "0.30000000000000004",
            "1e400",
            "70.9341",
        ] {
            let expected: f64 = text.parse().unwrap();
            let (value, len) = float(text.as_bytes()).unwrap();
            assert_eq!((value.to_bits(), len), (expected.to_bits(), text.len()), "{text}");
        }
        assert!(float(b"nan").unwrap().0.is_nan());
        assert_eq!(float(b"-inf,"), Some((f64::NEG_INFINITY, 4)));
        assert_eq!(float(b"1e,"), Some((1.0, 1)));
        for wrong in ["", "-", ".", "e5", "x", "in"] {
            assert_eq!(float(wrong.as_bytes()), None, "{wrong}");
        }
        assert_eq!(integer(b"-9223372036854775808"), Some((i64::MIN, 20)));
        assert_eq!(integer(b"9223372036854775808"), None);
        assert_eq!(integer(b"12.5"), Some((12, 2)));
    }
}
