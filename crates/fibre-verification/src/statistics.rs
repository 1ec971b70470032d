//! Moments and tests of significance.

/// Chance of a false alarm that a check allows itself: one in a thousand.
pub const SIGNIFICANCE: f64 = 1e-3;

/// Count, mean and spread, gathered one by one (Welford 1962) and joined (Chan et al. 1979).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Moments {
    /// How many.
    pub count: f64,
    /// Their mean.
    pub mean: f64,
    squares: f64,
}

impl Moments {
    /// Takes one more value in.
    pub fn push(&mut self, value: f64) {
        self.count += 1.0;
        let delta = value - self.mean;
        self.mean += delta / self.count;
        self.squares += delta * (value - self.mean);
    }

    /// Both together.
    #[must_use]
    pub fn joined(self, other: Moments) -> Moments {
        let count = self.count + other.count;
        if count == 0.0 {
            return self;
        }
        let delta = other.mean - self.mean;
        Moments {
            count,
            mean: self.mean + delta * other.count / count,
            squares: self.squares + other.squares + delta * delta * self.count * other.count / count,
        }
    }

    /// Standard error of the mean.
    #[must_use]
    pub fn standard_error(&self) -> f64 {
        if self.count > 1.0 { (self.squares / (self.count - 1.0) / self.count).sqrt() } else { f64::INFINITY }
    }
}

/// Chance that `z` standard deviations or more, either way, are an accident.
#[must_use]
pub fn normal_p(z: f64) -> f64 {
    upper_gamma(0.5, 0.5 * z * z)
}

/// Chance that chi-square of so many degrees of freedom is so large or larger by accident.
#[must_use]
pub fn chi_square_p(chi_square: f64, degrees: f64) -> f64 {
    upper_gamma(0.5 * degrees, 0.5 * chi_square)
}

/// Chance that numbers in [0, 1] lie so unevenly by accident: Kolmogorov and Smirnov's test, with Stephens'
/// correction for small counts.
#[must_use]
pub fn uniform_p(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len() as f64;
    if count == 0.0 {
        return 1.0;
    }
    let gaps = sorted.iter().enumerate().map(|(i, &x)| {
        let (below, above) = (i as f64 / count, (i as f64 + 1.0) / count);
        (x - below).abs().max((above - x).abs())
    });
    let root = count.sqrt();
    let lambda = (root + 0.12 + 0.11 / root) * gaps.fold(0.0, f64::max);
    let term = |k: i32| f64::from(1 - 2 * ((k + 1) % 2)) * (-2.0 * f64::from(k * k) * lambda * lambda).exp();
    // The series stops converging where the chance is 1 in any case.
    if lambda < 0.2 { 1.0 } else { (2.0 * (1..100).map(term).sum::<f64>()).clamp(0.0, 1.0) }
}

/// Q(a, x), the regularised upper incomplete gamma function: the series for small x, Legendre's continued
/// fraction (by Lentz's method) for large (Abramowitz and Stegun 6.5.29 and 6.5.31).
fn upper_gamma(a: f64, x: f64) -> f64 {
    if x.is_nan() || a.is_nan() || a <= 0.0 {
        return f64::NAN;
    }
    if x <= 0.0 {
        return 1.0;
    }
    if x.is_infinite() {
        return 0.0;
    }
    let scale = (a * x.ln() - x - ln_gamma(a)).exp();
    if x < a + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / a, 1.0 / a, a);
        while term > 1e-16 * sum {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        return (1.0 - scale * sum).max(0.0);
    }
    let mut b = x + 1.0 - a;
    let mut c = f64::INFINITY;
    let mut d = 1.0 / b;
    let mut fraction = d;
    for i in 1..100_000 {
        let i = f64::from(i);
        let step = -i * (i - a);
        b += 2.0;
        d = 1.0 / (step * d + b);
        c = b + step / c;
        let factor = d * c;
        fraction *= factor;
        if (factor - 1.0).abs() < 1e-15 {
            break;
        }
    }
    (scale * fraction).min(1.0)
}

/// The logarithm of the gamma function, x > 0: Stirling's series above 10, the recurrence below.
fn ln_gamma(mut x: f64) -> f64 {
    let mut shift = 0.0;
    while x < 10.0 {
        shift += x.ln();
        x += 1.0;
    }
    let y = 1.0 / (x * x);
    let series = (1.0 / 12.0 + y * (-1.0 / 360.0 + y * (1.0 / 1260.0 + y * (-1.0 / 1680.0)))) / x;
    (x - 0.5) * x.ln() - x + 0.5 * std::f64::consts::TAU.ln() + series - shift
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Published values: the quantiles every table of statistics has.
    #[test]
    fn chances_are_those_of_the_tables() {
        for (z, p) in [(1.959_963_985, 0.05), (3.290_526_731, 1e-3), (4.891_638_475, 1e-6)] {
            assert!((normal_p(z) / p - 1.0).abs() < 1e-7, "{z}: {}", normal_p(z));
        }
        for (chi_square, degrees, p) in [
            (3.841_458_8, 1.0, 0.05),
            (18.307_038, 10.0, 0.05),
            (149.449_25, 100.0, 1e-3),
            (1106.969, 1000.0, 0.01),
        ] {
            let found = chi_square_p(chi_square, degrees);
            assert!((found / p - 1.0).abs() < 1e-4, "{chi_square} of {degrees}: {found}");
        }
        assert_eq!((chi_square_p(0.0, 5.0), chi_square_p(1e9, 5.0)), (1.0, 0.0));
        assert!((chi_square_p(20_000.0, 20_000.0) - 0.498_67).abs() < 1e-4);
    }

    /// 1.36 and 1.95 over the root of the count: the critical values of every table.
    #[test]
    fn evenness_is_judged() {
        let even: Vec<f64> = (0..1000).map(|i| (f64::from(i) + 0.5) / 1000.0).collect();
        assert_eq!(uniform_p(&even), 1.0);
        let shifted = |by: f64| uniform_p(&even.iter().map(|x| (x + by).min(1.0)).collect::<Vec<_>>());
        assert!((shifted(1.358 / 1000_f64.sqrt()) / 0.05 - 1.0).abs() < 0.2, "{}", shifted(0.043));
        assert!(shifted(0.0617) < 1.2e-3 && shifted(0.2) < 1e-30);
    }

    #[test]
    fn moments_join() {
        let values: Vec<f64> = (0..1000).map(|i| f64::from(i * i % 97)).collect();
        let of = |part: &[f64]| {
            part.iter().fold(Moments::default(), |mut m, &v| {
                m.push(v);
                m
            })
        };
        let (whole, joined) = (of(&values), of(&values[..300]).joined(of(&values[300..])));
        assert!((whole.mean - joined.mean).abs() < 1e-12);
        assert!((whole.standard_error() / joined.standard_error() - 1.0).abs() < 1e-12);
    }
}
