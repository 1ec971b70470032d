//! Three moments around one, and the rates of change they give.

use crate::BindingError;

/// Times at which to pose a mesh for velocities and accelerations at one time, and what each pose counts for.
///
/// In the midst of an animation these are `time - dt`, `time` and `time + dt`: central differences, whose error falls
/// with the square of `dt`. A mesh holds its first pose before its animation and its last one after it, so at the ends
/// a central difference would see half the motion: there the three times lie on the inner side (still of second
/// order for velocities, of first order for accelerations). Outside the animation they lie on the outer side, where
/// nothing moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stencil {
    times: [f64; 3],
    at: usize,
    first: [f64; 3],
    second: [f64; 3],
}

impl Stencil {
    /// The times for `time` with steps of `dt`, all in seconds, for a mesh that moves from `range.0` to `range.1` (none:
    /// it moves always, or nobody knows). The steps are shorter than `dt` where the whole range is shorter than three.
    ///
    /// # Errors
    /// [`BindingError::OutOfRange`] for a time that is not finite or a `dt` that is not over zero.
    pub fn new(time: f64, dt: f64, range: Option<(f64, f64)>) -> Result<Self, BindingError> {
        let refuse = |name, found: f64, expected| {
            Err(BindingError::OutOfRange { name, found: found.to_string(), expected })
        };
        if !time.is_finite() {
            return refuse("time", time, "a finite number of seconds");
        }
        // A step must change the time it is added to.
        if !(dt.is_finite() && dt > 0.0 && time + dt > time && time - dt < time) {
            return refuse("dt", dt, "a step over zero that changes the time, in seconds");
        }
        let Some((start, end)) = range.filter(|(start, end)| end > start) else {
            return Ok(Self::evenly(time - dt, dt, 1));
        };
        let step = dt.min((end - start) / 3.0);
        // Frame / frame rate may miss the last key by a rounding: that is no time outside.
        let slack = 1e-6 * step;
        Ok(if time < start - slack {
            Self::evenly(time - 2.0 * dt, dt, 2)
        } else if time > end + slack {
            Self::evenly(time, dt, 0)
        } else if time - step < start {
            Self::evenly(time.max(start), step, 0)
        } else if time + step > end {
            Self::evenly(time.min(end) - 2.0 * step, step, 2)
        } else {
            Self::evenly(time - step, step, 1)
        })
    }

    /// Three times from `start`, of which the differences are for number `at`.
    fn evenly(start: f64, step: f64, at: usize) -> Self {
        let first = match at {
            0 => [-1.5, 2.0, -0.5],
            1 => [-0.5, 0.0, 0.5],
            _ => [0.5, -2.0, 1.5],
        };
        Stencil {
            times: [start, start + step, start + 2.0 * step],
            at,
            first: first.map(|weight| weight / step),
            second: [1.0, -2.0, 1.0].map(|weight| weight / (step * step)),
        }
    }

    /// When to pose the mesh, in seconds, in order.
    #[must_use]
    pub fn times(&self) -> [f64; 3] {
        self.times
    }

    /// Which of the three is the time asked for.
    #[must_use]
    pub fn at(&self) -> usize {
        self.at
    }

    /// What each pose counts for in the velocity, per second.
    #[must_use]
    pub fn first(&self) -> [f64; 3] {
        self.first
    }

    /// What each pose counts for in the acceleration, per second squared.
    #[must_use]
    pub fn second(&self) -> [f64; 3] {
        self.second
    }

    /// Seconds from one pose to the next.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.times[1] - self.times[0]
    }

    /// The velocity's weights when only one side of the time counts: the pose before it and itself, or itself and
    /// the one after; none where the stencil has nothing on that side.
    pub(crate) fn one_sided(&self, interval: usize) -> [f64; 3] {
        let rate = 1.0 / self.step();
        if interval == 0 { [-rate, rate, 0.0] } else { [0.0, -rate, rate] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn apply(weights: [f64; 3], times: [f64; 3], f: impl Fn(f64) -> f64) -> f64 {
        weights.iter().zip(times).map(|(weight, time)| weight * f(time)).sum()
    }

    #[test]
    fn parabolas_are_differentiated_exactly_wherever_the_time_lies() {
        let (start, end) = (0.5, 2.0);
        for time in [0.5, 0.501, 0.6, 1.0, 1.95, 2.0] {
            let stencil = Stencil::new(time, 0.01, Some((start, end))).unwrap();
            assert!((stencil.times()[stencil.at()] - time).abs() < 1e-12);
            // What lies outside of the range is not asked.
            assert!(stencil.times().iter().all(|t| (start..=end).contains(t)), "{stencil:?}");
            let f = |t: f64| 3.0 - 2.0 * t + 5.0 * t * t;
            assert!((apply(stencil.first(), stencil.times(), f) - (10.0 * time - 2.0)).abs() < 1e-9);
            assert!((apply(stencil.second(), stencil.times(), f) - 10.0).abs() < 1e-6);
        }
    }

    #[test]
    fn a_mesh_that_holds_its_first_pose_has_its_whole_velocity_at_the_first_key() {
        let held = |t: f64| 3.0 * t.clamp(0.0, 1.0);
        for (time, expected) in [(0.0, 3.0), (1.0, 3.0), (1.0 + 1e-12, 3.0), (-0.005, 0.0), (1.005, 0.0)] {
            let stencil = Stencil::new(time, 0.01, Some((0.0, 1.0))).unwrap();
            assert!((apply(stencil.first(), stencil.times(), held) - expected).abs() < 1e-9, "{time}");
        }
        // The plain central difference sees half.
        let stencil = Stencil::new(0.0, 0.01, None).unwrap();
        assert!((apply(stencil.first(), stencil.times(), held) - 1.5).abs() < 1e-9);
    }

    #[test]
    fn a_range_shorter_than_the_steps_shortens_them() {
        for time in [1.0, 1.0005, 1.001] {
            let stencil = Stencil::new(time, 0.01, Some((1.0, 1.001))).unwrap();
            assert!(stencil.times().iter().all(|t| (1.0 - 1e-12..=1.001 + 1e-12).contains(t)), "{stencil:?}");
            assert!((apply(stencil.first(), stencil.times(), |t| 7.0 * t) - 7.0).abs() < 1e-6);
        }
        // One key is no range.
        assert_eq!(Stencil::new(1.0, 0.01, Some((1.0, 1.0))).unwrap().at(), 1);
    }

    #[test]
    fn odd_numbers_are_refused() {
        for (time, dt) in [(f64::NAN, 0.1), (0.0, 0.0), (0.0, -1.0), (0.0, f64::INFINITY), (1e20, 0.01)] {
            assert!(Stencil::new(time, dt, None).is_err(), "{time} {dt}");
        }
    }
}
