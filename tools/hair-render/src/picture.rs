//! Rendering one picture.

use std::path::Path;
use std::time::Instant;

use anyhow::{Context, Result, ensure};
use command_line::{Meter, Outcome, ProgressStyle};
use frame_view::Show;
use glam::{DVec3, Vec3};
use hair_render::{
    Backdrop, Checkpoint, Frame, Rendered, Scene, SceneDescription, ToneMapping, check_output,
    checkpoint_path, tone_map,
};
use whole_file::clear_stale;

pub use command_line::say;

use crate::args::Args;
use crate::asked::{metadata, settings, usual_passes};
use crate::report::{Blurred, Extra, leave_out, report, tables};
use crate::scene::Described;
use crate::watch::Watch;
use crate::{color_match, digest, keeping, scene};

/// Writes the studio environment.
pub fn write_studio(path: &Path) -> Result<Outcome> {
    check_output(path, "exr")?;
    hair_render::write_studio(path, hair_render::STUDIO_WIDTH)?;
    Ok(Outcome::Good)
}

/// Renders what the arguments ask for.
pub fn render(args: &Args) -> Result<Outcome> {
    let start = Instant::now();
    // From here on a signal is taken between two pixels, and leaves a checkpoint.
    command_line::on_interrupt_ask();
    command_line::on_snapshot_ask();
    let meter = Meter::new(args.farm.progress, "rendering");
    let outcome = rendered(args, start, &meter);
    meter.finish();
    if let Err(fault) = &outcome {
        meter.fail(&format!("{fault:#}"));
    }
    outcome
}

fn rendered(args: &Args, start: Instant, meter: &Meter) -> Result<Outcome> {
    let output = args.output.as_deref().context("no output given")?;
    let mut settings = settings(args);
    settings.check()?;
    check_output(output, "exr")?;
    args.png.as_deref().map_or(Ok(()), |png| check_output(png, "png"))?;
    let speaks = args.farm.progress != ProgressStyle::Bar;
    let stops = args.exposure;
    ensure!((-64.0..=64.0).contains(&stops), "--exposure is {stops}, expected -64..=64 stops");
    ensure!(!(args.json && speaks), "--json and --progress would both write to stdout");
    let Described { mut description, words, moment } = scene::describe(args)?;
    words.iter().for_each(|word| say(&format!("warning: {word}")));
    let target = args.view.look_at.map_or_else(|| middle(&description), |at| at.vector());
    description.lights = scene::lights(&args.light, target)?;
    settings.aovs = args.quality.aovs.unwrap_or_else(|| usual_passes(&description));
    let digest = digest::of(args, &description, &settings)?;
    clear_stale(output);
    clear_stale(checkpoint_path(output));
    if args.farm.skip_existing
        && let Some(frame) = keeping::existing(output, &digest)
    {
        return skip(args, output, &digest, &frame);
    }
    let picked = if args.fibre.match_color { Some(color_match::picked(&description.hair)?) } else { None };
    if args.explain {
        leave_out(&hair_render::explain(&description, &settings));
    }
    let moves = description.moves();
    let mut scene = Scene::build(description)?;
    tables(&scene, args.explain);
    let camera = scene::camera(&args.view, &args.motion, &scene)?;
    if args.explain {
        leave_out(&hair_render::explain_camera(&camera, moves));
    }
    let color_match = match picked {
        Some(color) => match color_match::run(color, &mut scene, &camera.at(0.5), &settings)? {
            Some(found) => Some(found),
            None => return Ok(Outcome::TryAgain),
        },
        None => None,
    };
    let begun = if args.farm.no_resume { None } else { keeping::taken_up(output, &digest) };
    let told = |blurred| metadata(args, camera.at(0.5), moment, blurred, &digest);
    let from = begun.as_ref().map_or(0, Checkpoint::spp);
    let name = output.display().to_string();
    let show = Show::new(args.farm.display_server.as_deref(), &name, args.farm.preview, args.exposure);
    let watch = Watch::new(&args.farm, output, told(moves || camera.moves()), meter, show, (start, from));
    let frame = match hair_render::render_from(&scene, &camera, &settings, &digest, begun, &watch)? {
        Rendered::Done(frame) => frame,
        Rendered::Stopped(checkpoint) => return stopped(&checkpoint, output),
    };
    meter.finish();
    frame.write_exr(output, &told(frame.report.motion.is_some()))?;
    write_png(args, &frame)?;
    keeping::clear(output, &digest, settings.spp)?;
    watch.done(&frame);
    let blur = frame.report.motion.is_some().then(|| Blurred::of(&scene));
    let moment = (moment.frame.is_some() || blur.is_some()).then_some(moment);
    let tables = scene.medulla_tables().cloned().collect();
    report(args, &frame, Extra { color_match, tables, moment, blur, skipped: false }, output)?;
    Ok(Outcome::Good)
}

/// Says that the output is there, and makes what goes with it.
fn skip(args: &Args, output: &Path, digest: &str, frame: &Frame) -> Result<Outcome> {
    say(&format!("{}: up to date, nothing to do", output.display()));
    write_png(args, frame)?;
    keeping::clear(output, digest, args.quality.spp)?;
    report(args, frame, Extra { skipped: true, ..Extra::default() }, output)?;
    Ok(Outcome::Good)
}

/// Keeps what was rendered, so that the same command goes on from there.
fn stopped(checkpoint: &Checkpoint, output: &Path) -> Result<Outcome> {
    let (spp, asked, part) = (checkpoint.spp(), checkpoint.spp_asked(), checkpoint_path(output));
    checkpoint.write(&part)?;
    say(&format!("stopped at {spp} of {asked} samples a pixel; kept in {}", part.display()));
    Ok(Outcome::TryAgain)
}

fn write_png(args: &Args, frame: &Frame) -> Result<()> {
    if let Some(png) = &args.png {
        let backdrop = Backdrop::Solid(Vec3::splat(0.18));
        let mapping = ToneMapping { exposure: args.exposure, backdrop, ..ToneMapping::default() };
        tone_map(frame, &mapping).write_png(png)?;
    }
    Ok(())
}

/// Where lights look when nobody said: the middle of the scene.
fn middle(description: &SceneDescription) -> DVec3 {
    description.bounds().map_or(DVec3::ZERO, |bounds| bounds.center())
}
