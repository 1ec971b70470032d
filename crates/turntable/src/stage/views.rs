//! Where the turn stands at each frame.

use crate::schema::Turn;

/// Azimuth of frame `number` (from 1) in degrees, 0..360.
pub(crate) fn azimuth(turn: &Turn, number: u32) -> f64 {
    // A full circle ends where it began, an arc shows both its ends.
    let full = turn.degrees.abs() == 360.0;
    let gaps = if full { turn.frames } else { turn.frames.saturating_sub(1).max(1) };
    (turn.start + turn.degrees * f64::from(number - 1) / f64::from(gaps)).rem_euclid(360.0)
}
