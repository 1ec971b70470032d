//! Numbers of 16 bits (IEEE 754 binary16), as bits.

/// Bits of a half's fraction, and of a float's beyond them.
const FRACTION: u32 = 10;
const MORE: u32 = 23 - FRACTION;
/// Bits of the smallest float that is no subnormal half, 2^-14, and of the first that is none at all, 65520.
const SMALLEST: u32 = (127 - 14) << 23;
const TOO_LARGE: u32 = 0x477f_f000;

/// The nearest half, ties to even; infinity from 65520 on.
pub(super) fn from_f32(value: f32) -> u16 {
    let bits = value.to_bits();
    let sign = (bits >> 16 & 0x8000) as u16;
    let size = bits & 0x7fff_ffff;
    if value.is_nan() {
        return sign | 0x7e00;
    }
    if size >= TOO_LARGE {
        return sign | 0x7c00;
    }
    if size < SMALLEST {
        // Steps of 2^-24: adding a number whose last bit is one of them rounds.
        let steps = (f32::from_bits(size) + 0.5).to_bits() - 0.5_f32.to_bits();
        return sign | steps as u16;
    }
    // Half of what is cut off, and a bit less where the number below is even.
    let even = size >> MORE & 1;
    let rounded = size + ((1 << (MORE - 1)) - 1) + even;
    sign | (rounded.wrapping_sub((127 - 15) << 23) >> MORE) as u16
}

/// The number that the bits of a half stand for.
pub(super) fn to_f32(bits: u16) -> f32 {
    let sign = if bits & 0x8000 == 0 { 1.0 } else { -1.0 };
    let (exponent, fraction) = (u32::from(bits >> 10 & 31), u32::from(bits & 0x3ff));
    let size = match exponent {
        0 => fraction as f32 * 2.0_f32.powi(-24),
        31 if fraction == 0 => f32::INFINITY,
        31 => f32::NAN,
        _ => f32::from_bits((exponent + 127 - 15) << 23 | fraction << MORE),
    };
    sign * size
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_half_is_its_own_nearest_and_numbers_between_go_to_the_nearer() {
        for bits in 0..=u16::MAX {
            let value = to_f32(bits);
            if value.is_nan() {
                assert!(to_f32(from_f32(value)).is_nan());
                continue;
            }
            assert_eq!(from_f32(value), bits, "{value}");
            let next = to_f32(bits.wrapping_add(1));
            if bits & 0x7fff < 0x7bff {
                let middle = 0.5 * (value + next);
                let even = if bits & 1 == 0 { bits } else { bits + 1 };
                assert_eq!(from_f32(middle), even, "between {value} and {next}");
                let beyond = middle + (next - middle) * 1e-3;
                assert_eq!(from_f32(beyond), bits + 1, "behind the middle of {value} and {next}");
            }
        }
        assert_eq!((from_f32(65519.0), from_f32(65520.0), from_f32(-1e9)), (0x7bff, 0x7c00, 0xfc00));
    }
}
