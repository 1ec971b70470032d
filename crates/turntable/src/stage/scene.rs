//! From what a pipeline says to what the renderer takes.

use std::path::Path;

use glam::{Affine3A, DMat3, DVec3, Mat3, Vec3};
use groom::Groom;
use hair_render::{
    Aov, AovSet, AreaLight, Backdrop, Background, Camera, Curve, Environment, HairMaterial, HairObject,
    MeshObject, RenderSettings, Scene, SceneDescription, ToneMapping,
};
use moving_mesh::TriangleMesh;

use crate::TurntableError;
use crate::schema::{
    AreaSource, Axis, CameraSettings, EnvironmentSource, MeshSource, Pipeline, Render, Tone, ToneCurve,
    Turning,
};

/// Everything of a scene but its lights' direction, which may turn from frame to frame.
pub(super) struct Lit {
    description: SceneDescription,
    turning: Turning,
    built: Option<Scene>,
}

impl Lit {
    /// Loads what the scene needs besides the groom.
    pub fn set(groom: Groom, pipeline: &Pipeline, base: &Path) -> Result<Lit, TurntableError> {
        let fibre = pipeline.material.clone().open_all(base)?;
        let hair = vec![HairObject::still(groom, HairMaterial { fibre, ..HairMaterial::default() })];
        let mesh = pipeline.mesh.as_ref();
        let meshes = mesh.map(|source| mesh_object(source, base)).transpose()?.into_iter().collect();
        let lights = &pipeline.lights;
        let environment = lights.environment.as_ref().map(|e| environment_of(e, base)).transpose()?;
        let lights = lights.area.iter().map(area_light).collect::<Result<_, _>>()?;
        let description =
            SceneDescription { hair, meshes, environment, lights, ..SceneDescription::default() };
        Ok(Lit { description, turning: pipeline.turntable.turn, built: None })
    }

    /// The scene for a camera at `azimuth` (radians). Built once where only the camera turns.
    pub fn scene(&mut self, azimuth: f64) -> Result<&Scene, TurntableError> {
        let scene = match self.built.take() {
            Some(scene) if self.turning == Turning::Camera => scene,
            _ => Scene::build(self.lit_at(azimuth))?,
        };
        Ok(self.built.insert(scene))
    }

    fn lit_at(&mut self, azimuth: f64) -> SceneDescription {
        if self.turning == Turning::Camera {
            return std::mem::take(&mut self.description);
        }
        // A groom that turns before a camera that stands is the same picture as a camera that goes
        // round and takes the lights with it.
        let mut description = self.description.clone();
        description.environment = description.environment.map(|e| e.rotated(azimuth as f32));
        let turn = DMat3::from_rotation_y(azimuth);
        for light in &mut description.lights {
            light.center = turn * light.center;
            light.edge_u = turn.as_mat3() * light.edge_u;
            light.edge_v = turn.as_mat3() * light.edge_v;
        }
        description
    }
}

fn mesh_object(source: &MeshSource, base: &Path) -> Result<MeshObject, TurntableError> {
    let mut mesh = TriangleMesh::open(base.join(&source.file))?;
    let turn = match source.up {
        Some(Axis::Z) => Mat3::from_rotation_x(-std::f32::consts::FRAC_PI_2),
        Some(Axis::Y) | None => Mat3::IDENTITY,
    };
    let unit = source.meters_per_unit.unwrap_or(1.0) as f32;
    if turn != Mat3::IDENTITY || unit != 1.0 {
        mesh.transform(&Affine3A::from_mat3(turn * unit));
    }
    Ok(MeshObject::still(mesh, Vec3::from_array(source.albedo)))
}

fn environment_of(source: &EnvironmentSource, base: &Path) -> Result<Environment, TurntableError> {
    let environment = match (&source.file, source.constant) {
        (Some(file), _) => Environment::open(&base.join(file))?,
        (None, Some(radiance)) => Environment::constant(Vec3::from_array(radiance))?,
        (None, None) => Environment::studio(hair_render::STUDIO_WIDTH)?,
    };
    Ok(environment.rotated(source.rotation.to_radians()).scaled(source.intensity))
}

fn area_light(source: &AreaSource) -> Result<AreaLight, TurntableError> {
    let (center, target) = (DVec3::from_array(source.position), DVec3::from_array(source.target));
    let [width, height] = source.size;
    Ok(AreaLight::facing(center, target, width, height, Vec3::from_array(source.radiance))?)
}

/// The camera of a view; `azimuth` in degrees.
pub(crate) fn camera(
    scene: &Scene,
    settings: &CameraSettings,
    azimuth: f64,
    aspect: f64,
) -> Result<Camera, TurntableError> {
    let (azimuth, elevation) = (azimuth.to_radians(), settings.elevation.to_radians());
    let fov = settings.fov.to_radians();
    let fitted = Camera::fit(scene.bounds(), azimuth, elevation, fov, aspect)?;
    let target = settings.target.map_or(fitted.target(), DVec3::from_array);
    let fitted_distance = (fitted.position() - fitted.target()).length() / settings.zoom;
    let distance = settings.distance.unwrap_or(fitted_distance);
    Ok(Camera::orbit(target, distance, azimuth, elevation, fov)?)
}

/// The renderer's settings of a view; the noise of views must differ, so each has its own seed.
pub(crate) fn render_settings(source: &Render, seed: u64, threads: Option<usize>) -> RenderSettings {
    let all = source.aovs.iter().any(|name| name.eq_ignore_ascii_case("all"));
    let aovs = if all {
        AovSet::all()
    } else {
        source.aovs.iter().filter_map(|name| Aov::from_name(name)).collect()
    };
    RenderSettings {
        width: source.width,
        height: source.height,
        spp: source.spp,
        seed,
        max_bounces: source.max_bounces,
        threads,
        aovs,
        background: if source.transparent { Background::Transparent } else { Background::Visible },
        ..RenderSettings::default()
    }
}

/// How frames become display colours.
pub(crate) fn tone_mapping(tone: &Tone) -> ToneMapping {
    let curve = match tone.curve {
        ToneCurve::Neutral => Curve::Neutral,
        ToneCurve::Clip => Curve::Clip,
    };
    let backdrop = Backdrop::Solid(Vec3::from_array(tone.background));
    ToneMapping { exposure: tone.exposure, curve, backdrop }
}
