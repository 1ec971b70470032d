//! Runs scripted turntables from YAML pipelines.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use anyhow::Context;
use clap::Parser;
use command_line::{Bar, Outcome};
use turntable::{Event, FrameLine, FrameRange, Options, Plan, Remark, Reporter, Summary, TurntableError};

/// Make a turntable from a YAML pipeline: converted grooms, frames, contact sheet, error report.
///
/// Only what is missing or out of date is made. Interrupted runs go on where they stopped.
///
/// Exit codes: 0 done (with --check: up to date), 1 with --check: there is something to make,
/// 2 could not (bad pipeline or usage), 130 stopped by Ctrl-C.
#[derive(Parser)]
#[command(version)]
struct Args {
    /// The pipeline; paths in it are relative to the pipeline's folder.
    pipeline: PathBuf,

    /// Folder to write to [default: `output` of the pipeline, relative to the current folder].
    #[arg(long, short, value_name = "FOLDER")]
    out: Option<PathBuf>,

    /// Frames to look after, counted from 1: `1-5`, `1-10:2`, `1,3,7-9` [default: all].
    #[arg(long, value_name = "RANGE")]
    frames: Option<FrameRange>,

    /// Lay a setting over the pipeline's: `render.spp=4`. May be repeated.
    #[arg(long, value_name = "KEY=VALUE")]
    set: Vec<String>,

    /// Rendering threads; changes no pixel [default: one a core].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..))]
    threads: Option<u16>,

    /// Say what would be made, kept and left out, and why; make nothing.
    #[arg(long, visible_alias = "dry-run")]
    explain: bool,

    /// Check the pipeline and whether everything is up to date; make nothing.
    #[arg(long, conflicts_with = "explain")]
    check: bool,

    /// Write the result as JSON to standard output.
    #[arg(long)]
    json: bool,
}

fn main() -> ExitCode {
    command_line::run(|| run(&Args::parse()))
}

fn run(args: &Args) -> anyhow::Result<Outcome> {
    let options = Options {
        settings: args.set.clone(),
        output: args.out.clone(),
        frames: args.frames.clone(),
        threads: args.threads.map(usize::from),
        command: command_line::words(),
        ..Options::default()
    };
    let plan = Plan::new(&args.pipeline, options)?;
    if args.explain || args.check {
        return explain(&plan, args);
    }
    command_line::on_interrupt_ask();
    let terminal = Terminal { bar: command_line::progress_bar(1000, plan.name()) };
    let result = plan.run(&terminal);
    terminal.bar.finish();
    match result {
        Ok(summary) => {
            terminal.bar.say(&closing_words(&summary));
            if args.json {
                print_json(&summary)?;
            }
            Ok(Outcome::Good)
        }
        Err(TurntableError::Interrupted) => {
            terminal.bar.say("stopped; run the same command again to go on");
            Ok(Outcome::Interrupted)
        }
        Err(error) => Err(error.into()),
    }
}

/// Says what a run would do. With `--check` something left to make is a finding.
fn explain(plan: &Plan, args: &Args) -> anyhow::Result<Outcome> {
    let remarks = plan.explain();
    if args.json {
        print_json(&remarks)?;
    } else {
        let width = remarks.iter().map(|r| r.what.len()).max().unwrap_or_default();
        let mut stdout = std::io::stdout().lock();
        for Remark { what, action, why } in &remarks {
            writeln!(stdout, "{action:<9}  {what:<width$}  {why}")?;
        }
    }
    Ok(if args.check && !plan.is_up_to_date() { Outcome::Wanting } else { Outcome::Good })
}

fn print_json(value: &impl serde::Serialize) -> anyhow::Result<()> {
    let text = serde_json::to_string_pretty(value).context("writing JSON")?;
    Ok(writeln!(std::io::stdout().lock(), "{text}")?)
}

fn closing_words(summary: &Summary) -> String {
    let rendered: Vec<&FrameLine> = summary.frames.iter().filter(|f| f.rendered).collect();
    let folder = summary.output.display();
    if summary.made.is_empty() {
        return format!("{folder}: everything is up to date");
    }
    let worst = rendered.iter().filter_map(|f| f.relative_error).fold(0.0, f64::max);
    let errors =
        if worst > 0.0 { format!(", relative error at most {:.1} %", 100.0 * worst) } else { String::new() };
    let (made, kept, count) = (summary.made.len(), summary.up_to_date, rendered.len());
    format!(
        "{folder}: {made} files made ({count} frames rendered{errors}), {kept} up to date, {:.1} s",
        summary.seconds
    )
}

/// Words and a progress bar on stderr.
struct Terminal {
    bar: Bar,
}

impl Reporter for Terminal {
    fn event(&self, event: &Event) {
        match event {
            Event::Stage(words) => self.bar.set_label(words),
            Event::Warning(words) => self.bar.say(&format!("warning: {words}")),
            Event::FrameBegins { index, of, .. } => self.bar.set_label(&format!("frame {}/{of}", index + 1)),
            Event::FrameDone { number, seconds, relative_error, .. } => {
                let error = relative_error.map_or_else(
                    || "relative error unknown below 2 samples a pixel".to_owned(),
                    |error| format!("relative error {:.1} %", 100.0 * error),
                );
                self.bar.say(&format!("frame {number:04}: {error}, {seconds:.1} s"));
            }
            _ => {}
        }
    }

    fn advance(&self, share: f64) {
        self.bar.set((share * 1000.0) as u64);
    }

    fn cancelled(&self) -> bool {
        command_line::interrupted()
    }
}
