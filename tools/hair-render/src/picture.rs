//! Rendering one picture and saying what it cost.

use std::io::Write;
use std::path::Path;
use std::time::Instant;

use anyhow::{Context, Result, ensure};
use command_line::{Bar, Meter, Outcome, ProgressStyle};
use glam::{DVec3, Vec3};
use hair_render::{
    Aov, AovSet, Backdrop, Background, Camera, Checkpoint, ColorMatch, Crop, Frame, FrameReport, LeftOut,
    Metadata, Precision, Progress, RenderSettings, Rendered, Scene, SceneDescription, TableUse, ToneMapping,
    check_output, tone_map,
};
use whole_file::clear_stale;

pub use command_line::say;

use crate::args::{Args, Numbers};
use crate::keeping::part_of;
use crate::scene::{Described, Moment};
use crate::show::Show;
use crate::watch::Watch;
use crate::{color_match, digest, keeping, scene};

/// Shows tiles on a bar and stops on Ctrl-C.
pub struct OnBar(pub Bar);

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
    ensure!(!(args.json && speaks), "--json and --progress would both write to stdout");
    let Described { mut description, words, moment } = scene::describe(args)?;
    words.iter().for_each(|word| say(&format!("warning: {word}")));
    let target = args.view.look_at.map_or_else(|| middle(&description), |at| at.vector());
    description.lights = scene::lights(&args.light, target)?;
    settings.aovs = args.quality.aovs.unwrap_or_else(|| usual_passes(&description));
    let digest = digest::of(args, &description, &settings)?;
    clear_stale(output);
    clear_stale(part_of(output));
    if args.farm.skip_existing
        && let Some(frame) = keeping::existing(output, &digest)
    {
        return skip(args, output, &frame);
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
    keeping::clear(output)?;
    watch.done(&frame);
    let blur = frame.report.motion.is_some().then(|| Blurred::of(&scene));
    let moment = (moment.frame.is_some() || blur.is_some()).then_some(moment);
    let tables = scene.medulla_tables().cloned().collect();
    report(args, &frame, Extra { color_match, tables, moment, blur, skipped: false }, output)?;
    Ok(Outcome::Good)
}

/// Says that the output is there, and makes what goes with it.
fn skip(args: &Args, output: &Path, frame: &Frame) -> Result<Outcome> {
    say(&format!("{}: up to date, nothing to do", output.display()));
    write_png(args, frame)?;
    keeping::clear(output)?;
    report(args, frame, Extra { skipped: true, ..Extra::default() }, output)?;
    Ok(Outcome::Good)
}

/// Keeps what was rendered, so that the same command goes on from there.
fn stopped(checkpoint: &Checkpoint, output: &Path) -> Result<Outcome> {
    let (spp, asked, part) = (checkpoint.spp(), checkpoint.spp_asked(), part_of(output));
    checkpoint.write(&part)?;
    say(&format!("stopped at {spp} of {asked} samples a pixel; kept in {}", part.display()));
    Ok(Outcome::TryAgain)
}

fn leave_out(left_out: &[LeftOut]) {
    for left in left_out {
        say(&format!("left out: {}: {}", left.what, left.why));
    }
}

/// Tells where the medulla tables came from, if that was asked for, and what was wrong with their cache.
fn tables(scene: &Scene, explain: bool) {
    for table in scene.medulla_tables() {
        if let Some(fault) = &table.cache_fault {
            say(&format!("warning: {fault}"));
        }
        if explain {
            let source = match table.built_seconds {
                Some(seconds) => format!("built in {seconds:.2} s"),
                None => format!("taken from {}", table.source),
            };
            say(&format!("hair {}: medulla table {source}, {} bytes", table.object, table.bytes));
        }
    }
}

/// The passes of a picture when nobody named any: those that hold light.
fn usual_passes(description: &SceneDescription) -> AovSet {
    let fur = description.hair.iter().any(|hair| hair.material.fibre.medulla.scatters());
    let scattered = fur.then_some(Aov::Scattered);
    [Aov::R, Aov::Tt, Aov::Trt, Aov::Residual, Aov::Surface].into_iter().chain(scattered).collect()
}

/// What is written into the picture beside its pixels.
fn metadata(args: &Args, camera: Camera, moment: Moment, blurred: bool, digest: &str) -> Metadata {
    let named = moment.frame.map(|number| ("frame".to_owned(), number.to_string()));
    Metadata {
        command: command_line::words(),
        digest: digest.to_owned(),
        camera: Some(camera),
        precision: if args.quality.half { Precision::Half } else { Precision::Float },
        frame_rate: (blurred || named.is_some()).then_some(moment.frame_rate),
        exposure_seconds: blurred.then_some(moment.exposure_seconds),
        extra: named.into_iter().collect(),
    }
}

fn write_png(args: &Args, frame: &Frame) -> Result<()> {
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
        crop: args.view.crop.map(|Numbers([x0, x1, y0, y1])| Crop { x0, x1, y0, y1 }),
        background: if args.light.background { Background::Visible } else { Background::Transparent },
        ..RenderSettings::default()
    }
}

/// Where lights look when nobody said: the middle of the scene.
fn middle(description: &SceneDescription) -> DVec3 {
    description.bounds().map_or(DVec3::ZERO, |bounds| bounds.center())
}

/// What `--json` prints.
#[derive(serde::Serialize)]
struct Report<'a> {
    #[serde(flatten)]
    frame: &'a FrameReport,
    #[serde(skip_serializing_if = "Option::is_none")]
    color_match: Option<ColorMatch>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    medulla_tables: Vec<TableUse>,
    #[serde(flatten)]
    moment: Option<Moment>,
    #[serde(skip_serializing_if = "Option::is_none")]
    blur: Option<Blurred>,
    /// Whether the picture was there already, and these are the figures of then.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    skipped: bool,
}

/// What is told beside the frame.
#[derive(Default)]
struct Extra {
    color_match: Option<ColorMatch>,
    tables: Vec<TableUse>,
    moment: Option<Moment>,
    blur: Option<Blurred>,
    skipped: bool,
}

/// What the motion of a scene costs.
#[derive(serde::Serialize)]
struct Blurred {
    /// Bytes of geometry and tree.
    scene_bytes: usize,
    /// Seconds the tree took to build.
    build_seconds: f64,
}

impl Blurred {
    fn of(scene: &Scene) -> Self {
        let statistics = scene.tracing_statistics();
        Blurred { scene_bytes: statistics.bytes, build_seconds: statistics.build_seconds }
    }
}

fn report(args: &Args, frame: &Frame, extra: Extra, output: &Path) -> Result<()> {
    let Extra { color_match, tables: medulla_tables, moment, blur, skipped } = extra;
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
        let mut json = serde_json::to_string_pretty(&Report {
            frame: report,
            color_match,
            medulla_tables,
            moment,
            blur,
            skipped,
        })?;
        json.push('\n');
        std::io::stdout().lock().write_all(json.as_bytes())?;
    }
    Ok(())
}
