//! Words on stderr, data on stdout.

use std::io::{self, Write};

use anyhow::{Context, Result};
use groom::Groom;
use groom_binding::BindReport;
use serde_json::{Value, json};

use crate::args::Args;
use crate::character::Character;
use crate::events::{FrameEvents, total};
use crate::report::summary;
use crate::target::Target;

/// What there is to say about a run.
pub(crate) struct Done {
    about: Value,
    name: String,
    output: Option<String>,
    target: Option<Target>,
    warnings: Vec<String>,
    repairs: Vec<String>,
    /// Names of the groups that strands were put into.
    pub(crate) groups: Option<Vec<String>>,
    /// How far skinned strands are from where they would be carried, at most.
    pub(crate) skinned_error: Option<f64>,
    line: String,
    frame_count: usize,
}

impl Done {
    pub(crate) fn new(args: &Args, character: &Character, target: Option<&Target>) -> Done {
        let Character { name, mesh, timeline } = character;
        let output = target.map(Target::display);
        let about = json!({
            "groom": args.groom(),
            "mesh": name,
            "output": output,
            "format": target.map(|target| target.format().name()),
            "vertices": mesh.vertex_count(),
            "triangles": mesh.triangles().len(),
            "first_frame": timeline.range.first,
            "last_frame": timeline.range.last,
            "frame_step": timeline.range.step,
            "frames": timeline.frames().len(),
            "frame_rate": timeline.rate,
        });
        Done {
            about,
            name: args.groom().display().to_string(),
            output,
            target: target.cloned(),
            warnings: Vec::new(),
            repairs: Vec::new(),
            groups: None,
            skinned_error: None,
            line: String::new(),
            frame_count: timeline.frames().len(),
        }
    }

    /// Says at once what was odd, unless it all comes as JSON in the end.
    pub(crate) fn tell(&mut self, repairs: &[String], warnings: Vec<String>, is_json: bool) -> Result<()> {
        if !is_json {
            say_all("repaired", repairs)?;
            say_all("warning", &warnings)?;
        }
        self.repairs.extend_from_slice(repairs);
        self.warnings.extend(warnings);
        Ok(())
    }

    pub(crate) fn finish(
        &mut self,
        groom: &Groom,
        report: &BindReport,
        frames: &[FrameEvents],
        seconds: f64,
    ) {
        let total = total(frames);
        let numbers = frames.iter().map(|frame| frame.frame);
        let files = self.target.as_ref().map(|target| target.files(numbers));
        let bytes: u64 =
            files.into_iter().flatten().filter_map(|file| Some(file.metadata().ok()?.len())).sum();
        let more = json!({
            "strands": groom.strand_count(),
            "points": groom.point_count(),
            "mesh_size": report.mesh_size,
            "distance": summary(report),
            "beyond": report.beyond.len(),
            "pushed": total.pushed,
            "inside": total.inside,
            "teleported": total.teleported,
            "held": total.held,
            "root_error": total.root_error,
            "groups": self.groups,
            "skinned_error": self.skinned_error,
            "output_bytes": bytes,
            "seconds": seconds,
            "warnings": self.warnings,
            "repairs": self.repairs,
        });
        if let (Value::Object(about), Value::Object(more)) = (&mut self.about, more) {
            about.extend(more);
        }
        let median = report.distance_at(0.5).unwrap_or(0.0);
        let most = report.distance_at(1.0).unwrap_or(0.0);
        let mut line = format!(
            "{}{}: {} strands, {} points, roots {median:.4} (median) to {most:.4} off the mesh",
            self.name,
            self.output.as_ref().map(|output| format!(" -> {output}")).unwrap_or_default(),
            groom.strand_count(),
            groom.point_count(),
        );
        for (count, what) in [
            (total.pushed, "points pushed out"),
            (total.inside, "points still inside at worst"),
            (total.teleported, "strands jumped"),
            (total.held, "strands at worst on triangles that collapse or turn over, and kept their turn"),
        ] {
            if count > 0 {
                line += &format!(", {count} {what}");
            }
        }
        if let Some(error) = self.skinned_error {
            line += &format!(", skinned within {error:.4} of where they would be carried");
        }
        if self.output.is_some() {
            line += &format!(", {} frames, {:.1} MB", self.frame_count, bytes as f64 / 1e6);
        }
        self.line = format!("{line} in {seconds:.2} s");
    }

    /// Says what was done: a line on stderr, or JSON on stdout.
    pub(crate) fn print(&self, is_json: bool) -> Result<()> {
        if is_json {
            let text = serde_json::to_string_pretty(&self.about)?;
            return writeln!(io::stdout().lock(), "{text}").context("standard output");
        }
        Ok(writeln!(io::stderr().lock(), "{}", self.line)?)
    }
}

/// Says on stderr what was odd, lost or mended.
fn say_all(kind: &str, lines: &[String]) -> Result<()> {
    let mut stderr = io::stderr().lock();
    for line in lines {
        writeln!(stderr, "{kind}: {line}")?;
    }
    Ok(())
}
