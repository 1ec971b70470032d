//! What shines, and how it stands to a turning groom.

use std::path::Path;

use glam::{DMat3, DVec3, Vec3};
use hair_render::{AreaLight, Environment};

use crate::TurntableError;
use crate::schema::{AreaSource, EnvironmentSource, Lights};

/// The environment of a pipeline, where there is one.
pub(super) fn environment(lights: &Lights, base: &Path) -> Result<Option<Environment>, TurntableError> {
    let Some(source) = &lights.environment else { return Ok(None) };
    let EnvironmentSource { file, constant, rotation, intensity, .. } = source;
    let environment = match (file, constant) {
        (Some(file), _) => Environment::open(&base.join(file))?,
        (None, Some(radiance)) => Environment::constant(Vec3::from_array(*radiance))?,
        (None, None) => Environment::studio(hair_render::STUDIO_WIDTH)?,
    };
    Ok(Some(environment.rotated(rotation.to_radians()).scaled(*intensity)))
}

pub(super) fn areas(lights: &Lights) -> Result<Vec<AreaLight>, TurntableError> {
    lights.area.iter().map(area).collect()
}

fn area(source: &AreaSource) -> Result<AreaLight, TurntableError> {
    let (center, target) = (DVec3::from_array(source.position), DVec3::from_array(source.target));
    let [width, height] = source.size;
    let light = AreaLight::facing(center, target, width, height, Vec3::from_array(source.radiance))?;
    Ok(AreaLight { visible_camera: source.visible_camera, ..light })
}

/// A light turned about the world's upright axis by `azimuth` radians.
pub(super) fn turned(light: AreaLight, azimuth: f64) -> AreaLight {
    let turn = DMat3::from_rotation_y(azimuth);
    AreaLight {
        center: turn * light.center,
        edge_u: turn.as_mat3() * light.edge_u,
        edge_v: turn.as_mat3() * light.edge_v,
        ..light
    }
}
