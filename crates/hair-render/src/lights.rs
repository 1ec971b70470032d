//! All the light of a scene: one place to ask and one to choose from.

use std::f32::consts::PI;

use glam::{DVec3, Vec3};

use crate::area_light::{Rectangle, Seen};
use crate::environment::direction_at;
use crate::environment_table::EnvironmentTable;
use crate::{AreaLight, Environment};

/// The lights, and how likely each is chosen.
#[derive(Debug)]
pub(crate) struct Lights {
    environment: Option<Environment>,
    /// Only for a picture; a constant environment needs none.
    table: Option<EnvironmentTable>,
    rectangles: Vec<Rectangle>,
    /// Cumulated chances of the rectangles in order; what is left to 1 is the environment's.
    chances: Vec<f32>,
    environment_chance: f32,
}

impl Lights {
    pub fn new(environment: Option<Environment>, lights: &[AreaLight], center: DVec3) -> Self {
        let table = environment.as_ref().and_then(|e| EnvironmentTable::new(e.picture()?));
        let rectangles: Vec<_> = lights.iter().map(|light| Rectangle::new(light, center)).collect();
        let from_everywhere = environment.as_ref().map_or(0.0, |e| 4.0 * PI * e.mean());
        let shares: Vec<f32> = rectangles.iter().map(|r| r.importance(Vec3::ZERO)).collect();
        let total = from_everywhere + shares.iter().sum::<f32>();
        let mut sum = 0.0;
        let chances = shares.iter().map(|share| {
            sum += if total > 0.0 { share / total } else { 0.0 };
            sum
        });
        let chances: Vec<f32> = chances.collect();
        let environment_chance = if from_everywhere > 0.0 { from_everywhere / total } else { 0.0 };
        Lights { environment, table, rectangles, chances, environment_chance }
    }

    /// Whether there is any light to look for.
    pub fn shine(&self) -> bool {
        self.environment_chance > 0.0 || self.chances.last().is_some_and(|&c| c > 0.0)
    }

    /// Whether all light is the same from everywhere.
    pub fn are_even(&self) -> bool {
        self.table.is_none() && self.rectangles.is_empty()
    }

    /// Turns the environment to stand at `angle` radians.
    pub fn turn_environment(&mut self, angle: f32) {
        if let Some(environment) = &mut self.environment {
            environment.turn_to(angle);
        }
    }

    /// A place of light, chosen by importance from three uniform numbers; its density includes the
    /// chance of the light it is on.
    pub fn sample(&self, from: Vec3, [pick, u, v]: [f32; 3]) -> Option<Seen> {
        let index = self.chances.partition_point(|&c| c <= pick);
        if let Some(rectangle) = self.rectangles.get(index) {
            let mut seen = rectangle.sample(from, u, v)?;
            seen.pdf *= self.chance(index);
            return Some(seen);
        }
        let environment = self.environment.as_ref()?;
        let (direction, pdf) = match &self.table {
            Some(table) => {
                let (direction, pdf) = table.sample(u, v)?;
                (environment.to_world(direction), pdf)
            }
            None => (direction_at(u, 1.0 - 2.0 * v), 0.25 / PI),
        };
        let radiance = environment.radiance(direction);
        let pdf = pdf * self.environment_chance;
        (pdf > 0.0).then_some(Seen { direction, distance: f32::INFINITY, radiance, pdf })
    }

    fn chance(&self, index: usize) -> f32 {
        self.chances[index] - if index > 0 { self.chances[index - 1] } else { 0.0 }
    }

    /// The environment's radiance from `direction`.
    pub fn environment_radiance(&self, direction: Vec3) -> Vec3 {
        self.environment.as_ref().map_or(Vec3::ZERO, |e| e.radiance(direction))
    }

    /// The nearest light that the camera sees along a ray before `reach`.
    pub fn seen_by_camera(&self, origin: Vec3, direction: Vec3, reach: f32) -> Option<Vec3> {
        let visible = self.rectangles.iter().filter(|rectangle| rectangle.visible_camera);
        let seen = visible.filter_map(|rectangle| rectangle.intersect(origin, direction));
        let nearest =
            seen.filter(|seen| seen.distance < reach).min_by(|a, b| a.distance.total_cmp(&b.distance));
        nearest.map(|seen| seen.radiance)
    }

    /// Everything that shines along a ray, each with its radiance and the density with which
    /// [`Lights::sample`] finds it; the environment only when nothing was hit.
    pub fn along(
        &self,
        origin: Vec3,
        direction: Vec3,
        hit_distance: Option<f32>,
        mut each: impl FnMut(Vec3, f32),
    ) {
        let reach = hit_distance.unwrap_or(f32::INFINITY);
        for (index, rectangle) in self.rectangles.iter().enumerate() {
            if let Some(seen) = rectangle.intersect(origin, direction).filter(|seen| seen.distance < reach) {
                each(seen.radiance, seen.pdf * self.chance(index));
            }
        }
        if let (None, Some(environment)) = (hit_distance, &self.environment) {
            let density = self.table.as_ref().map_or(0.25 / PI, |t| t.pdf(environment.to_picture(direction)));
            each(environment.radiance(direction), density * self.environment_chance);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chosen_light_is_seen_along_its_ray() {
        let environment = Environment::studio(32).unwrap().rotated(1.0);
        let lights = [
            AreaLight::facing(DVec3::new(0.0, 3.0, 0.5), DVec3::ZERO, 1.0, 2.0, Vec3::ONE).unwrap(),
            AreaLight::facing(DVec3::new(2.0, 0.0, 0.0), DVec3::ZERO, 1.0, 1.0, Vec3::splat(3.0)).unwrap(),
        ];
        let lights = Lights::new(Some(environment), &lights, DVec3::ZERO);
        let mut kinds = [0; 2];
        for i in 0..3000 {
            let u = [0.754_877_7f32, 0.569_840_3, 0.438_579].map(|step| (step * (i as f32 + 0.5)).fract());
            let Some(seen) = lights.sample(Vec3::ZERO, u) else { continue };
            kinds[usize::from(seen.distance.is_infinite())] += 1;
            let mut found = false;
            lights.along(Vec3::ZERO, seen.direction, None, |radiance, pdf| {
                found |= (radiance - seen.radiance).length() < 1e-3 * radiance.length()
                    && (pdf / seen.pdf - 1.0).abs() < 1e-3;
            });
            assert!(found, "sample {i}: {seen:?}");
        }
        assert!(kinds[0] > 100 && kinds[1] > 100, "{kinds:?}");
    }

    #[test]
    fn darkness_offers_nothing() {
        assert!(!Lights::new(None, &[], DVec3::ZERO).shine());
        let black = Environment::from_pixels(2, 1, vec![Vec3::ZERO; 2]).unwrap();
        let lights = Lights::new(Some(black), &[], DVec3::ZERO);
        assert!(!lights.shine() && lights.sample(Vec3::ZERO, [0.5; 3]).is_none());
    }
}
