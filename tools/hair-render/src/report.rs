//! What is said of a picture: what it cost, how exact it is, what was left out.

use std::io::Write;
use std::path::Path;

use anyhow::Result;
use command_line::say;
use hair_render::{ColorMatch, Frame, FrameReport, LeftOut, Scene, TableUse};

use crate::args::Args;
use crate::scene::Moment;

/// Tells what the picture does without.
pub fn leave_out(left_out: &[LeftOut]) {
    for left in left_out {
        say(&format!("left out: {}: {}", left.what, left.why));
    }
}

/// Tells where the medulla tables came from, if that was asked for, and what was wrong with their cache.
pub fn tables(scene: &Scene, explain: bool) {
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
pub struct Extra {
    pub color_match: Option<ColorMatch>,
    pub tables: Vec<TableUse>,
    pub moment: Option<Moment>,
    pub blur: Option<Blurred>,
    pub skipped: bool,
}

/// What the motion of a scene costs.
#[derive(serde::Serialize)]
pub struct Blurred {
    /// Bytes of geometry and tree.
    scene_bytes: usize,
    /// Seconds the tree took to build.
    build_seconds: f64,
}

impl Blurred {
    pub fn of(scene: &Scene) -> Self {
        let statistics = scene.tracing_statistics();
        Blurred { scene_bytes: statistics.bytes, build_seconds: statistics.build_seconds }
    }
}

/// Tells what the picture cost and how exact it is, on stderr and, where JSON is wanted, on stdout.
pub fn report(args: &Args, frame: &Frame, extra: Extra, output: &Path) -> Result<()> {
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
