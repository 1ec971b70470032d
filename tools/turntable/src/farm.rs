//! `turntable farm`: handing a pipeline to a render farm.

use std::collections::BTreeSet;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use clap::Subcommand;
use command_line::Outcome;
use farm_export::{AfterStep, FarmJob, JobVariant, When, frames_a_task};
use turntable::{Plan, State, Step, StepKind};

use crate::args::Choice;

/// Handing a pipeline to a render farm.
#[derive(Debug, clap::Args)]
pub struct FarmArgs {
    #[command(subcommand)]
    command: FarmCommand,
}

#[derive(Debug, Subcommand)]
enum FarmCommand {
    /// Write the pipeline as a job that farms take; renders nothing
    Export(ExportArgs),
}

/// Any task may be run again, run twice at once, or be killed: frames that are done are skipped, one that was begun
/// goes on where its checkpoint stands. A task that exits with 75 asks for another try.
#[derive(Debug, clap::Args)]
struct ExportArgs {
    /// The pipeline; every machine must see it, and what it names, under the same paths
    pipeline: PathBuf,

    #[command(flatten)]
    formats: Formats,

    /// Frames a task, which loads the scene once [default: five minutes' worth, 2 to 10]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    chunk: Option<u32>,

    /// Seconds that a frame takes [default: what the report in the output folder says]
    #[arg(long, value_name = "S")]
    seconds: Option<f64>,

    /// The program, by the name that the farm's machines know it by; repeat it for a command of several words
    #[arg(long, value_name = "WORD", default_value = "turntable", allow_hyphen_values = true)]
    program: Vec<String>,

    #[command(flatten)]
    choice: Choice,
}

/// At least one of them.
#[derive(Debug, clap::Args)]
#[group(required = true, multiple = true)]
#[command(next_help_heading = "As what")]
struct Formats {
    /// An Open Job Description bundle: AWS Deadline Cloud, or `openjd run` on this machine
    #[arg(long, value_name = "FOLDER")]
    openjd: Option<PathBuf>,

    /// A Slurm script that submits itself: `sh FILE`
    #[arg(long, value_name = "FILE")]
    slurm: Option<PathBuf>,

    /// One command a line: GNU parallel, HyperQueue, OpenCue, xargs
    #[arg(long, value_name = "FILE")]
    commands: Option<PathBuf>,
}

/// Runs `turntable farm`.
pub fn run(args: &FarmArgs) -> anyhow::Result<Outcome> {
    let FarmCommand::Export(args) = &args.command;
    let plan = Plan::new(&args.pipeline, args.choice.options())?;
    let job = job(&plan, args)?;
    // Nothing is written unless all of it can be said.
    let mut files = Vec::new();
    if let Some(folder) = &args.formats.openjd {
        let texts = farm_export::openjd(&job)?;
        files.extend(texts.into_iter().map(|(name, text)| (folder.join(name), text)));
    }
    if let Some(file) = &args.formats.slurm {
        files.push((file.clone(), farm_export::slurm(&job)?));
    }
    if let Some(file) = &args.formats.commands {
        files.push((file.clone(), farm_export::command_list(&job)?));
    }
    spare_inputs(&files, &job)?;
    if let Some(folder) = &args.formats.openjd {
        std::fs::create_dir_all(folder).with_context(|| format!("making {}", folder.display()))?;
    }
    for (path, text) in &files {
        whole_file::clear_stale(path);
        whole_file::write_whole(path, text.as_bytes())?;
    }
    tell(&job, args);
    Ok(Outcome::Good)
}

/// The plan as a job: what is asked for of it, done or not. A farm finds out itself what is done when it gets there.
fn job(plan: &Plan, args: &ExportArgs) -> anyhow::Result<FarmJob> {
    if !args.choice.steps.is_empty() {
        bail!("--steps: a job has all of them, each as a step of its own; leave it out");
    }
    let absolute = |path: &Path| {
        std::path::absolute(path).with_context(|| format!("finding where {} is", path.display()))
    };
    let seconds = args.seconds.or_else(|| seconds_a_frame(plan.output()));
    let only: Vec<String> =
        args.choice.only.iter().flat_map(|only| ["--only".to_owned(), only.clone()]).collect();
    let steps = |kind: &str| [vec!["--steps".to_owned(), kind.to_owned()], only.clone()].concat();
    let has = |kind: fn(&StepKind) -> bool| plan.steps().iter().any(|step| kind(&step.kind));
    let sheet = if has(|kind| *kind == StepKind::Sheet) { "ContactSheet" } else { "Outputs" };
    let after = |name: &str, when| AfterStep { name: name.to_owned(), words: steps("outputs"), when };
    let (variants, frames) = variants_and_frames(plan)?;
    let (input_folders, inputs) = inputs(plan, &args.pipeline)?.into_iter().partition(|path| path.is_dir());
    Ok(FarmJob {
        command: args.program.clone(),
        settings: settings(&args.choice),
        variants,
        inputs,
        input_folders,
        prepare: has(|kind| *kind == StepKind::Convert).then(|| steps("prepare")),
        render: vec!["--steps".to_owned(), "frames".to_owned()],
        done: Some([steps("frames"), vec!["--check".to_owned()]].concat()),
        after: vec![after(sheet, When::AllDone), after("Report", When::Ended)],
        chunk: args.chunk.unwrap_or_else(|| frames_a_task(seconds)),
        seconds_a_frame: seconds,
        ..FarmJob::new(plan.name(), absolute(&args.pipeline)?, absolute(plan.output())?, frames)
    })
}

/// What was laid over the pipeline, to be laid over it by every task.
fn settings(choice: &Choice) -> Vec<String> {
    let options = choice.options();
    let word = |flag: &'static str| move |value: &String| [flag.to_owned(), value.clone()];
    let settings = options.settings.iter().flat_map(word("--set"));
    settings.chain(options.variables.iter().flat_map(word("-D"))).collect()
}

/// The variants that are asked for, and the frames, which all of them must share.
fn variants_and_frames(plan: &Plan) -> anyhow::Result<(Vec<JobVariant>, Vec<u32>)> {
    let asked_frame = |step: &Step| match step.kind {
        StepKind::Frame { number, .. } if step.state != State::NotAsked => Some((step.variant?, number)),
        _ => None,
    };
    let asked: BTreeSet<(usize, u32)> = plan.steps().iter().filter_map(asked_frame).collect();
    let frames: BTreeSet<u32> = asked.iter().map(|(_, number)| *number).collect();
    let mut variants = Vec::new();
    for (index, variant) in plan.variants().iter().enumerate() {
        let count = asked.iter().filter(|(of, _)| *of == index).count();
        if count != 0 && count != frames.len() {
            bail!(
                "variant `{}` has {count} of the {} frames of all variants, and a job's tasks share one range of frames; \
                 export it alone (--only)",
                variant.id,
                frames.len()
            );
        }
        if count != 0 && !variant.axes.is_empty() {
            variants.push(JobVariant { id: variant.id.clone(), axes: variant.axes.clone() });
        }
    }
    Ok((variants, frames.into_iter().collect()))
}

/// What tasks read beside the pipeline itself.
fn inputs(plan: &Plan, pipeline: &Path) -> anyhow::Result<Vec<PathBuf>> {
    let pipeline = std::path::absolute(pipeline)?;
    let mut inputs = BTreeSet::new();
    for input in plan.inputs() {
        inputs.insert(std::path::absolute(input)?);
    }
    inputs.remove(&pipeline);
    Ok(inputs.into_iter().collect())
}

/// The median of the frames that were rendered before, as the report in `output` has them.
fn seconds_a_frame(output: &Path) -> Option<f64> {
    let text = std::fs::read_to_string(output.join("report.json")).ok()?;
    let report = error_report::Report::from_json(&text).ok()?;
    let points = report.series.iter().flat_map(|series| &series.points);
    let mut seconds: Vec<f64> = points.map(|point| point.seconds).filter(|&s| s > 0.0).collect();
    seconds.sort_by(f64::total_cmp);
    seconds.get(seconds.len() / 2).copied()
}

/// A job is never written over what it is made from.
fn spare_inputs(files: &[(PathBuf, String)], job: &FarmJob) -> anyhow::Result<()> {
    let inputs: BTreeSet<PathBuf> = [&job.pipeline]
        .into_iter()
        .chain(&job.inputs)
        .filter_map(|input| input.canonicalize().ok())
        .collect();
    for (file, _) in files {
        if file.canonicalize().is_ok_and(|file| inputs.contains(&file)) {
            bail!("{} would be written over, and the job reads it", file.display());
        }
    }
    Ok(())
}

fn tell(job: &FarmJob, args: &ExportArgs) {
    let variants = job.variants.len().max(1);
    let tasks = variants * job.frames.len().div_ceil(job.chunk.max(1) as usize);
    let of = if variants > 1 { format!(" of {variants} variants") } else { String::new() };
    let mut lines = vec![format!(
        "{}: {} frames{of} in {tasks} tasks of up to {} frames",
        job.name,
        job.frames.len(),
        job.chunk
    )];
    let Formats { openjd, slurm, commands } = &args.formats;
    lines.extend(openjd.as_ref().map(|folder| {
        format!("{}: its template.yaml says how to run it", farm_export::sh_quoted(&folder.to_string_lossy()))
    }));
    lines.extend(
        slurm
            .as_ref()
            .map(|file| format!("submit with: sh {}", farm_export::sh_quoted(&file.to_string_lossy()))),
    );
    lines.extend(commands.as_ref().map(|file| {
        format!("run with: parallel --jobs 1 < {}", farm_export::sh_quoted(&file.to_string_lossy()))
    }));
    for line in lines {
        // `eprintln!` would panic when nobody reads stderr any more.
        let _ = writeln!(std::io::stderr(), "{line}");
    }
}
