//! Well-spread random numbers that depend on nothing but where they are used.
//!
//! Owen-scrambled Sobol' points, hashed: Burley 2020, "Practical Hash-based Owen Scrambling"
//! (Journal of Computer Graphics Techniques 9(4)), with Vegdahl's better mixing constants. Four
//! dimensions make a set; every set of every pixel is shuffled and scrambled by its own key, so sets
//! are independent of each other and well spread within.

/// The numbers of one sample of one pixel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Sampler {
    key: u64,
    index: u32,
}

impl Sampler {
    /// Sample `index` of the sequence that `seed`, the pixel and `half` choose.
    pub fn new(seed: u64, x: u32, y: u32, half: u32, index: u32) -> Self {
        let pixel = u64::from(x) | u64::from(y) << 32;
        Sampler { key: mix(mix(mix(seed) ^ pixel).wrapping_add(u64::from(half))), index }
    }

    /// Four numbers in [0, 1) of dimension set `set`.
    pub fn four(&self, set: u32) -> [f32; 4] {
        let key = mix(self.key ^ (u64::from(set) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let index = owen(self.index, key as u32);
        let seeds = mix(key);
        let others = mix(seeds);
        let seeds = [seeds as u32, (seeds >> 32) as u32, others as u32, (others >> 32) as u32];
        let points = sobol(index);
        std::array::from_fn(|d| unit(owen(points[d], seeds[d])))
    }

    /// One plain random number in [0, 1), for decisions too many to spread.
    pub fn plain(&self, set: u32, count: u32) -> f32 {
        let place = u64::from(set) << 32 | u64::from(count);
        unit((mix(mix(self.key ^ u64::from(self.index)).wrapping_add(place)) >> 32) as u32)
    }
}

fn unit(bits: u32) -> f32 {
    (bits >> 8) as f32 * (1.0 / 16_777_216.0)
}

/// The finaliser of SplitMix64.
fn mix(mut x: u64) -> u64 {
    x = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// Nested uniform (Owen) scrambling of a 32-bit fraction.
fn owen(x: u32, seed: u32) -> u32 {
    let mut x = x.reverse_bits();
    x ^= x.wrapping_mul(0x3d20_adea);
    x = x.wrapping_add(seed);
    x = x.wrapping_mul((seed >> 16) | 1);
    x ^= x.wrapping_mul(0x0552_6c56);
    x ^= x.wrapping_mul(0x53a2_2864);
    x.reverse_bits()
}

/// The first four Sobol' dimensions of point `index`.
fn sobol(index: u32) -> [u32; 4] {
    let bytes = index.to_le_bytes();
    let dimension = |d: usize| {
        let tables = &SOBOL[d];
        tables[0][bytes[0] as usize]
            ^ tables[1][bytes[1] as usize]
            ^ tables[2][bytes[2] as usize]
            ^ tables[3][bytes[3] as usize]
    };
    [index.reverse_bits(), dimension(0), dimension(1), dimension(2)]
}

/// Dimensions 2 to 4, one table a byte of the index.
static SOBOL: [[[u32; 256]; 4]; 3] = [
    byte_tables(directions(1, 0, [1, 0, 0])),
    byte_tables(directions(2, 1, [1, 3, 0])),
    byte_tables(directions(3, 1, [1, 3, 1])),
];

/// Direction numbers from Joe and Kuo's `new-joe-kuo-6.21201`: degree, polynomial, first m.
const fn directions(degree: usize, polynomial: u32, first: [u32; 3]) -> [u32; 32] {
    let mut v = [0u32; 32];
    let mut i = 0;
    while i < 32 {
        if i < degree {
            v[i] = first[i] << (31 - i);
        } else {
            let mut value = v[i - degree] ^ (v[i - degree] >> degree);
            let mut k = 1;
            while k < degree {
                if (polynomial >> (degree - 1 - k)) & 1 == 1 {
                    value ^= v[i - k];
                }
                k += 1;
            }
            v[i] = value;
        }
        i += 1;
    }
    v
}

const fn byte_tables(v: [u32; 32]) -> [[u32; 256]; 4] {
    let mut tables = [[0u32; 256]; 4];
    let mut byte = 0;
    while byte < 4 {
        let mut value = 0;
        while value < 256 {
            let mut bit = 0;
            while bit < 8 {
                if (value >> bit) & 1 == 1 {
                    tables[byte][value] ^= v[8 * byte + bit];
                }
                bit += 1;
            }
            value += 1;
        }
        byte += 1;
    }
    tables
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In how many of `2^a x 2^b = 256` boxes over dimensions i and j the first 256 points lie.
    fn boxes_filled(set: u32, (i, a): (usize, u32), (j, b): (usize, u32)) -> usize {
        let mut filled = std::collections::BTreeSet::new();
        for index in 0..256 {
            let p = Sampler::new(7, 3, 5, 0, index).four(set);
            filled.insert(((p[i] * (1 << a) as f32) as u32, (p[j] * (1 << b) as f32) as u32));
        }
        filled.len()
    }

    #[test]
    fn the_first_two_dimensions_fill_every_elementary_box() {
        for set in 0..20 {
            for a in 0..=8 {
                assert_eq!(boxes_filled(set, (0, a), (1, 8 - a)), 256, "set {set}, {a} bits");
            }
        }
    }

    #[test]
    fn every_dimension_is_stratified() {
        for d in 0..4 {
            assert_eq!(boxes_filled(9, (d, 8), (d, 0)), 256);
        }
        assert!(boxes_filled(9, (2, 4), (3, 4)) >= 64);
    }

    #[test]
    fn sets_halves_pixels_and_seeds_differ() {
        let base = Sampler::new(1, 2, 3, 0, 4);
        for other in [
            Sampler::new(2, 2, 3, 0, 4),
            Sampler::new(1, 3, 3, 0, 4),
            Sampler::new(1, 2, 4, 0, 4),
            Sampler::new(1, 2, 3, 1, 4),
            Sampler::new(1, 2, 3, 0, 5),
        ] {
            assert_ne!(base.four(0), other.four(0));
            assert_ne!(base.plain(0, 0), other.plain(0, 0));
        }
        assert_ne!(base.four(0), base.four(1));
    }

    #[test]
    fn two_sets_are_not_correlated() {
        let mut sum = 0.0f64;
        for pixel in 0..64 {
            for index in 0..64 {
                let s = Sampler::new(0, pixel, 0, 0, index);
                sum += f64::from(s.four(0)[0] - 0.5) * f64::from(s.four(1)[0] - 0.5);
            }
        }
        assert!((sum / 4096.0).abs() < 4.0 / 12.0 / 64.0);
    }

    /// Neighbours in the picture must not share their luck: a pattern would stand in the noise.
    #[test]
    fn neighbouring_pixels_are_not_correlated() {
        const EDGE: u32 = 64;
        let number = |x, y, d: usize, index| f64::from(Sampler::new(0, x, y, 0, index).four(2)[d]) - 0.5;
        for (right, down) in [(1, 0), (0, 1), (1, 1), (2, 0), (16, 0), (0, 16)] {
            for (d, e) in [(0, 0), (1, 1), (2, 2), (3, 3), (0, 1), (2, 3)] {
                let mut sum = 0.0;
                for place in 0..EDGE * EDGE {
                    let (x, y) = (place % EDGE, place / EDGE);
                    sum += number(x, y, d, 0) * number(x + right, y + down, e, 0);
                    sum += number(x, y, d, 1) * number(x + right, y + down, e, 1);
                }
                let correlation = 12.0 * sum / f64::from(2 * EDGE * EDGE);
                assert!(correlation.abs() < 5.0 / 90.0, "{right}, {down}, {d}, {e}: {correlation}");
            }
        }
    }

    /// Inside a pixel the four dimensions of a set, and those of different sets, must not go together.
    #[test]
    fn dimensions_are_not_correlated() {
        let mut sums = [[0.0f64; 8]; 8];
        for pixel in 0..512 {
            for index in 0..8 {
                let sampler = Sampler::new(3, pixel % 32, pixel / 32, 1, index);
                let [a, b] = [sampler.four(1), sampler.four(2)];
                let all: [f32; 8] = std::array::from_fn(|d| if d < 4 { a[d] } else { b[d - 4] } - 0.5);
                for (i, j) in (0..8).flat_map(|i| (0..i).map(move |j| (i, j))) {
                    sums[i][j] += f64::from(all[i] * all[j]);
                }
            }
        }
        for (i, j) in (0..8).flat_map(|i| (0..i).map(move |j| (i, j))) {
            let correlation = 12.0 * sums[i][j] / 4096.0;
            assert!(correlation.abs() < 5.0 / 64.0, "{i}, {j}: {correlation}");
        }
    }
}
