//! `turntable check`: what is wrong with a pipeline, and what it comes to.

use std::io::{BufWriter, Write};
use std::path::PathBuf;

use command_line::Outcome;
use serde_json::{Value, json};
use turntable::{Checked, Fault, Plan, TurntableError, Variant, check_pipeline};

use crate::args::Choice;
use crate::{explain, json};

/// Checking a pipeline.
///
/// Exit codes: 0 good; 1 something is wrong with it; 2 it cannot be read.
#[derive(Debug, clap::Args)]
pub struct CheckArgs {
    /// The pipeline; paths in it are relative to its folder
    pipeline: PathBuf,

    #[command(flatten)]
    choice: Choice,

    /// Print what each variant comes to, with its defaults, as YAML that reads back to the same: a document each
    #[arg(long, conflicts_with = "explain")]
    resolved: bool,

    /// Say what a run would make, keep and leave out, and why
    #[arg(long)]
    explain: bool,

    /// Write the result as JSON to standard output
    #[arg(long)]
    json: bool,
}

/// Checks a pipeline; its faults are what was asked for, and no error.
pub fn run(args: &CheckArgs) -> anyhow::Result<Outcome> {
    let options = args.choice.options();
    let Checked { faults, variants } = check_pipeline(&args.pipeline, &options)?;
    if !faults.is_empty() || !args.explain {
        return tell(args, &faults, &variants);
    }
    match Plan::new(&args.pipeline, options) {
        Ok(plan) => {
            explain::print(&plan, args.json)?;
            Ok(Outcome::Good)
        }
        // What only shows when it is known what is there: an output that would be written over an input.
        Err(TurntableError::Pipeline(faults)) => tell(args, &faults, &[]),
        Err(error) => Err(error.into()),
    }
}

fn tell(args: &CheckArgs, faults: &[Fault], variants: &[Variant]) -> anyhow::Result<Outcome> {
    let outcome = if faults.is_empty() { Outcome::Good } else { Outcome::Wanting };
    if args.json {
        let variants: Vec<Value> = variants.iter().map(|variant| as_json(variant, args.resolved)).collect();
        let faults: Vec<Value> = faults.iter().map(fault_as_json).collect();
        json::print(&json!({ "good": faults.is_empty(), "faults": faults, "variants": variants }))?;
        return Ok(outcome);
    }
    let mut stdout = BufWriter::new(std::io::stdout().lock());
    for fault in faults {
        writeln!(stdout, "{fault}")?;
    }
    if args.resolved {
        for variant in variants {
            let remark = if variant.id.is_empty() { String::new() } else { format!(" # {}", variant.id) };
            let yaml = variant.to_yaml().map_err(anyhow::Error::msg)?;
            write!(stdout, "---{remark}\n{yaml}")?;
        }
    } else if faults.is_empty() {
        let frames: u64 = variants.iter().map(|variant| u64::from(variant.pipeline.turntable.frames)).sum();
        let of = if variants.len() == 1 { String::new() } else { format!("{} variants, ", variants.len()) };
        writeln!(stdout, "{}: good, {of}{frames} frames", args.pipeline.display())?;
    }
    stdout.flush()?;
    Ok(outcome)
}

fn fault_as_json(fault: &Fault) -> Value {
    let Fault { file, place, key, message } = fault;
    json!({
        "file": file.to_string_lossy(),
        "line": place.map(|place| place.0),
        "column": place.map(|place| place.1),
        "key": key,
        "message": message,
    })
}

fn as_json(variant: &Variant, resolved: bool) -> Value {
    let axes: Vec<Value> =
        variant.axes.iter().map(|(axis, name)| json!({ "axis": axis, "name": name })).collect();
    let frames = variant.pipeline.turntable.frames;
    let mut value = json!({ "id": variant.id, "axes": axes, "frames": frames });
    if resolved {
        value["pipeline"] = json!(variant.pipeline);
    }
    value
}
