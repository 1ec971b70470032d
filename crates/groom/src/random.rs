//! Random numbers that belong to a strand.

/// A random number in `[0, 1)` that depends on nothing but `seed`, the strand's `id` and what it is for.
///
/// The same arguments give the same number on every machine, for any order of calls and any number
/// of threads, so that a strand keeps its random length when the groom is subsampled. The bits come
/// from SplitMix64's finaliser (Steele, Lea, Flood: Fast Splittable Pseudorandom Number Generators,
/// OOPSLA 2014) over an FNV-1a hash of `purpose`; the value is a multiple of 2^-24.
///
/// ```
/// let length = groom::random(7, 42, "length");
/// assert_eq!(length, groom::random(7, 42, "length"));
/// assert_ne!(length, groom::random(7, 42, "colour"));
/// ```
#[must_use]
pub fn random(seed: u64, id: u32, purpose: &str) -> f32 {
    let hash = purpose.bytes().fold(0xcbf2_9ce4_8422_2325, |hash: u64, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    let bits = mix(mix(mix(seed) ^ hash) ^ u64::from(id));
    (bits >> 40) as f32 / (1_u32 << 24) as f32
}

fn mix(state: u64) -> u64 {
    let z = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNT: u32 = 100_000;

    #[test]
    fn numbers_fill_the_interval_evenly() {
        for (seed, purpose) in [(0, ""), (1, "length"), (u64::MAX, "colour")] {
            let mut bins = [0_u32; 64];
            for id in 0..COUNT {
                let value = random(seed, id, purpose);
                assert!((0.0..1.0).contains(&value));
                bins[(value * 64.0) as usize] += 1;
            }
            let mean = f64::from(COUNT) / 64.0;
            let chi2: f64 = bins.iter().map(|&n| (f64::from(n) - mean).powi(2) / mean).sum();
            // 63 degrees of freedom: outside this range one time in 10^5.
            assert!((26.0..120.0).contains(&chi2), "chi2 {chi2}");
        }
    }

    #[test]
    fn neighbours_seeds_and_purposes_are_independent() {
        let correlation = |other: &dyn Fn(u32) -> f32| {
            let products =
                (0..COUNT).map(|id| (f64::from(random(3, id, "a")) - 0.5) * (f64::from(other(id)) - 0.5));
            products.sum::<f64>() / f64::from(COUNT) * 12.0
        };
        // The standard deviation of the estimate is 1 / sqrt(COUNT) = 0.0032.
        for value in [
            correlation(&|id| random(3, id + 1, "a")),
            correlation(&|id| random(4, id, "a")),
            correlation(&|id| random(3, id, "b")),
        ] {
            assert!(value.abs() < 0.015, "{value}");
        }
    }

    #[test]
    fn numbers_never_change() {
        // Written down once: grooms in the world depend on them.
        let known: Vec<u32> = (0..3).map(|id| random(1, id, "length").to_bits()).collect();
        assert_eq!(known, KNOWN);
    }

    const KNOWN: [u32; 3] = [1_057_834_499, 1_055_684_238, 1_048_433_212];
}
