//! What points are blurred by, of what is known of their motion.

use glam::Vec3;

use crate::{Motion, RenderError, Shutter};

/// What points are blurred by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Blur {
    /// Nothing: they stand still.
    Off,
    /// Their positions at different times.
    Positions,
    /// Their positions at the frame, and velocities.
    Velocities,
    /// The same, and accelerations.
    Accelerations,
}

impl Blur {
    /// How many keys it takes when nobody says: 2, and 3 where the way is bent.
    #[must_use]
    pub fn usual_keys(self) -> usize {
        if self == Blur::Accelerations { 3 } else { 2 }
    }
}

/// How points move, as far as it is known at one frame.
#[derive(Clone, Copy, Debug)]
pub struct Movement<'a> {
    /// Where the points are at the frame.
    pub positions: &'a [Vec3],
    /// One a point, in units a second.
    pub velocities: Option<&'a [Vec3]>,
    /// One a point, in units a second squared; of use only with velocities.
    pub accelerations: Option<&'a [Vec3]>,
    /// Whether there are positions at other times.
    pub other_times: bool,
}

impl Movement<'_> {
    /// Whether the points can be blurred so.
    #[must_use]
    pub fn allows(&self, blur: Blur) -> bool {
        match blur {
            Blur::Off => true,
            Blur::Positions => self.other_times,
            Blur::Velocities => self.velocities.is_some(),
            Blur::Accelerations => self.velocities.is_some() && self.accelerations.is_some(),
        }
    }

    /// The best that can be done: accelerations, else velocities, else positions.
    ///
    /// Velocities come before positions, as in USD: where a file has both, they know what happens between its
    /// frames.
    #[must_use]
    pub fn best(&self) -> Blur {
        let all = [Blur::Accelerations, Blur::Velocities, Blur::Positions];
        all.into_iter().find(|&blur| self.allows(blur)).unwrap_or(Blur::Off)
    }

    /// How the points move while the shutter of `frame` is open, at `frame_rate` frames a second and at `keys`
    /// times; `positions_at` tells where they are at a time in frames, and is asked for nothing but
    /// [`Blur::Positions`]. Velocities alone are a straight line, for which two keys do.
    ///
    /// # Errors
    /// Those of `positions_at`; [`RenderError::Argument`] for what [`Movement::allows`] does not, and as
    /// [`Motion::keys`] and [`Shutter::key_times`].
    pub fn motion<E: From<RenderError>>(
        &self,
        blur: Blur,
        shutter: &Shutter,
        (frame, frame_rate): (f64, f64),
        keys: usize,
        positions_at: impl FnMut(f64) -> Result<Vec<Vec3>, E>,
    ) -> Result<Motion, E> {
        let seconds = shutter.seconds(frame_rate)?;
        let lacks = |what: &str| {
            let found = format!("{what}, which are not there");
            Err(E::from(RenderError::argument("what to blur by", found, "what is known of the points")))
        };
        match (blur, self.velocities, self.accelerations) {
            (Blur::Off, ..) => Ok(Motion::STILL),
            (Blur::Positions, ..) if self.other_times => {
                let times = shutter.key_times(frame, keys)?;
                Ok(Motion::keys(times.into_iter().map(positions_at).collect::<Result<_, E>>()?)?)
            }
            (Blur::Velocities, Some(velocities), _) => {
                Ok(Motion::velocities(self.positions, velocities, seconds)?)
            }
            (Blur::Accelerations, Some(velocities), Some(accelerations)) => {
                Ok(Motion::accelerations(self.positions, velocities, accelerations, seconds, keys)?)
            }
            (Blur::Positions, ..) => lacks("positions of other times"),
            (Blur::Velocities, ..) => lacks("velocities"),
            (Blur::Accelerations, ..) => lacks("accelerations"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_is_taken_and_what_is_not_there_is_refused() {
        let (points, v, a) = ([Vec3::ZERO], [Vec3::X * 8.0], [Vec3::Y * 8.0]);
        let known = |velocities: bool, accelerations: bool, other_times: bool| Movement {
            positions: &points,
            velocities: velocities.then_some(&v[..]),
            accelerations: accelerations.then_some(&a[..]),
            other_times,
        };
        assert_eq!(known(true, true, true).best(), Blur::Accelerations);
        assert_eq!(known(true, false, true).best(), Blur::Velocities);
        assert_eq!(known(false, true, true).best(), Blur::Positions);
        assert_eq!(known(false, true, false).best(), Blur::Off);
        let shutter = Shutter::default();
        let at = |time: f64| Ok::<_, RenderError>(vec![Vec3::X * time as f32]);
        let motion = |blur| known(true, true, true).motion(blur, &shutter, (10.0, 2.0), 3, at).unwrap();
        let ends = |blur| [0.0, 1.0].map(|time| motion(blur).at(0, time).unwrap().as_vec3());
        assert_eq!(ends(Blur::Positions), [Vec3::X * 9.75, Vec3::X * 10.25]);
        assert_eq!(ends(Blur::Velocities), [Vec3::NEG_X, Vec3::X]);
        assert_eq!(ends(Blur::Accelerations), [Vec3::new(-1.0, 0.0625, 0.0), Vec3::new(1.0, 0.0625, 0.0)]);
        assert_eq!(motion(Blur::Off), Motion::STILL);
        let none = known(false, false, false);
        for blur in [Blur::Positions, Blur::Velocities, Blur::Accelerations] {
            let told = none.motion(blur, &shutter, (10.0, 2.0), 3, at).unwrap_err().to_string();
            assert!(!none.allows(blur) && told.contains("which are not there"), "{told}");
        }
    }
}
