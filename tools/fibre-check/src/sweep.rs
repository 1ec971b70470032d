//! `fibre-check sweep`: rows of pictures in which one parameter changes.

use std::io::Write;
use std::path::PathBuf;

use anyhow::{Context, Result, bail};
use command_line::Outcome;
use hair_render::RenderError;
use look_sweep::{Row, RowReport, SweepError, SweepOptions, SweptRow, page};

use crate::sweep_stage::{GroomArgs, OnBar};

/// Renders the figure rows of the thesis on a groom: one contact sheet a row, a page that shows them with
/// their captions, and what each picture cost.
///
/// Writes NAME.png for each row, sweeps.html and sweeps.json. Nothing is written before all is rendered.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The folder to write to; made if it is not there
    #[arg(short, long, value_name = "DIR")]
    pub output: PathBuf,
    /// Only this row, by name; may be repeated [default: all of them]
    #[arg(long, value_name = "NAME")]
    pub only: Vec<String>,
    /// Pixels along the edges of each picture
    #[arg(long, default_value_t = SweepOptions::default().size)]
    pub size: u32,
    /// Samples a pixel
    #[arg(long, default_value_t = SweepOptions::default().spp)]
    pub spp: u32,
    /// Seed of everything random
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// Threads (the pictures do not depend on it) [default: one a core]
    #[arg(long)]
    pub threads: Option<usize>,
    /// Print sweeps.json on stdout too
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub groom: GroomArgs,
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<Outcome> {
    let rows = Row::named(&args.only)?;
    if let Some(file) = args.output.ancestors().find(|path| path.is_file()) {
        bail!("{} is a file, expected a folder", file.display());
    }
    let options = SweepOptions { size: args.size, spp: args.spp, seed: args.seed, threads: args.threads };
    let mut stage = args.groom.stage()?;
    command_line::on_interrupt_ask();
    let bar = OnBar::new("sweeping", rows.iter().map(|row| row.cells.len() as u64).sum());
    let mut swept = Vec::with_capacity(rows.len());
    for row in &rows {
        bar.label(row.name);
        match look_sweep::sweep(&mut stage, row, &options, &bar) {
            Err(SweepError::Render(RenderError::Cancelled)) => return Ok(Outcome::Interrupted),
            done => swept.push(done?),
        }
    }
    bar.finish();
    write(args, &swept)
}

fn write(args: &Args, swept: &[SweptRow]) -> Result<Outcome> {
    let folder = &args.output;
    std::fs::create_dir_all(folder).with_context(|| folder.display().to_string())?;
    for row in swept {
        row.sheet.write_png(&folder.join(format!("{}.png", row.report.name)))?;
    }
    let reports: Vec<RowReport> = swept.iter().map(|row| row.report.clone()).collect();
    let subject = format!("{}; {} samples a pixel.", args.groom.title(), args.spp);
    let write = |name: &str, text: &str| {
        let path = folder.join(name);
        whole_file::write_whole(&path, text.as_bytes()).with_context(|| path.display().to_string())
    };
    write("sweeps.html", &page(&subject, &reports))?;
    let mut json = serde_json::to_string_pretty(&reports)?;
    json.push('\n');
    write("sweeps.json", &json)?;
    if args.json {
        std::io::stdout().lock().write_all(json.as_bytes())?;
    }
    let pictures: usize = reports.iter().map(|row| row.cells.len()).sum();
    let seconds: f64 = reports.iter().flat_map(|row| &row.cells).map(|cell| cell.seconds).sum();
    // `eprintln!` would panic when nobody reads stderr any more.
    let place = folder.join("sweeps.html");
    let _ = writeln!(
        std::io::stderr(),
        "{}: {} rows, {pictures} pictures, {seconds:.1} s",
        place.display(),
        reports.len()
    );
    Ok(Outcome::Good)
}
