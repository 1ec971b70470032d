//! What shines, and how it stands to a turning groom.

use std::path::Path;

use glam::{DMat3, DVec3, Vec3};
use hair_render::{AreaLight, Environment, SceneDescription};

use super::cornell::Room;
use crate::TurntableError;
use crate::schema::{AreaSource, CornellBox, EnvironmentSource, Lights};

/// The lights of a pipeline, loaded.
pub(super) struct Shining {
    environment: Option<Environment>,
    areas: Vec<AreaLight>,
    cornell: Option<CornellBox>,
}

impl Shining {
    pub fn load(lights: &Lights, base: &Path) -> Result<Shining, TurntableError> {
        let areas = lights.area.iter().map(area).collect::<Result<_, _>>()?;
        Ok(Shining { environment: environment(lights, base)?, areas, cornell: lights.cornell.clone() })
    }

    /// Whether nothing but the environment turns with the light.
    pub fn is_sky_alone(&self) -> bool {
        self.areas.is_empty() && self.cornell.is_none()
    }

    /// How far the environment is turned before anything else turns it, in radians.
    pub fn sky_rotation(&self) -> f32 {
        self.environment.as_ref().map_or(0.0, Environment::rotation)
    }

    /// The scene with its lights, and the walls of its room, at `azimuth` radians.
    ///
    /// A groom that turns before a camera that stands is the same picture as a camera that goes round and takes the
    /// lights with it.
    pub fn on(&self, mut scene: SceneDescription, room: Option<Room>, azimuth: f64) -> SceneDescription {
        let turn = |light: &AreaLight| if azimuth == 0.0 { *light } else { turned(*light, azimuth) };
        scene.environment = self.environment.clone().map(|e| e.rotated(azimuth as f32));
        scene.lights = self.areas.iter().map(turn).collect();
        if let (Some(room), Some(settings)) = (room, &self.cornell) {
            scene.meshes.extend(room.walls(azimuth));
            scene.lights.push(room.light(settings, azimuth));
        }
        scene
    }
}

fn environment(lights: &Lights, base: &Path) -> Result<Option<Environment>, TurntableError> {
    let Some(source) = &lights.environment else { return Ok(None) };
    let EnvironmentSource { file, constant, rotation, intensity, .. } = source;
    let environment = match (file, constant) {
        (Some(file), _) => Environment::open(&base.join(file))?,
        (None, Some(radiance)) => Environment::constant(Vec3::from_array(*radiance))?,
        (None, None) => Environment::studio(hair_render::STUDIO_WIDTH)?,
    };
    Ok(Some(environment.rotated(rotation.to_radians()).scaled(*intensity)))
}

fn area(source: &AreaSource) -> Result<AreaLight, TurntableError> {
    let (center, target) = (DVec3::from_array(source.position), DVec3::from_array(source.target));
    let [width, height] = source.size;
    let light = AreaLight::facing(center, target, width, height, Vec3::from_array(source.radiance))?;
    Ok(AreaLight { visible_camera: source.visible_camera, ..light })
}

/// A light turned about the world's upright axis by `azimuth` radians.
fn turned(light: AreaLight, azimuth: f64) -> AreaLight {
    let turn = DMat3::from_rotation_y(azimuth);
    AreaLight {
        center: turn * light.center,
        edge_u: turn.as_mat3() * light.edge_u,
        edge_v: turn.as_mat3() * light.edge_v,
        ..light
    }
}
