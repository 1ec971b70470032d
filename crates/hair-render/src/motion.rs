//! Where points go while the shutter is open.

use glam::{DVec3, Vec3};

use crate::RenderError;
use crate::shutter::check_keys;

/// One vector a point at two or more times, evenly spread from the shutter's opening to its closing; straight
/// lines between them. Nothing for what stands still.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    keys: Vec<Vec<Vec3>>,
}

impl Motion {
    /// No motion.
    pub const STILL: Motion = Motion { keys: Vec::new() };

    /// Positions (or normals) at even times, the first at opening, the last at closing; each holds one vector
    /// a point. One key alone stands still.
    ///
    /// # Errors
    /// [`RenderError::Argument`] for no key or more than 1025, keys of different lengths, and numbers that are
    /// not finite.
    pub fn keys(keys: Vec<Vec<Vec3>>) -> Result<Self, RenderError> {
        check_keys(keys.len())?;
        let count = keys.first().map_or(0, Vec::len);
        for (place, key) in keys.iter().enumerate() {
            if key.len() != count {
                let found = format!("{} points at key {place}", key.len());
                return Err(RenderError::argument("motion", found, "as many as at the first key"));
            }
            if let Some(point) = key.iter().position(|v| !v.is_finite()) {
                let found = format!("{} at point {point} of key {place}", key[point]);
                return Err(RenderError::argument("motion", found, "finite numbers"));
            }
        }
        Ok(Motion { keys })
    }

    /// Points that go straight on: where they are at the frame, and their velocities in units a second.
    /// `seconds` are the shutter's opening and closing relative to the frame ([`crate::Shutter::seconds`]).
    ///
    /// # Errors
    /// As [`Motion::keys`]; also for another number of velocities than positions.
    pub fn velocities(
        positions: &[Vec3],
        velocities: &[Vec3],
        seconds: [f64; 2],
    ) -> Result<Self, RenderError> {
        check_count("number of velocities", velocities, positions)?;
        Motion::by_time(seconds, 2, |time| {
            let moved = |(p, v): (&Vec3, &Vec3)| p.as_dvec3() + v.as_dvec3() * time;
            positions.iter().zip(velocities).map(moved).map(|p| p.as_vec3()).collect()
        })
    }

    /// Points that also gather speed: `p + v t + a t^2 / 2`, at `keys` times. Two keys are the chord of the
    /// parabola; three and more follow it, with an error that falls as the square of their number.
    ///
    /// # Errors
    /// As [`Motion::keys`]; also for another number of velocities or accelerations than positions.
    pub fn accelerations(
        positions: &[Vec3],
        velocities: &[Vec3],
        accelerations: &[Vec3],
        seconds: [f64; 2],
        keys: usize,
    ) -> Result<Self, RenderError> {
        check_count("number of velocities", velocities, positions)?;
        check_count("number of accelerations", accelerations, positions)?;
        Motion::by_time(seconds, keys, |time| {
            let moved = |((p, v), a): ((&Vec3, &Vec3), &Vec3)| -> DVec3 {
                p.as_dvec3() + v.as_dvec3() * time + a.as_dvec3() * (0.5 * time * time)
            };
            positions.iter().zip(velocities).zip(accelerations).map(moved).map(|p| p.as_vec3()).collect()
        })
    }

    fn by_time(
        [open, close]: [f64; 2],
        keys: usize,
        at: impl Fn(f64) -> Vec<Vec3>,
    ) -> Result<Self, RenderError> {
        check_keys(keys)?;
        if open == close || keys == 1 {
            return Motion::keys(vec![at(0.5 * (open + close))]);
        }
        let time = |key: usize| open + (close - open) * (key as f64 / (keys - 1) as f64);
        Motion::keys((0..keys).map(|key| at(time(key))).collect())
    }

    /// Whether any point is at another place at one key than at another.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.keys.windows(2).any(|pair| pair[0] != pair[1])
    }

    /// Where a point is at `time`, 0 at opening and 1 at closing; before and after it is where it is then.
    /// `None` for a point without motion.
    #[must_use]
    pub fn at(&self, point: usize, time: f64) -> Option<DVec3> {
        let last = self.keys.len().checked_sub(1)?;
        let place = time.clamp(0.0, 1.0) * last as f64;
        let before = (place as usize).min(last.saturating_sub(1));
        let at = |key: usize| Some(self.keys.get(key)?.get(point)?.as_dvec3());
        Some(at(before)?.lerp(at((before + 1).min(last))?, place - before as f64))
    }

    /// How many keys there are; 0 where nothing was said.
    #[must_use]
    pub fn key_count(&self) -> usize {
        self.keys.len()
    }

    /// The vectors of all points at each key; nothing where nothing was said.
    #[must_use]
    pub fn positions(&self) -> &[Vec<Vec3>] {
        &self.keys
    }

    /// All keys that tell something: all where points move, the first alone where they do not.
    pub(crate) fn distinct(&self) -> &[Vec<Vec3>] {
        if self.moves() { &self.keys } else { self.keys.get(..1).unwrap_or_default() }
    }

    /// Refuses motion of another number of points than there are.
    pub(crate) fn check(&self, what: &'static str, points: usize) -> Result<(), RenderError> {
        match self.keys.first() {
            Some(key) if key.len() != points => {
                let found = format!("of {} points", key.len());
                Err(RenderError::argument(what, found, "as many as there are to move"))
            }
            _ => Ok(()),
        }
    }
}

fn check_count(what: &'static str, found: &[Vec3], positions: &[Vec3]) -> Result<(), RenderError> {
    if found.len() == positions.len() {
        return Ok(());
    }
    let found = format!("{} for {} points", found.len(), positions.len());
    Err(RenderError::argument(what, found, "one a point"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn velocities_lead_from_opening_to_closing() {
        let motion = Motion::velocities(&[Vec3::ONE], &[Vec3::X * 8.0], [-0.25, 0.5]).unwrap();
        assert_eq!(motion.distinct(), [vec![Vec3::new(-1.0, 1.0, 1.0)], vec![Vec3::new(5.0, 1.0, 1.0)]]);
        assert!(motion.moves() && motion.key_count() == 2);
        let instant = Motion::velocities(&[Vec3::ONE], &[Vec3::X * 8.0], [0.5, 0.5]).unwrap();
        assert_eq!(instant.distinct(), [vec![Vec3::new(5.0, 1.0, 1.0)]]);
    }

    #[test]
    fn accelerations_bend_the_way() {
        let bend = |keys| {
            let up = [Vec3::Y * 8.0];
            Motion::accelerations(&[Vec3::ZERO], &[Vec3::X], &up, [-0.5, 0.5], keys).unwrap()
        };
        let at = |x: f32, y: f32| vec![Vec3::new(x, y, 0.0)];
        assert_eq!(bend(2).distinct(), [at(-0.5, 1.0), at(0.5, 1.0)]);
        assert_eq!(bend(3).distinct(), [at(-0.5, 1.0), at(0.0, 0.0), at(0.5, 1.0)]);
    }

    #[test]
    fn what_does_not_move_is_still() {
        let keys = Motion::keys(vec![vec![Vec3::ONE; 3]; 5]).unwrap();
        assert!(!keys.moves() && keys.distinct().len() == 1);
        assert!(!Motion::STILL.moves() && Motion::STILL.distinct().is_empty());
    }

    #[test]
    fn impossible_motion_is_refused() {
        assert!(Motion::keys(vec![]).is_err());
        assert!(Motion::keys(vec![vec![Vec3::ZERO], vec![]]).is_err());
        let told = Motion::keys(vec![vec![Vec3::ZERO, Vec3::NAN]]).unwrap_err().to_string();
        assert!(told.contains("point 1 of key 0"), "{told}");
        let told = Motion::velocities(&[Vec3::ZERO; 2], &[Vec3::X], [0.0, 1.0]).unwrap_err().to_string();
        assert_eq!(told, "number of velocities is 1 for 2 points, expected one a point");
        assert!(Motion::accelerations(&[Vec3::ZERO], &[Vec3::X], &[], [0.0, 1.0], 3).is_err());
        assert!(Motion::accelerations(&[Vec3::ZERO], &[Vec3::X], &[Vec3::X], [0.0, 1.0], 0).is_err());
        assert!(Motion::STILL.check("hair motion", 3).is_ok());
        assert!(Motion::keys(vec![vec![Vec3::ZERO]]).unwrap().check("hair motion", 3).is_err());
    }
}
