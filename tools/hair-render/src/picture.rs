//! Rendering one picture and saying what it cost.

use std::io::Write;
use std::path::Path;

use anyhow::{Context, Result};
use command_line::{Bar, Outcome};
use glam::{DVec3, Vec3};
use hair_render::{
    Backdrop, Background, Camera, Frame, Metadata, Precision, Progress, RenderError, RenderSettings, Scene,
    ToneMapping, check_output, tone_map,
};

use crate::args::Args;
use crate::scene;

/// Shows tiles on a bar and stops on Ctrl-C.
struct OnBar(Bar);

impl Progress for OnBar {
    fn advance(&self, done: u64, total: u64) {
        self.0.set_len(total);
        self.0.set(done);
    }

    fn cancelled(&self) -> bool {
        command_line::interrupted()
    }
}

/// Writes the studio environment.
pub fn write_studio(path: &Path) -> Result<Outcome> {
    check_output(path, "exr")?;
    hair_render::write_studio(path, hair_render::STUDIO_WIDTH)?;
    Ok(Outcome::Good)
}

/// Renders what the arguments ask for.
pub fn render(args: &Args) -> Result<Outcome> {
    let output = args.output.as_deref().context("no output given")?;
    let settings = settings(args);
    settings.check()?;
    check_output(output, "exr")?;
    args.png.as_deref().map_or(Ok(()), |png| check_output(png, "png"))?;
    let (mut description, words) = scene::describe(args)?;
    words.iter().for_each(|word| say(&format!("warning: {word}")));
    let target = args.view.look_at.map_or_else(|| middle(&description), |at| at.vector());
    description.lights = scene::lights(&args.light, target)?;
    if args.explain {
        for left in hair_render::explain(&description, &settings) {
            say(&format!("left out: {}: {}", left.what, left.why));
        }
    }
    let scene = Scene::build(description)?;
    let camera = scene::camera(&args.view, &scene)?;
    let Some(frame) = trace(&scene, &camera, &settings)? else { return Ok(Outcome::Interrupted) };
    write(args, output, camera, &frame)?;
    report(args, &frame, output)?;
    Ok(Outcome::Good)
}

/// The frame; `None` when Ctrl-C stopped it.
fn trace(scene: &Scene, camera: &Camera, settings: &RenderSettings) -> Result<Option<Frame>> {
    command_line::on_interrupt_ask();
    let bar = OnBar(command_line::progress_bar(1, "rendering"));
    let result = hair_render::render(scene, camera, settings, &bar);
    bar.0.finish();
    match result {
        Err(RenderError::Cancelled) => Ok(None),
        frame => Ok(Some(frame?)),
    }
}

fn write(args: &Args, output: &Path, camera: Camera, frame: &Frame) -> Result<()> {
    let metadata = Metadata {
        command: command_line::words(),
        camera: Some(camera),
        precision: if args.quality.half { Precision::Half } else { Precision::Float },
        ..Metadata::default()
    };
    frame.write_exr(output, &metadata)?;
    if let Some(png) = &args.png {
        let backdrop = Backdrop::Solid(Vec3::splat(0.18));
        let mapping = ToneMapping { exposure: args.exposure, backdrop, ..ToneMapping::default() };
        tone_map(frame, &mapping).write_png(png)?;
    }
    Ok(())
}

fn settings(args: &Args) -> RenderSettings {
    let quality = &args.quality;
    RenderSettings {
        width: args.view.width,
        height: args.view.height,
        spp: quality.spp,
        seed: quality.seed,
        max_bounces: quality.max_bounces,
        roulette_start: quality.roulette_start,
        threads: quality.threads,
        aovs: quality.aovs,
        background: if args.light.background { Background::Visible } else { Background::Transparent },
        ..RenderSettings::default()
    }
}

/// Where lights look when nobody said: the middle of the scene.
fn middle(description: &hair_render::SceneDescription) -> DVec3 {
    description.bounds().map_or(DVec3::ZERO, |bounds| bounds.center())
}

fn report(args: &Args, frame: &Frame, output: &Path) -> Result<()> {
    let report = &frame.report;
    let error = match report.relative_error {
        Some(error) => format!("estimated relative error {:.2} %", 100.0 * error),
        None => "relative error unknown below 2 spp".to_owned(),
    };
    say(&format!("{}: {} spp, {error}, {:.2} s", output.display(), report.spp, report.seconds));
    if report.rejected_samples > 0 {
        say(&format!("warning: {} samples were not finite and count as black", report.rejected_samples));
    }
    if args.json {
        let mut json = serde_json::to_string_pretty(report)?;
        json.push('\n');
        std::io::stdout().lock().write_all(json.as_bytes())?;
    }
    Ok(())
}

fn say(line: &str) {
    // `eprintln!` would panic when nobody reads stderr any more.
    let _ = writeln!(std::io::stderr(), "{line}");
}
