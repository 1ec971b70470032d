//! A camera that moves while the shutter is open.

use glam::DVec3;

use crate::RenderError;
use crate::camera::{Camera, Lens};
use crate::shutter::check_keys;

/// Cameras at one or more times, evenly spread from the shutter's opening to its closing.
///
/// Between two cameras that stand on orbits ([`Camera::orbit`], [`Camera::fit`]) the camera turns on its arc:
/// target, distance, azimuth and elevation change evenly (from azimuth 350 to 370 degrees it is 20, from 350 to
/// 10 it is the long way round). Between others ([`Camera::look_at`]) it goes straight, as does what it looks
/// at, which therefore stays in the middle of the picture; "up" turns from the one to the other. The field of
/// view changes evenly in both.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingCamera {
    keys: Vec<Camera>,
}

/// Places between two cameras at which a way is tried before it is accepted.
const TRIED: u32 = 32;

impl MovingCamera {
    /// A camera that is at each of `keys` in its turn.
    ///
    /// # Errors
    /// [`RenderError::Argument`] for no key or more than 1025, and for a way on which the camera would pass
    /// through what it looks at, or look along its own "up".
    pub fn new(keys: Vec<Camera>) -> Result<Self, RenderError> {
        check_keys(keys.len())?;
        for pair in keys.windows(2).filter(|pair| pair[0] != pair[1]) {
            for place in 1..TRIED {
                between(&pair[0], &pair[1], f64::from(place) / f64::from(TRIED)).check()?;
            }
        }
        Ok(MovingCamera { keys })
    }

    /// Whether it moves at all.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.keys.windows(2).any(|pair| pair[0] != pair[1])
    }

    /// How many keys there are.
    #[must_use]
    pub fn key_count(&self) -> usize {
        self.keys.len()
    }

    /// The camera at `time`, 0 at the shutter's opening and 1 at its closing; before and after it stays where it
    /// is then.
    #[must_use]
    pub fn at(&self, time: f64) -> Camera {
        let last = self.keys.len() - 1;
        let place = time.clamp(0.0, 1.0) * last as f64;
        let before = (place as usize).min(last.saturating_sub(1));
        let after = (before + 1).min(last);
        between(&self.keys[before], &self.keys[after], place - before as f64)
    }

    pub(crate) fn lenses(&self, center: DVec3, width: u32, height: u32) -> Lenses {
        if self.moves() {
            return Lenses::Moving { camera: self.clone(), center, width, height };
        }
        Lenses::Still(self.keys[0].lens(center, width, height))
    }
}

impl From<Camera> for MovingCamera {
    fn from(camera: Camera) -> Self {
        MovingCamera { keys: vec![camera] }
    }
}

fn between(a: &Camera, b: &Camera, share: f64) -> Camera {
    if a == b || share <= 0.0 { *a } else { a.toward(b, share) }
}

/// The lens of every sample.
#[derive(Clone, Debug)]
pub(crate) enum Lenses {
    /// One for all.
    Still(Lens),
    /// One for each time.
    Moving { camera: MovingCamera, center: DVec3, width: u32, height: u32 },
}

impl Lenses {
    /// Whether samples differ by their time.
    pub fn moves(&self) -> bool {
        matches!(self, Lenses::Moving { .. })
    }

    #[inline]
    pub fn at(&self, time: f32) -> Lens {
        match self {
            Lenses::Still(lens) => *lens,
            Lenses::Moving { camera, center, width, height } => {
                camera.at(f64::from(time)).lens(*center, *width, *height)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn orbit(azimuth: f64) -> Camera {
        Camera::orbit(DVec3::ONE, 3.0, azimuth.to_radians(), 0.2, 0.5).unwrap()
    }

    #[test]
    fn an_orbit_camera_turns_on_its_arc() {
        let camera = MovingCamera::new(vec![orbit(350.0), orbit(370.0), orbit(430.0)]).unwrap();
        assert!(camera.moves());
        for (time, azimuth) in [(0.0, 350.0), (0.25, 360.0), (0.5, 370.0), (0.75, 400.0), (1.0, 430.0)] {
            let at = camera.at(time);
            assert!((at.position() - orbit(azimuth).position()).length() < 1e-12, "{time}");
            assert!(((at.position() - at.target()).length() - 3.0).abs() < 1e-12, "{time}");
        }
    }

    #[test]
    fn a_camera_that_looks_at_something_keeps_it_in_the_middle() {
        let look =
            |x: f64, fov| Camera::look_at(DVec3::new(x, 1.0, 5.0), DVec3::ZERO, DVec3::Y, fov).unwrap();
        let camera = MovingCamera::new(vec![look(-1.0, 0.4), look(3.0, 0.8)]).unwrap();
        let middle = camera.at(0.25);
        assert_eq!((middle.position(), middle.target()), (DVec3::new(0.0, 1.0, 5.0), DVec3::ZERO));
        assert!((middle.vertical_fov() - 0.5).abs() < 1e-12);
        let lens = camera.lenses(DVec3::ZERO, 8, 8).at(0.25);
        let direction = lens.direction(4.0, 4.0);
        assert!((direction.as_dvec3() + middle.position().normalize()).length() < 1e-6);
    }

    #[test]
    fn keys_that_are_one_are_one_lens() {
        let camera = MovingCamera::new(vec![orbit(10.0); 3]).unwrap();
        assert!(!camera.moves() && !camera.lenses(DVec3::ZERO, 4, 4).moves());
        assert_eq!(MovingCamera::from(orbit(10.0)).at(0.7), orbit(10.0));
    }

    #[test]
    fn ways_that_cannot_be_filmed_are_refused() {
        let look = |z: f64| Camera::look_at(DVec3::Z * z, DVec3::ZERO, DVec3::Y, 0.5).unwrap();
        assert!(MovingCamera::new(vec![look(1.0), look(-1.0)]).is_err(), "through its target");
        assert!(MovingCamera::new(vec![]).is_err());
        // The same half turn on an orbit is no trouble.
        assert!(MovingCamera::new(vec![orbit(0.0), orbit(180.0)]).is_ok());
    }
}
