//! Where the picture is taken from.

use glam::{DMat3, DMat4, DVec3, DVec4, Vec3};

use crate::{Bounds, RenderError};

/// A perspective camera in world metres, Y up, looking from `position` to `target`.
///
/// Kept in `f64` so that a scene a million metres away is framed as sharply as one at the origin.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    position: DVec3,
    target: DVec3,
    up: DVec3,
    vertical_fov: f64,
    /// Of a camera that was placed on an orbit.
    orbit: Option<Orbit>,
}

/// Where on a sphere about its target a camera stands; radians.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Orbit {
    distance: f64,
    azimuth: f64,
    elevation: f64,
}

impl Camera {
    /// A camera at `position` that looks at `target` with `up` upwards in the picture;
    /// `vertical_fov` is the whole angle from the lower to the upper edge, in radians.
    ///
    /// # Errors
    /// [`RenderError::Argument`] for a value that is not finite, a field of view outside (0, pi),
    /// a target at the camera, or an up direction along the view.
    pub fn look_at(
        position: DVec3,
        target: DVec3,
        up: DVec3,
        vertical_fov: f64,
    ) -> Result<Self, RenderError> {
        let camera = Camera { position, target, up, vertical_fov, orbit: None };
        camera.check()?;
        Ok(camera)
    }

    /// Whether a picture can be taken with it.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        let Camera { position, target, up, vertical_fov, .. } = *self;
        if !(position.is_finite() && target.is_finite() && up.is_finite()) {
            return Err(RenderError::argument("camera", "not finite", "finite numbers"));
        }
        if !(vertical_fov > 0.0 && vertical_fov < std::f64::consts::PI) {
            return Err(RenderError::argument(
                "vertical field of view",
                vertical_fov.to_degrees(),
                "between 0 and 180 degrees",
            ));
        }
        let Some(forward) = (target - position).try_normalize() else {
            return Err(RenderError::argument("camera target", target, "a point away from the camera"));
        };
        if forward.cross(up).length() <= 1e-9 * up.length() || up == DVec3::ZERO {
            return Err(RenderError::argument("camera up", up, "a direction across the view"));
        }
        Ok(())
    }

    /// A camera on a sphere about `target`. Azimuth 0 stands on the +Z side and grows towards +X
    /// (anticlockwise seen from above); elevation grows upwards; both in radians.
    ///
    /// Straight above or below, "up" in the picture is what lies beyond the target at that azimuth.
    ///
    /// # Errors
    /// As [`Camera::look_at`]; the distance must be above 0.
    pub fn orbit(
        target: DVec3,
        distance: f64,
        azimuth: f64,
        elevation: f64,
        vertical_fov: f64,
    ) -> Result<Self, RenderError> {
        if distance.is_nan() || distance <= 0.0 {
            return Err(RenderError::argument("camera distance", distance, "above 0"));
        }
        let camera = Camera::on(Orbit { distance, azimuth, elevation }, target, vertical_fov);
        camera.check()?;
        Ok(camera)
    }

    fn on(orbit: Orbit, target: DVec3, vertical_fov: f64) -> Camera {
        let (sin_azimuth, cos_azimuth) = orbit.azimuth.sin_cos();
        let (sin_elevation, cos_elevation) = orbit.elevation.sin_cos();
        let horizontal = DVec3::new(sin_azimuth, 0.0, cos_azimuth);
        let back = horizontal * cos_elevation + DVec3::Y * sin_elevation;
        let up = DVec3::Y * cos_elevation - horizontal * sin_elevation;
        Camera { position: target + back * orbit.distance, target, up, vertical_fov, orbit: Some(orbit) }
    }

    /// The camera at the share `share` (0..1) of the way to `to`: on the arc where both stand on orbits,
    /// else straight.
    pub(crate) fn toward(&self, to: &Camera, share: f64) -> Camera {
        let mix = |a: f64, b: f64| a + (b - a) * share;
        let target = self.target.lerp(to.target, share);
        let vertical_fov = mix(self.vertical_fov, to.vertical_fov);
        if let (Some(a), Some(b)) = (self.orbit, to.orbit) {
            let orbit = Orbit {
                distance: mix(a.distance, b.distance),
                azimuth: mix(a.azimuth, b.azimuth),
                elevation: mix(a.elevation, b.elevation),
            };
            return Camera::on(orbit, target, vertical_fov);
        }
        let up = self.up.normalize_or_zero().lerp(to.up.normalize_or_zero(), share);
        let position = self.position.lerp(to.position, share);
        Camera { position, target, up, vertical_fov, orbit: None }
    }

    /// An orbit camera far enough away that the sphere about `bounds` fits the picture, with a
    /// margin of 2 %; `aspect` is width over height. The same distance serves every azimuth, so a
    /// turntable neither breathes nor cuts. An empty scene (`None`) and a single point are framed as a
    /// unit sphere.
    ///
    /// # Errors
    /// As [`Camera::look_at`]; the aspect must be above 0.
    pub fn fit(
        bounds: Option<Bounds>,
        azimuth: f64,
        elevation: f64,
        vertical_fov: f64,
        aspect: f64,
    ) -> Result<Self, RenderError> {
        if !(aspect > 0.0 && aspect.is_finite()) {
            return Err(RenderError::argument("aspect", aspect, "width over height, above 0"));
        }
        let (center, radius) = bounds.map_or((DVec3::ZERO, 0.0), |b| (b.center(), b.radius()));
        let radius = if radius > 0.0 { radius } else { 1.0 };
        let half_height = 0.5 * vertical_fov;
        let half = half_height.min((half_height.tan() * aspect).atan());
        let distance = 1.02 * radius / half.sin();
        Camera::orbit(center, distance, azimuth, elevation, vertical_fov)
    }

    /// Where the camera stands.
    #[must_use]
    pub fn position(&self) -> DVec3 {
        self.position
    }

    /// What it looks at.
    #[must_use]
    pub fn target(&self) -> DVec3 {
        self.target
    }

    /// The whole angle from the lower to the upper edge of the picture, in radians.
    #[must_use]
    pub fn vertical_fov(&self) -> f64 {
        self.vertical_fov
    }

    /// The matrix from world to camera space as EXR's `worldToCamera` wants it: left-handed, x right,
    /// y up, z forward; columns of a matrix that multiplies column vectors.
    #[must_use]
    pub fn camera_from_world(&self) -> DMat4 {
        let axes = self.axes();
        let rotation = DMat3::from_cols(axes.right, axes.up, axes.forward).transpose();
        DMat4::from_mat3(rotation) * DMat4::from_translation(-self.position)
    }

    /// The matrix from world space to EXR's `worldToNDC`: (0, 0) in the upper left and (1, 1) in the lower right
    /// corner of a picture that is `aspect` times as wide as high, after the division by w; z, which readers
    /// drop, is 1 - 1 m / distance. Columns of a matrix that multiplies column vectors.
    #[must_use]
    pub fn ndc_from_world(&self, aspect: f64) -> DMat4 {
        let half_height = (0.5 * self.vertical_fov).tan();
        let projection = DMat4::from_cols(
            DVec4::new(0.5 / (half_height * aspect), 0.0, 0.0, 0.0),
            DVec4::new(0.0, -0.5 / half_height, 0.0, 0.0),
            DVec4::new(0.5, 0.5, 1.0, 1.0),
            DVec4::new(0.0, 0.0, -1.0, 0.0),
        );
        projection * self.camera_from_world()
    }

    fn axes(&self) -> Axes {
        // `look_at` made sure that none of these is zero.
        let forward = (self.target - self.position).normalize_or_zero();
        let right = forward.cross(self.up).normalize_or_zero();
        Axes { right, up: right.cross(forward), forward }
    }

    /// The camera as the render loop uses it: moved by `-center`, ready to make rays.
    pub(crate) fn lens(&self, center: DVec3, width: u32, height: u32) -> Lens {
        let axes = self.axes();
        let pixel = 2.0 * (0.5 * self.vertical_fov).tan() / f64::from(height);
        let corner = axes.forward - axes.right * (0.5 * f64::from(width) * pixel)
            + axes.up * (0.5 * f64::from(height) * pixel);
        Lens {
            origin: (self.position - center).as_vec3(),
            corner: corner.as_vec3(),
            right: (axes.right * pixel).as_vec3(),
            down: (-axes.up * pixel).as_vec3(),
        }
    }
}

struct Axes {
    right: DVec3,
    up: DVec3,
    forward: DVec3,
}

/// A camera placed in the recentred scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lens {
    pub origin: Vec3,
    corner: Vec3,
    right: Vec3,
    down: Vec3,
}

impl Lens {
    /// The unit direction through the point `x`, `y` of the picture, in pixels from its upper left corner.
    pub fn direction(&self, x: f32, y: f32) -> Vec3 {
        (self.corner + self.right * x + self.down * y).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn right_is_right_and_up_is_up() {
        let camera = Camera::orbit(DVec3::ZERO, 4.0, 0.0, 0.0, 1.0).unwrap();
        assert_eq!(camera.position(), DVec3::new(0.0, 0.0, 4.0));
        let lens = camera.lens(DVec3::ZERO, 10, 20);
        assert!((lens.direction(5.0, 10.0) - Vec3::NEG_Z).length() < 1e-6);
        assert!(lens.direction(9.0, 10.0).x > 0.0 && lens.direction(5.0, 1.0).y > 0.0);
        let edge = lens.direction(5.0, 0.0);
        assert!((edge.y.atan2(-edge.z) - 0.5).abs() < 1e-6);
    }

    #[test]
    fn azimuth_turns_towards_x_and_poles_work() {
        let camera = Camera::orbit(DVec3::ZERO, 2.0, 90f64.to_radians(), 0.0, 0.5).unwrap();
        assert!((camera.position() - DVec3::X * 2.0).length() < 1e-12);
        let above = Camera::orbit(DVec3::ZERO, 2.0, 0.0, 90f64.to_radians(), 0.5).unwrap();
        assert!(above.lens(DVec3::ZERO, 2, 2).direction(1.0, 0.0).z < 0.0);
    }

    /// Where the matrix puts a point is where the ray through that place of the picture meets it.
    #[test]
    fn the_ndc_matrix_agrees_with_the_rays() {
        let place = DVec3::new(30.0, -2.0, 5.0);
        let camera = Camera::orbit(place, 4.0, 0.7, 0.4, 0.6).unwrap();
        let (width, height) = (320u32, 180u32);
        let (lens, matrix) =
            (camera.lens(camera.position(), width, height), camera.ndc_from_world(320.0 / 180.0));
        for (x, y, distance) in [(0.0, 0.0, 1.0), (320.0, 180.0, 3.0), (40.0, 160.0, 9.0), (160.0, 90.0, 4.0)]
        {
            let point = camera.position() + lens.direction(x, y).as_dvec3() * distance;
            let found = matrix.project_point3(point);
            let expected = (f64::from(x) / 320.0, f64::from(y) / 180.0);
            assert!((found.x - expected.0).abs() < 1e-6 && (found.y - expected.1).abs() < 1e-6, "{found}");
        }
        assert!(matrix.determinant().abs() > 1e-9, "it can be turned round");
    }

    #[test]
    fn a_fitted_sphere_touches_no_edge() {
        let bounds = Bounds { min: DVec3::splat(1.0e6), max: DVec3::splat(1.0e6 + 2.0) };
        for aspect in [0.5, 1.0, 3.0] {
            let camera = Camera::fit(Some(bounds), 0.7, 0.3, 0.6, aspect).unwrap();
            let distance = (camera.position() - bounds.center()).length();
            let sphere = (bounds.radius() / distance).asin();
            let half = 0.3f64.min((0.3f64.tan() * aspect).atan());
            assert!(sphere < half && sphere > 0.95 * half);
        }
    }

    #[test]
    fn impossible_cameras_are_refused() {
        let look = |p, t, u, f| Camera::look_at(p, t, u, f).is_err();
        assert!(look(DVec3::ZERO, DVec3::ZERO, DVec3::Y, 1.0));
        assert!(look(DVec3::ZERO, DVec3::Y, DVec3::Y, 1.0));
        assert!(look(DVec3::ZERO, DVec3::X, DVec3::Y, 0.0));
        assert!(look(DVec3::NAN, DVec3::X, DVec3::Y, 1.0));
        assert!(!look(DVec3::ZERO, DVec3::X, DVec3::Y, 1.0));
        for distance in [0.0, -1.0, f64::NAN] {
            assert!(Camera::orbit(DVec3::ZERO, distance, 0.0, 0.0, 1.0).is_err());
        }
        let point = Bounds { min: DVec3::ONE, max: DVec3::ONE };
        assert!(Camera::fit(Some(point), 0.0, 0.0, 1.0, 1.0).is_ok());
    }
}
