//! `fibre-check stability`: the table of extreme cases.

use std::path::PathBuf;

use anyhow::bail;
use command_line::{Outcome, progress_bar};
use fibre_verification::{Case, Effort, Stability, cases};

use crate::output;
use crate::report::line;

/// Measures the table of extreme cases: error, energy, chi-square, run time
///
/// Roughness 0.001 .. 1, offsets to 0.9999, inclinations to 89.99 degrees, index 1.0001 .. 3, absorption 0 .. 1e4,
/// tilts, lobe scales, wet, layered and elliptical fibres, the far field, medullae of every kind. Exit code 1 when
/// a case fails.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The table to write: .html, .json, or error against run time as .csv; may be repeated
    #[arg(short, long, value_name = "FILE")]
    pub output: Vec<PathBuf>,
    /// Print error against run time as JSON on stdout, in the format of this project's other tools
    #[arg(long)]
    pub json: bool,
    /// A twelfth of the cases with few samples, for every change
    #[arg(long)]
    pub quick: bool,
    /// Samples of each chi-square test [default: 1000000; 20000 with --quick]
    #[arg(long, value_parser = clap::value_parser!(u64).range(1000..=1_000_000_000))]
    pub samples: Option<u64>,
    /// Only cases whose family or name has this in it
    #[arg(long, value_name = "WORDS")]
    pub only: Option<String>,
    /// Seed of everything random
    #[arg(long, default_value_t = 1)]
    pub seed: u64,
}

/// Every how manyth case is taken for a quick run; has no divisor in common with the number of views.
const QUICK_STEP: usize = 11;

pub fn run(args: &Args) -> anyhow::Result<Outcome> {
    for path in &args.output {
        output::check(path)?;
        format(path)?;
    }
    let effort = if args.quick { Effort::QUICK } else { Effort::FULL };
    let effort = Effort { samples: args.samples.unwrap_or(effort.samples), seed: args.seed, ..effort };
    let wanted = |case: &Case| match &args.only {
        Some(words) => case.family.contains(words.as_str()) || case.name.contains(words.as_str()),
        None => true,
    };
    let step = if args.quick { QUICK_STEP } else { 1 };
    let cases: Vec<Case> = cases().into_iter().filter(wanted).step_by(step).collect();
    if cases.is_empty() {
        bail!("no case has `{}` in its name", args.only.as_deref().unwrap_or_default());
    }
    let bar = progress_bar(cases.len() as u64, "measuring");
    let table = Stability::new(&cases, effort, &|| bar.inc(1));
    bar.finish();
    let mut table = table?;
    table.about.insert("command".to_owned(), command_line::words());
    for check in &table.checks {
        output::say(&line(check));
    }
    for row in table.rows.iter().filter(|row| !row.faults.is_empty()) {
        let faults = row.faults.join(", ");
        output::say(&format!("    FAIL  {} {}, {}: {faults}", row.family, row.name, row.view));
    }
    for path in &args.output {
        let text = match format(path)? {
            "html" => table.to_html(),
            "json" => table.to_json()?,
            _ => table.to_error_report().to_csv()?,
        };
        output::write(path, &text)?;
    }
    if args.json {
        output::write("-".as_ref(), &table.to_error_report().to_json()?)?;
    }
    Ok(if table.passes() { Outcome::Good } else { Outcome::Wanting })
}

/// The format a name asks for.
fn format(path: &std::path::Path) -> anyhow::Result<&'static str> {
    let extension = path.extension().and_then(|extension| extension.to_str()).unwrap_or_default();
    let formats = ["html", "json", "csv"];
    match formats.into_iter().find(|known| extension.eq_ignore_ascii_case(known)) {
        Some(known) => Ok(known),
        None => bail!("{}: expected a name that ends in .html, .json or .csv", path.display()),
    }
}
