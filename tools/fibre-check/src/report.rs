//! `fibre-check report`: every law, one page.

use std::path::{Path, PathBuf};

use command_line::{Outcome, progress_bar};
use fibre_material::Material;
use fibre_verification::{Check, Report, Settings};

use crate::material::MaterialArgs;
use crate::output;

/// Checks one material and writes a page of figures
///
/// White furnace, density, lobes, chi-square of samples, their weights, reciprocity, estimates of one light
/// in four ways. The checks are told on stderr; exit code 1 when one fails.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The page to write (.html), self-contained; `-` is stdout
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Also write all figures as JSON; `-` is stdout
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
    /// Directions drawn from each of six views
    #[arg(long, default_value_t = 1_000_000, value_parser = clap::value_parser!(u64).range(1000..=1_000_000_000))]
    pub samples: u64,
    /// Fewer views: a look in a second
    #[arg(long)]
    pub quick: bool,
    /// Seed of everything random
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
    #[command(flatten)]
    pub material: MaterialArgs,
}

pub fn run(args: &Args) -> anyhow::Result<Outcome> {
    for path in args.output.iter().chain(&args.json) {
        output::check(path)?;
    }
    if args.material.preset.as_deref() == Some("list") {
        let names: Vec<&str> = Material::preset_names().collect();
        output::write(Path::new("-"), &(names.join("\n") + "\n"))?;
        return Ok(Outcome::Good);
    }
    let subject = args.material.subject()?;
    let bar = progress_bar(1, "checking");
    let settings = Settings { samples: args.samples, seed: args.seed, quick: args.quick };
    let report = Report::new(&subject, &args.material.title(), settings, &|done, of| {
        bar.set_len(of);
        bar.set(done);
    });
    bar.finish();
    let mut report = report?;
    report.about.insert("command".to_owned(), command_line::words());
    for check in &report.checks {
        output::say(&line(check));
    }
    if let Some(path) = &args.output {
        output::write(path, &report.to_html())?;
    }
    if let Some(path) = &args.json {
        output::write(path, &report.to_json()?)?;
    }
    Ok(if report.passes() { Outcome::Good } else { Outcome::Wanting })
}

/// One check as a line for people.
pub fn line(check: &Check) -> String {
    let bound = match check.bound {
        Some(bound) if check.above => format!(", at least {bound:.2e}"),
        Some(bound) => format!(", at most {bound:.2e}"),
        None => String::new(),
    };
    let at = if check.at.is_empty() { String::new() } else { format!(" ({})", check.at) };
    let word = check.verdict.word();
    format!("{word:>8}  {}: {} {:.2e}{bound}{at}", check.name, check.measure, check.figure)
}
