//! Gauss's quadrature over panels that are dense where a function is narrow.

/// Where a function is narrow: a centre and the distance over which it changes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Where.
    pub centre: f64,
    /// How narrow, above 0.
    pub width: f64,
}

/// Abscissae and weights of Gauss and Legendre's rule of eight, on [-1, 1].
pub(crate) const GAUSS: [(f64, f64); 8] = [
    (-0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
    (-0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (-0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (-0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_5),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_3),
];

/// The rule of four: for panels that were cut in two.
pub(crate) const GAUSS_OF_FOUR: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_2),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// The nodes of [low, high]: place and weight.
pub(crate) fn nodes(low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> {
    nodes_of(&GAUSS, low, high)
}

/// The same by another rule.
pub(crate) fn nodes_of(rule: &'static [(f64, f64)], low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> {
    let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
    rule.iter().map(move |&(x, weight)| (middle + half * x, half * weight))
}

/// The integral of `f` over panels with the given edges.
pub fn integral(edges: &[f64], mut f: impl FnMut(f64) -> f64) -> f64 {
    let panels = edges.windows(2);
    panels.map(|panel| nodes(panel[0], panel[1]).map(|(x, weight)| weight * f(x)).sum::<f64>()).sum()
}

/// Longest panel: no lobe of a fibre is so smooth that eight nodes would not do for it.
const LONGEST: f64 = 0.4;

/// Edges of panels over [low, high]: as short as each peak's width beside it, twice as long at twice the
/// distance, and with an edge at each of `kinks`.
#[must_use]
pub fn panels(low: f64, high: f64, peaks: &[Peak], kinks: &[f64]) -> Vec<f64> {
    let mut fixed: Vec<f64> = kinks.iter().copied().filter(|&x| x > low && x < high).collect();
    fixed.extend([low, high]);
    fixed.sort_by(f64::total_cmp);
    fixed.dedup_by(|b, a| *b - *a < 1e-9);
    let mut edges = vec![low];
    for pair in fixed.windows(2) {
        let mut x = pair[0];
        loop {
            let step = longest_from(x, peaks);
            // A rest of less than half a panel goes to the last one.
            if x + 1.5 * step >= pair[1] {
                break;
            }
            x += step;
            edges.push(x);
        }
        edges.push(pair[1]);
    }
    edges
}

/// How long a panel that begins at `x` may be.
fn longest_from(x: f64, peaks: &[Peak]) -> f64 {
    let allowed = peaks.iter().map(|peak| {
        let ahead = peak.centre - x;
        if ahead > 0.0 { peak.width.max(0.5 * ahead) } else { peak.width.max(-ahead) }
    });
    allowed.fold(LONGEST, f64::min).max(1e-6)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn narrow_peaks_are_not_missed() {
        for width in [1e-4, 1e-2, 1.0_f64] {
            for centre in [-1.5, 0.1, 1.2345] {
                let peaks = [Peak { centre, width }, Peak { centre: 0.7, width: 0.3 }];
                let edges = panels(-10.0, 10.0, &peaks, &[0.0]);
                let density = |x: f64| {
                    (-0.5 * ((x - centre) / width).powi(2)).exp() / (width * std::f64::consts::TAU.sqrt())
                };
                let found = integral(&edges, density);
                assert!((found - 1.0).abs() < 1e-9, "{found} for width {width} at {centre}");
                assert!(edges.contains(&0.0) && edges.windows(2).all(|w| w[0] < w[1]));
                assert!(edges.len() < 150, "{}", edges.len());
            }
        }
    }
}
