//! Shining rectangles.

use glam::{DVec3, Vec3};

use crate::RenderError;

/// A rectangle that sends out the same radiance in every direction of its front side.
///
/// It has no body: it shines, but casts no shadow. The camera sees it where `visible_camera` says so; rays that were
/// scattered meet its light either way, so what it lights does not change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AreaLight {
    /// Its middle, in world metres.
    pub center: DVec3,
    /// One whole edge, in metres.
    pub edge_u: Vec3,
    /// The other whole edge, in metres, square to the first; the front looks along `edge_u x edge_v`.
    pub edge_v: Vec3,
    /// Linear Rec. 709 radiance, at least 0.
    pub radiance: Vec3,
    /// Whether the back shines too.
    pub two_sided: bool,
    /// Whether the camera sees the sides that shine, in front of what is behind them.
    pub visible_camera: bool,
}

impl AreaLight {
    /// A rectangle of `width` x `height` metres at `center` whose front looks at `target`, its width level,
    /// unseen by the camera.
    ///
    /// # Errors
    /// [`RenderError::Argument`] when the target is at the centre, a size is not above 0, or the
    /// radiance is negative or not finite.
    pub fn facing(
        center: DVec3,
        target: DVec3,
        width: f32,
        height: f32,
        radiance: Vec3,
    ) -> Result<Self, RenderError> {
        let Some(front) = (target - center).as_vec3().try_normalize() else {
            return Err(RenderError::argument("area light's target", target, "a point away from the light"));
        };
        let level = front.cross(Vec3::Y).try_normalize().unwrap_or(Vec3::X);
        let light = AreaLight {
            center,
            edge_u: level * width,
            edge_v: front.cross(level) * height,
            radiance,
            two_sided: false,
            visible_camera: false,
        };
        light.check()?;
        Ok(light)
    }

    /// Whether every value is in its range.
    pub(crate) fn check(&self) -> Result<(), RenderError> {
        let area = self.edge_u.cross(self.edge_v).length();
        if !(area > 0.0 && area.is_finite() && self.center.is_finite()) {
            return Err(RenderError::argument("area light's area", area, "above 0 and finite"));
        }
        if self.edge_u.dot(self.edge_v).abs() > 1e-3 * self.edge_u.length() * self.edge_v.length() {
            return Err(RenderError::argument(
                "area light's edges",
                "not square to each other",
                "a rectangle",
            ));
        }
        if !(self.radiance.is_finite() && self.radiance.min_element() >= 0.0) {
            return Err(RenderError::argument("area light's radiance", self.radiance, "finite, at least 0"));
        }
        Ok(())
    }
}

/// A rectangle placed in the recentred scene.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rectangle {
    center: Vec3,
    edge_u: Vec3,
    edge_v: Vec3,
    normal: Vec3,
    area: f32,
    radiance: Vec3,
    two_sided: bool,
    pub visible_camera: bool,
}

/// A point of light as seen from a place: where, how bright, how likely.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    pub direction: Vec3,
    pub distance: f32,
    pub radiance: Vec3,
    /// Per solid angle, as [`Rectangle::sample`] would choose it.
    pub pdf: f32,
}

impl Rectangle {
    pub fn new(light: &AreaLight, scene_center: DVec3) -> Self {
        let across = light.edge_u.cross(light.edge_v);
        Rectangle {
            center: (light.center - scene_center).as_vec3(),
            edge_u: light.edge_u,
            edge_v: light.edge_v,
            normal: across.normalize_or_zero(),
            area: across.length(),
            radiance: light.radiance,
            two_sided: light.two_sided,
            visible_camera: light.visible_camera,
        }
    }

    /// A rough figure of the light that reaches `point`, for choosing among lights; above 0 for a
    /// light that shines at all.
    pub fn importance(&self, point: Vec3) -> f32 {
        let distance_squared = (self.center - point).length_squared().max(self.area);
        self.radiance.element_sum() / 3.0 * self.area / distance_squared
    }

    /// A point of the rectangle, uniform in area, seen from `from`; `None` when it shows no light there.
    pub fn sample(&self, from: Vec3, u: f32, v: f32) -> Option<Seen> {
        let point = self.center + self.edge_u * (u - 0.5) + self.edge_v * (v - 0.5);
        let offset = point - from;
        let distance = offset.length();
        self.seen(offset / distance, distance)
    }

    /// What a ray from `origin` along the unit `direction` sees of the rectangle.
    pub fn intersect(&self, origin: Vec3, direction: Vec3) -> Option<Seen> {
        let distance = (self.center - origin).dot(self.normal) / direction.dot(self.normal);
        if !(distance > 0.0 && distance.is_finite()) {
            return None;
        }
        let local = origin + direction * distance - self.center;
        let inside = |edge: Vec3| local.dot(edge).abs() <= 0.5 * edge.length_squared();
        if inside(self.edge_u) && inside(self.edge_v) { self.seen(direction, distance) } else { None }
    }

    fn seen(&self, direction: Vec3, distance: f32) -> Option<Seen> {
        let cosine = -direction.dot(self.normal);
        let shines = cosine > 0.0 || (self.two_sided && cosine < 0.0);
        let pdf = distance * distance / (cosine.abs() * self.area);
        if shines && pdf.is_finite() && pdf > 0.0 {
            Some(Seen { direction, distance, radiance: self.radiance, pdf })
        } else {
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sampling_and_hitting_agree() {
        let light = AreaLight::facing(DVec3::new(1.0, 2.0, 3.0), DVec3::ZERO, 0.5, 0.25, Vec3::ONE).unwrap();
        let rectangle = Rectangle::new(&light, DVec3::ZERO);
        let from = Vec3::new(0.1, -0.3, 0.2);
        for i in 0..100 {
            let seen =
                rectangle.sample(from, (i as f32 + 0.5) / 100.0, (i * 37 % 100) as f32 / 100.0).unwrap();
            let hit = rectangle.intersect(from, seen.direction).unwrap();
            assert!((hit.distance - seen.distance).abs() < 1e-5 && (hit.pdf / seen.pdf - 1.0).abs() < 1e-4);
        }
        assert!(rectangle.intersect(from, Vec3::NEG_Y).is_none());
        assert!(rectangle.sample(Vec3::new(2.0, 4.0, 6.0), 0.5, 0.5).is_none(), "the back is dark");
    }

    #[test]
    fn impossible_lights_are_refused() {
        assert!(AreaLight::facing(DVec3::ZERO, DVec3::ZERO, 1.0, 1.0, Vec3::ONE).is_err());
        assert!(AreaLight::facing(DVec3::ZERO, DVec3::X, 0.0, 1.0, Vec3::ONE).is_err());
        assert!(AreaLight::facing(DVec3::ZERO, DVec3::X, 1.0, 1.0, Vec3::NEG_ONE).is_err());
        assert!(AreaLight::facing(DVec3::ZERO, DVec3::Y, 1.0, 1.0, Vec3::ONE).is_ok());
    }
}
