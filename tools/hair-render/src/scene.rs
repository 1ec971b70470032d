//! From arguments to a scene and a camera.

use anyhow::{Context, Result, ensure};
use fibre_scattering::HairParameters;
use glam::{DVec3, Vec3};
use groom::UpAxis;
use groom_formats::ReadOptions;
use hair_render::{
    AreaLight, Camera, Environment, HairColor, HairMaterial, HairObject, Material, MeshObject, Scene,
    SceneDescription, Transparency,
};
use moving_mesh::TriangleMesh;

use crate::args::{Args, Fibre, Input, Light, Up, View};

/// Reads everything the scene is made of; what is odd about the files comes along in words.
pub fn describe(args: &Args) -> Result<(SceneDescription, Vec<String>)> {
    let path = args.groom.as_deref().context("no groom given")?;
    let loaded = groom_formats::read(path, &read_options(&args.input))?;
    let mut words: Vec<String> = loaded.warnings.iter().map(|w| format!("{}: {w}", path.display())).collect();
    words.extend(loaded.repairs);
    let hair = HairObject::still(loaded.groom, material(&args.fibre)?);
    let meshes: Result<Vec<MeshObject>> = args
        .input
        .mesh
        .iter()
        .map(|path| Ok(MeshObject::still(TriangleMesh::open(path)?, args.input.mesh_albedo)))
        .collect();
    let description = SceneDescription {
        hair: vec![hair],
        meshes: meshes?,
        environment: Some(environment(&args.light)?),
        ..SceneDescription::default()
    };
    Ok((description, words))
}

/// The square lights, which face `target`.
pub fn lights(light: &Light, target: DVec3) -> Result<Vec<AreaLight>> {
    let square = |numbers: [f64; 5]| {
        let [x, y, z, side, radiance] = numbers;
        let radiance = Vec3::splat(radiance as f32);
        Ok(AreaLight::facing(DVec3::new(x, y, z), target, side as f32, side as f32, radiance)?)
    };
    light.area_light.iter().map(|numbers| square(numbers.0)).collect()
}

/// The camera that the view asks for, about the scene's bounds where it leaves things open.
pub fn camera(view: &View, scene: &Scene) -> Result<Camera> {
    let fov = view.fov.to_radians();
    let (azimuth, elevation) = (view.azimuth.to_radians(), view.elevation.to_radians());
    let aspect = f64::from(view.width) / f64::from(view.height.max(1));
    let fitted = Camera::fit(scene.bounds(), azimuth, elevation, fov, aspect)?;
    let target = view.look_at.map_or(fitted.target(), |at| at.vector());
    if let Some(from) = view.from {
        return Ok(Camera::look_at(from.vector(), target, DVec3::Y, fov)?);
    }
    let fitted_distance = (fitted.position() - fitted.target()).length();
    Ok(Camera::orbit(target, view.distance.unwrap_or(fitted_distance), azimuth, elevation, fov)?)
}

fn read_options(input: &Input) -> ReadOptions {
    ReadOptions {
        up_axis: input.input_up.map(|up| match up {
            Up::Y => UpAxis::Y,
            Up::Z => UpAxis::Z,
        }),
        meters_per_unit: input.meters_per_unit,
        repair: input.repair,
        ..ReadOptions::default()
    }
}

fn material(fibre: &Fibre) -> Result<HairMaterial> {
    let transparency = if fibre.use_transparency { Transparency::Stochastic } else { Transparency::Ignored };
    let material = match (&fibre.material, &fibre.preset) {
        (Some(path), _) => Material::open(path)?,
        (None, Some(name)) => Material::preset(name)?,
        (None, None) => told(fibre),
    };
    Ok(HairMaterial { fibre: material, transparency, fixed_offset: fibre.fixed_offset })
}

/// The material of the options that say it one by one.
fn told(fibre: &Fibre) -> Material {
    let color = match (fibre.color, fibre.melanin, fibre.absorption) {
        (Some(color), ..) => HairColor::Color(color),
        (_, Some(melanin), _) => {
            let [concentration, redness] = melanin.0.map(|v| v as f32);
            HairColor::Melanin { concentration, redness }
        }
        (.., Some(sigma)) => HairColor::Absorption(sigma),
        _ => HairColor::default(),
    };
    let parameters = HairParameters {
        beta_m: fibre.beta_m,
        beta_n: fibre.beta_n,
        alpha: fibre.alpha.to_radians(),
        eta: fibre.eta,
        ..HairParameters::default()
    };
    Material { parameters, color, ..Material::default() }
}

fn environment(light: &Light) -> Result<Environment> {
    let (turn, factor) = (light.env_rotate, light.env_intensity);
    ensure!(turn.is_finite(), "--env-rotate is {turn}, expected degrees");
    ensure!(factor.is_finite() && factor >= 0.0, "--env-intensity is {factor}, expected at least 0");
    let environment = match (&light.env, light.env_color) {
        (Some(path), _) => Environment::open(path)?,
        (None, Some(color)) => Environment::constant(color)?,
        (None, None) => Environment::studio(hair_render::STUDIO_WIDTH)?,
    };
    Ok(environment.rotated(turn.to_radians()).scaled(factor))
}
