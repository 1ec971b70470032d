//! The frame rate that the keys of an animation were set at.

/// Rates in use, lowest first.
const RATES: [f64; 7] = [24.0, 25.0, 30.0, 48.0, 50.0, 60.0, 120.0];

/// How far in seconds a key may lie from a frame.
const NEAR: f64 = 1e-4;

/// The lowest rate whose frames hold all `times`; glTF itself knows only seconds.
pub(super) fn of_keys(times: impl Iterator<Item = f64> + Clone) -> Option<f64> {
    times.clone().next()?;
    let holds = |rate: f64| times.clone().all(|time| ((time * rate).round() / rate - time).abs() <= NEAR);
    RATES.into_iter().find(|&rate| holds(rate))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lowest_rate_that_holds_all_keys_is_found() {
        let keys = |step: f64| (0..60).map(move |i| i as f64 * step);
        assert_eq!(of_keys(keys(1.0 / 30.0)), Some(30.0));
        assert_eq!(of_keys(keys(2.0 / 24.0)), Some(24.0));
        assert_eq!(of_keys(keys(f64::from(1.0_f32 / 60.0))), Some(60.0));
        assert_eq!(of_keys(keys(1.0 / 29.97)), None);
        assert_eq!(of_keys(keys(1.0).take(0)), None);
    }
}
