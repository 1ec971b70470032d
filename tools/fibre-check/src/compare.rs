//! `fibre-check compare`: our answers beside another renderer's, each difference explained.

use std::path::PathBuf;

use anyhow::Context;
use clap::ValueEnum;
use command_line::Outcome;
use fibre_verification::{Comparison, Difference, Tilt, compare_with_mitsuba, rows};

use crate::{eval, output};

/// Compares with the answers of another renderer, set by set
///
/// The table has the columns of `eval`, a column `set`, and the answers f_r, f_g, f_b, pdf (the renderer's) and
/// exact_r, exact_g, exact_b (an exact evaluation of the same formulas). What the renderer is known to do
/// otherwise is done the same way, one thing after the other, and what is left of the difference is told after
/// each. Exit code 1 when anything is left that rounding does not explain.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// The table (.csv); `-` is stdin
    #[arg(long, value_name = "FILE")]
    pub csv: PathBuf,
    /// Whose answers they are
    #[arg(long, value_enum)]
    pub against: Renderer,
    /// Where the comparison goes [default: stdout]
    #[arg(short, long, value_name = "FILE", default_value = "-", hide_default_value = true)]
    pub output: PathBuf,
    /// As JSON, and not as a table of words
    #[arg(long)]
    pub json: bool,
}

/// A renderer whose slips are known.
#[derive(Debug, Clone, Copy, ValueEnum)]
pub enum Renderer {
    /// Mitsuba 3's `hair`
    Mitsuba,
}

pub fn run(args: &Args) -> anyhow::Result<Outcome> {
    output::check(&args.output)?;
    let Renderer::Mitsuba = args.against;
    let named = || args.csv.display().to_string();
    let (_, rows) = rows(eval::open(&args.csv)?, Tilt::ToTip).with_context(named)?;
    let sets = compare_with_mitsuba(&rows).with_context(named)?;
    let text = if args.json { fibre_verification::comparison_json(&sets)? } else { table(&sets) };
    output::write(&args.output, &text)?;
    Ok(if sets.iter().all(Comparison::passes) { Outcome::Good } else { Outcome::Wanting })
}

/// Largest and mean relative difference, as words.
fn table(sets: &[Comparison]) -> String {
    let mut text = String::from("Relative differences: largest (mean)\n");
    for set in sets {
        let verdict = if set.passes() { "explained" } else { "NOT EXPLAINED" };
        text += &format!("\n{} ({} rows): {verdict}\n", set.set, set.rows);
        row(&mut text, "double precision against exact", &set.exact_double);
        row(&mut text, "single precision against exact", &set.exact_single);
        text += "  values against Mitsuba's, with its slips made\n";
        for step in &set.values {
            row(&mut text, &format!("  {}", step.what), &step.left);
        }
        text += "  density against Mitsuba's\n";
        for step in &set.densities {
            row(&mut text, &format!("  {}", step.what), &step.left);
        }
        row(&mut text, "for scale: the sign of the tilt not turned", &set.tilt_unturned);
    }
    text
}

fn row(text: &mut String, what: &str, found: &Difference) {
    *text += &format!("  {what:<50} {:.1e} ({:.1e})\n", found.worst, found.mean);
}
