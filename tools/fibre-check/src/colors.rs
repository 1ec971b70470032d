//! `fibre-check colors`: whether the colours that are picked arrive.

use std::fmt::Write as _;
use std::io::Write;

use anyhow::Result;
use command_line::Outcome;
use hair_render::{ColorMatching, Reach, RenderError, RenderSettings};
use look_sweep::{NamedMatch, SweepError};

use crate::sweep_stage::{GroomArgs, OnBar};

/// Tells, for colours of hair on one groom, what mean colour it has under even light: by Chiang's fit, and
/// with the absorption that was found by rendering it.
///
/// Prints a table on stdout. Exit code 1 where a channel could neither be reached nor shown to be out of reach.
#[derive(Debug, clap::Args)]
pub struct Args {
    /// How far off a channel may be, 0..1
    #[arg(long, default_value_t = ColorMatching::default().tolerance)]
    pub tolerance: f32,
    /// Pixels along the edges of the probe
    #[arg(long, default_value_t = ColorMatching::default().size)]
    pub size: u32,
    /// Samples a pixel of the probe
    #[arg(long, default_value_t = ColorMatching::default().spp)]
    pub spp: u32,
    /// Seed of everything random
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// Threads (the table does not depend on it, but for the seconds) [default: one a core]
    #[arg(long)]
    pub threads: Option<usize>,
    /// Print JSON instead of a table
    #[arg(long)]
    pub json: bool,
    #[command(flatten)]
    pub groom: GroomArgs,
}

/// Runs the subcommand.
pub fn run(args: &Args) -> Result<Outcome> {
    let mut stage = args.groom.stage()?;
    let settings = RenderSettings { seed: args.seed, threads: args.threads, ..RenderSettings::default() };
    let matching = ColorMatching {
        tolerance: args.tolerance,
        size: args.size,
        spp: args.spp,
        ..ColorMatching::default()
    };
    command_line::on_interrupt_ask();
    let bar = OnBar::new("matching colours", look_sweep::colors().len() as u64);
    let found = look_sweep::match_colors(&mut stage, &settings, &matching, &bar);
    bar.finish();
    let found = match found {
        Err(SweepError::Render(RenderError::Cancelled)) => return Ok(Outcome::Interrupted),
        found => found?,
    };
    let text = if args.json { serde_json::to_string_pretty(&found)? + "\n" } else { table(&found) };
    std::io::stdout().lock().write_all(text.as_bytes())?;
    let undecided = found.iter().any(|line| line.found.reach.contains(&Reach::NotYet));
    Ok(if undecided { Outcome::Wanting } else { Outcome::Good })
}

fn table(lines: &[NamedMatch]) -> String {
    let mut out = String::from(
        "colour          picked             fit gives          off     matched            off     absorption            probes  seconds\n",
    );
    for NamedMatch { name, found } in lines {
        // Writing to a string does not fail.
        let _ = writeln!(
            out,
            "{name:15} {} {} {:.4}  {} {:.4}  {:21} {:6} {:8.2}{}",
            triple(found.wanted),
            triple(found.fit_color),
            found.fit_error,
            triple(found.color),
            found.error,
            triple(found.absorption).trim_end(),
            found.probes,
            found.seconds,
            found.reach.iter().zip(["red", "green", "blue"]).filter_map(excuse).collect::<String>(),
        );
    }
    out
}

fn triple([r, g, b]: [f32; 3]) -> String {
    format!("{:18}", format!("{r:.3} {g:.3} {b:.3}"))
}

fn excuse((reach, channel): (&Reach, &str)) -> Option<String> {
    match reach {
        Reach::Reached => None,
        Reach::TooBright => Some(format!("; {channel}: brighter than hair that absorbs nothing")),
        Reach::TooDark => Some(format!("; {channel}: darker than what black fibres reflect")),
        Reach::NotYet => Some(format!("; {channel}: probes used up")),
    }
}
