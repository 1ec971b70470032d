//! Where the turn stands at each frame, and in between.

use crate::schema::{CameraSettings, Ease, Turn};

/// Azimuth of frame `number` (from 1) in degrees, 0..360.
pub(crate) fn azimuth(turn: &Turn, number: u32) -> f64 {
    turned(turn, f64::from(number)).rem_euclid(360.0)
}

/// Azimuth at a time in frames (the first is 1) in degrees, not brought below 360: the turn goes on evenly where a
/// shutter looks before its first frame or after its last, unless it is eased, which stands there.
pub(crate) fn turned(turn: &Turn, number: f64) -> f64 {
    match turn.ease {
        Ease::Linear => {
            // A full circle ends where it began, an arc shows both its ends.
            let full = turn.degrees.abs() == 360.0;
            let gaps = if full { turn.frames } else { turn.frames.saturating_sub(1).max(1) };
            turn.start + turn.degrees * (number - 1.0) / f64::from(gaps)
        }
        Ease::Smooth => turn.start + turn.degrees * smooth(share(turn, number)),
    }
}

/// Angle above the horizon at a time in frames, degrees.
pub(crate) fn elevation(turn: &Turn, camera: &CameraSettings, number: f64) -> f64 {
    let Some(last) = camera.elevation_to else { return camera.elevation };
    let share = match turn.ease {
        Ease::Linear => share(turn, number),
        Ease::Smooth => smooth(share(turn, number)),
    };
    camera.elevation + (last - camera.elevation) * share
}

/// How much of the way from the first frame to the last is done, 0..1.
fn share(turn: &Turn, number: f64) -> f64 {
    let gaps = turn.frames.saturating_sub(1).max(1);
    ((number - 1.0) / f64::from(gaps)).clamp(0.0, 1.0)
}

/// Smoothstep: without speed at both ends.
fn smooth(share: f64) -> f64 {
    share * share * (3.0 - 2.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn turn(frames: u32, degrees: f64, ease: Ease) -> Turn {
        Turn { frames, degrees, ease, start: 10.0, ..Turn::default() }
    }

    #[test]
    fn a_circle_does_not_repeat_its_start_and_an_arc_shows_both_ends() {
        let all = |turn: &Turn| (1..=turn.frames).map(|n| azimuth(turn, n)).collect::<Vec<_>>();
        assert_eq!(all(&turn(4, 360.0, Ease::Linear)), [10.0, 100.0, 190.0, 280.0]);
        assert_eq!(all(&turn(4, -360.0, Ease::Linear)), [10.0, 280.0, 190.0, 100.0]);
        assert_eq!(all(&turn(3, 90.0, Ease::Linear)), [10.0, 55.0, 100.0]);
        assert_eq!(all(&turn(1, 90.0, Ease::Linear)), [10.0]);
        assert_eq!(turned(&turn(4, 360.0, Ease::Linear), 5.5), 415.0, "on it goes");
    }

    #[test]
    fn an_eased_turn_sets_off_and_stops_slowly() {
        let turn = turn(5, 360.0, Ease::Smooth);
        let all: Vec<f64> = (1..=5).map(|n| turned(&turn, f64::from(n))).collect();
        assert_eq!(all, [10.0, 66.25, 190.0, 313.75, 370.0]);
        assert_eq!((turned(&turn, 0.5), turned(&turn, 5.5)), (10.0, 370.0));
        let step = |a: f64| turned(&turn, a + 1e-3) - turned(&turn, a);
        assert!(step(1.0) < 0.01 * step(3.0) && step(4.999) < 0.01 * step(3.0));
    }

    #[test]
    fn the_camera_rises_from_first_to_last() {
        let camera =
            CameraSettings { elevation: 10.0, elevation_to: Some(50.0), ..CameraSettings::default() };
        let at = |ease, number| elevation(&turn(5, 360.0, ease), &camera, number);
        assert_eq!([1.0, 2.0, 5.0, 9.0].map(|n| at(Ease::Linear, n)), [10.0, 20.0, 50.0, 50.0]);
        assert_eq!([1.0, 3.0, 5.0].map(|n| at(Ease::Smooth, n)), [10.0, 30.0, 50.0]);
        assert_eq!(elevation(&turn(5, 1.0, Ease::Linear), &CameraSettings::default(), 3.0), 5.0);
    }
}
