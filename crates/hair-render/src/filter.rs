//! The pixel filter, sampled by importance: every sample has the same weight.

use std::f64::consts::PI;

/// A separable Blackman-Harris window.
#[derive(Debug)]
pub(crate) struct Filter {
    /// Offsets in pixels at equal steps of the cumulated filter.
    inverse: Vec<f32>,
}

const STEPS: usize = 1024;

impl Filter {
    /// The filter that reaches `radius` pixels from the pixel's middle.
    pub fn new(radius: f32) -> Self {
        let offset = |step: usize| {
            let t = invert(step as f64 / STEPS as f64);
            (2.0 * t - 1.0) as f32 * radius
        };
        Filter { inverse: (0..=STEPS).map(offset).collect() }
    }

    /// An offset from the pixel's middle for a uniform number in [0, 1).
    pub fn sample(&self, u: f32) -> f32 {
        let place = u * STEPS as f32;
        let step = (place as usize).min(STEPS - 1);
        let (low, high) = (self.inverse[step], self.inverse[step + 1]);
        low + (high - low) * (place - step as f32)
    }
}

/// Share of the window's weight below `t` in 0..1 of its width.
fn cumulated(t: f64) -> f64 {
    let wave = |amplitude: f64, k: f64| amplitude * (2.0 * PI * k * t).sin() / (2.0 * PI * k);
    t + (wave(-0.48829, 1.0) + wave(0.14128, 2.0) + wave(-0.01168, 3.0)) / 0.35875
}

fn invert(share: f64) -> f64 {
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if cumulated(middle) < share {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_have_the_windows_spread() {
        let filter = Filter::new(1.5);
        let offsets: Vec<f64> =
            (0..10_000).map(|i| f64::from(filter.sample((i as f32 + 0.5) / 1e4))).collect();
        let mean = offsets.iter().sum::<f64>() / 1e4;
        let variance = offsets.iter().map(|x| x * x).sum::<f64>() / 1e4;
        // The window's own variance, by quadrature.
        let weight = |t: f64| {
            0.35875 - 0.48829 * (2.0 * PI * t).cos() + 0.14128 * (4.0 * PI * t).cos()
                - 0.01168 * (6.0 * PI * t).cos()
        };
        let exact: f64 = (0..10_000)
            .map(|i| (f64::from(i) + 0.5) / 1e4)
            .map(|t| weight(t) * (3.0 * t - 1.5).powi(2) / 0.35875 / 1e4)
            .sum();
        assert!(mean.abs() < 1e-5 && (variance / exact - 1.0).abs() < 5e-3, "{variance} {exact}");
        assert!(filter.sample(0.0) >= -1.5 && filter.sample(0.999_999_9) <= 1.5);
    }
}
