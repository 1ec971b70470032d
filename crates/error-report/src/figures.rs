//! Error figures between two arrays of numbers.

use crate::ReportError;

/// Added to the squared reference in relMSE so that black references weigh a finite amount; the
/// value the denoising literature uses (Rousselle et al. 2011 and after).
pub const REL_MSE_EPSILON: f64 = 0.01;

/// Share of the worst values left out of [`Figures::rel_mse_trimmed`].
pub const TRIMMED_SHARE: f64 = 0.001;

/// How far an array is from its reference. All sums are taken in f64.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// Mean of `(x - ref)^2`.
    pub mse: f64,
    /// Mean of `|x - ref|`.
    pub mae: f64,
    /// Mean of `(x - ref)^2 / (ref^2 + 0.01)`.
    pub rel_mse: f64,
    /// [`Figures::rel_mse`] without the worst 0.1 % of the values (rounded down): a few fireflies
    /// cannot move it.
    pub rel_mse_trimmed: f64,
    /// The largest `|x - ref|`.
    pub max: f64,
}

impl Figures {
    /// Compares `test` with `reference`, value by value: pass all channels of all pixels.
    ///
    /// # Errors
    /// [`ReportError::Lengths`] when the lengths differ or are 0, [`ReportError::NotFinite`] when a
    /// value is NaN or infinite.
    pub fn compare(test: &[f32], reference: &[f32]) -> Result<Figures, ReportError> {
        if test.len() != reference.len() || test.is_empty() {
            return Err(ReportError::Lengths { test: test.len(), reference: reference.len() });
        }
        check_finite("test", test)?;
        check_finite("reference", reference)?;
        let (mut squares, mut absolutes, mut max) = (0.0_f64, 0.0_f64, 0.0_f64);
        let mut relative = Vec::with_capacity(test.len());
        for (&x, &r) in test.iter().zip(reference) {
            let (r, difference) = (f64::from(r), f64::from(x) - f64::from(r));
            squares += difference * difference;
            absolutes += difference.abs();
            max = max.max(difference.abs());
            relative.push(difference * difference / (r * r + REL_MSE_EPSILON));
        }
        let count = test.len() as f64;
        let rel_mse = relative.iter().sum::<f64>() / count;
        let rel_mse_trimmed = trimmed_mean(relative, TRIMMED_SHARE);
        Ok(Figures { mse: squares / count, mae: absolutes / count, rel_mse, rel_mse_trimmed, max })
    }

    /// Root of the mean square error.
    #[must_use]
    pub fn rmse(&self) -> f64 {
        self.mse.sqrt()
    }
}

fn check_finite(which: &'static str, values: &[f32]) -> Result<(), ReportError> {
    match values.iter().position(|v| !v.is_finite()) {
        Some(index) => Err(ReportError::NotFinite { which, index, found: values[index] }),
        None => Ok(()),
    }
}

/// Mean of all but the largest `share` of `values`.
fn trimmed_mean(mut values: Vec<f64>, share: f64) -> f64 {
    let kept = values.len() - (values.len() as f64 * share) as usize;
    // Summing in sorted order also frees the result from the order of the pixels.
    values.sort_unstable_by(f64::total_cmp);
    values.truncate(kept.max(1));
    values.iter().sum::<f64>() / values.len() as f64
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn planted_errors_are_found() {
        // 10,000 values, each 0.5 off a reference of 1, and ten (0.1 %) that are 100 off.
        let reference = vec![1.0_f32; 10_000];
        let mut test = vec![1.5_f32; 10_000];
        for i in 0..10 {
            test[i * 997] = 101.0;
        }
        let figures = Figures::compare(&test, &reference).unwrap();
        let mean = |common: f64, rare: f64| (common * 9990.0 + rare * 10.0) / 10_000.0;
        let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-12 * b, "{a} is not {b}");
        close(figures.mse, mean(0.25, 1e4));
        close(figures.mae, mean(0.5, 100.0));
        close(figures.rel_mse, mean(0.25, 1e4) / 1.01);
        close(figures.rel_mse_trimmed, 0.25 / 1.01);
        close(figures.max, 100.0);
        close(figures.rmse(), mean(0.25, 1e4).sqrt());
    }

    #[test]
    fn what_cannot_be_compared_is_refused() {
        assert!(matches!(Figures::compare(&[], &[]), Err(ReportError::Lengths { .. })));
        assert!(matches!(Figures::compare(&[1.0], &[1.0, 2.0]), Err(ReportError::Lengths { .. })));
        let nan = Figures::compare(&[1.0, f32::NAN], &[1.0, 2.0]);
        assert!(matches!(nan, Err(ReportError::NotFinite { which: "test", index: 1, .. })));
        let infinite = Figures::compare(&[1.0], &[f32::INFINITY]);
        assert!(matches!(infinite, Err(ReportError::NotFinite { which: "reference", index: 0, .. })));
    }

    #[test]
    fn large_offsets_do_not_drown_small_errors() {
        // In f32 sums these differences would vanish.
        let reference = vec![1.0e4_f32; 100_000];
        let test: Vec<f32> = reference.iter().map(|r| r + 0.0009765625).collect();
        let figures = Figures::compare(&test, &reference).unwrap();
        assert!((figures.mae - 0.0009765625).abs() < 1e-15);
    }

    proptest! {
        #[test]
        fn figures_obey_their_inequalities(pairs in prop::collection::vec((-1e3f32..1e3, -1e3f32..1e3), 1..200)) {
            let (test, reference): (Vec<_>, Vec<_>) = pairs.into_iter().unzip();
            let f = Figures::compare(&test, &reference).unwrap();
            prop_assert!(f.mae <= f.rmse() * (1.0 + 1e-12));
            prop_assert!(f.rmse() <= f.max * (1.0 + 1e-12));
            prop_assert!(f.rel_mse_trimmed <= f.rel_mse * (1.0 + 1e-12));
            prop_assert!(f.rel_mse <= f.mse / REL_MSE_EPSILON * (1.0 + 1e-12));
            let same = Figures::compare(&reference, &reference).unwrap();
            prop_assert_eq!((same.mse, same.mae, same.rel_mse, same.max), (0.0, 0.0, 0.0, 0.0));
        }
    }
}
