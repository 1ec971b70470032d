//! From arguments to a scene and a camera.

use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use fibre_scattering::HairParameters;
use glam::{DVec3, Vec3};
use groom::UpAxis;
use groom_formats::{Loaded, ReadOptions};
use hair_render::{
    AreaLight, Camera, Environment, HairColor, HairMaterial, HairObject, Material, MovingCamera, Scene,
    SceneDescription, Transparency,
};
use moving_mesh::RestPose;
use moving_scene::{FilmedMesh, GroomAt, MeshAsked, MovingSceneError, animation_named};

use crate::args::{Args, Fibre, Input, Light, Up, View};
use crate::motion_args::MotionArgs;

/// What the arguments describe.
pub struct Described {
    pub description: SceneDescription,
    /// What is odd about the files.
    pub words: Vec<String>,
    /// What the picture is of, in time.
    pub moment: Moment,
}

/// When a picture was taken.
#[derive(Clone, Copy, Debug, serde::Serialize)]
pub struct Moment {
    /// The frame; none where nobody named one and the groom has none.
    pub frame: Option<f64>,
    /// Frames a second.
    pub frame_rate: f64,
    /// How long the shutter was open, in seconds.
    pub exposure_seconds: f64,
}

/// Reads everything the scene is made of.
pub fn describe(args: &Args) -> Result<Described> {
    let path = args.groom.as_deref().context("no groom given")?;
    let motion_args = &args.motion;
    let exposure = motion_args.exposure()?;
    let read = GroomAt::read(path, &read_options(&args.input), motion_args.frame).map_err(of_option)?;
    let mut words: Vec<String> =
        read.loaded.warnings.iter().map(|w| format!("{}: {w}", path.display())).collect();
    words.extend(read.loaded.repairs.iter().cloned());
    let frame = read.frame();
    let asked = MeshAsked {
        animation: animation_named(motion_args.mesh_animation.as_deref()),
        rest: RestPose::Nodes,
        moves: frame.is_some(),
        frames: frame.map(|frame| (frame, frame)),
        keys: read.keys(&exposure),
        groom_rate: read.frame_rate(),
        ..MeshAsked::default()
    };
    let open = |path: &PathBuf| FilmedMesh::open(path, &asked, &exposure);
    let meshes: Vec<FilmedMesh> = args.input.mesh.iter().map(open).collect::<Result<_, _>>()?;
    let mesh_rate = meshes.iter().find_map(|mesh| mesh.mesh().frame_rate());
    let frame_rate = exposure.rate(read.frame_rate(), mesh_rate);
    let motion = read.motion(&exposure, frame_rate).map_err(of_option)?;
    words.extend(read.outside());
    words.extend(meshes.iter().filter_map(|mesh| mesh.outside(frame?, frame_rate)));
    let pose = |mesh: &FilmedMesh| mesh.object(frame, &exposure, frame_rate, args.input.mesh_albedo);
    let meshes = meshes.iter().map(pose).collect::<Result<_, _>>()?;
    let shutter = exposure.shutter;
    let [open, close] = shutter.seconds(frame_rate)?;
    let moment = Moment { frame, frame_rate, exposure_seconds: close - open };
    let Loaded { groom, origin, .. } = read.loaded;
    let hair = HairObject { origin, motion, ..HairObject::still(groom, material(&args.fibre)?) };
    let description = SceneDescription {
        hair: vec![hair],
        meshes,
        environment: Some(environment(&args.light)?),
        lights: Vec::new(),
        shutter,
    };
    Ok(Described { description, words, moment })
}

/// The same error, with the option it is about.
fn of_option(error: MovingSceneError) -> anyhow::Error {
    match error {
        MovingSceneError::Frame(_) | MovingSceneError::NoMotion { .. } => anyhow::anyhow!("--{error}"),
        other => other.into(),
    }
}

/// The square lights, which face `target`.
pub fn lights(light: &Light, target: DVec3) -> Result<Vec<AreaLight>> {
    let square = |numbers: [f64; 5]| {
        let [x, y, z, side, radiance] = numbers;
        let radiance = Vec3::splat(radiance as f32);
        let square = AreaLight::facing(DVec3::new(x, y, z), target, side as f32, side as f32, radiance)?;
        Ok(AreaLight { visible_camera: light.visible_lights, ..square })
    };
    light.area_light.iter().map(|numbers| square(numbers.0)).collect()
}

/// The camera that the view asks for, about the scene's bounds where it leaves things open, and its way while
/// the shutter is open.
pub fn camera(view: &View, motion: &MotionArgs, scene: &Scene) -> Result<MovingCamera> {
    let opening = still_camera(view, scene)?;
    let Some(option) = motion.camera_moves() else { return Ok(opening.into()) };
    ensure!(motion.blurs(), "--blur off leaves nothing for {option} to move");
    // Plus nothing: the middle of no length is -0.
    let (instant, open) = (scene.shutter().is_instant(), scene.shutter().open() + 0.0);
    ensure!(!instant, "a shutter of {open}:{open} leaves no time for {option}; expected one that stays open");
    let closing = View {
        azimuth: motion.azimuth_to.unwrap_or(view.azimuth),
        elevation: motion.elevation_to.unwrap_or(view.elevation),
        distance: motion.distance_to.or(view.distance),
        fov: motion.fov_to.unwrap_or(view.fov),
        look_at: motion.look_at_to.or(view.look_at),
        from: motion.from_to.or(view.from),
        ..*view
    };
    // A camera that was not told how far away it is stays as far as at the opening, also where it zooms.
    let closing = match (closing.distance, closing.from) {
        (None, None) => {
            let distance = (opening.position() - opening.target()).length();
            View { distance: Some(distance), ..closing }
        }
        _ => closing,
    };
    Ok(MovingCamera::new(vec![opening, still_camera(&closing, scene)?])?)
}

fn still_camera(view: &View, scene: &Scene) -> Result<Camera> {
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
