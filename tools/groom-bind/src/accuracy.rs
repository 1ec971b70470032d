//! `--accuracy`: error against time of what can be had more or less exactly.

use std::path::Path;

use anyhow::{Result, bail};
use error_report::{Point, Report, ReportError, Series};
use groom::Groom;
use groom_binding::{AccuracyRow, Binding, blending_accuracy, velocity_accuracy};
use moving_mesh::Pose;

use crate::args::is_stream;
use crate::character::Character;

/// Frames from pose to pose of which velocities are taken.
const STEPS: [f64; 6] = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125];

/// Places of the mesh that blending goes through, and how many the reference has.
const ANCHORS: [usize; 7] = [8, 16, 32, 64, 96, 192, 384];
const REFERENCE: usize = 768;

/// Poses that blending is measured at.
const POSES: usize = 5;

/// Measures velocities and blending on this groom and mesh, and writes the report.
pub(crate) fn store(path: &Path, groom: &Groom, binding: &Binding, character: &Character) -> Result<()> {
    let Character { mesh, timeline, name } = character;
    let frames: Vec<f64> = timeline.frames().collect();
    let Some(&middle) = frames.get(frames.len() / 2) else { bail!("no frame was asked for") };
    let surface = character.surface();
    let steps = STEPS.map(|step| timeline.seconds(step));
    let pose = |time: f64| -> Result<Pose> { Ok(mesh.pose(time)?) };
    let range = mesh.time_range();
    let velocities =
        velocity_accuracy(groom, binding, surface, timeline.seconds(middle), range, &steps, pose)?;
    let every = frames.len().div_ceil(POSES).max(1);
    let poses = frames.iter().step_by(every).map(|&frame| pose(timeline.seconds(frame)));
    let poses = poses.collect::<Result<Vec<Pose>>>()?;
    let blending = blending_accuracy(groom, binding, surface, &poses, &ANCHORS, REFERENCE)?;

    let mut report = Report::new("Carrying strands")
        .with_about("mesh", name)
        .with_about("strands", groom.strand_count().to_string())
        .with_about("points", groom.point_count().to_string())
        .with_about("command", command_line::words());
    let reference = format!("steps of {} frames, frame {middle}", STEPS[STEPS.len() - 1] / 100.0);
    let label = |row: &AccuracyRow| format!("{} frames", row.value * timeline.rate);
    let all = Series::cases("velocities", "part of the greatest speed, RMS", reference, 1.0);
    report = report.with_series(filled(all, &velocities, label));
    let reference = format!("{REFERENCE} anchors, {} poses", poses.len());
    let label = |row: &AccuracyRow| format!("{} anchors", row.value);
    let all = Series::convergence("blending", "sizes of the mesh, RMS", reference, 1.0);
    report = report.with_series(filled(all, &blending, label));
    write(path, &report)
}

fn filled(mut series: Series, rows: &[AccuracyRow], label: impl Fn(&AccuracyRow) -> String) -> Series {
    let point = |row: &AccuracyRow| Point::new(label(row), row.seconds, row.error).with("worst", row.worst);
    series.points.extend(rows.iter().map(point));
    series
}

/// Refuses a file whose ending says nothing, before anything is done.
pub(crate) fn refuse_unknown(path: &Path) -> Result<()> {
    if is_stream(path) || kind(path).is_some() {
        return Ok(());
    }
    bail!("--accuracy {}: expected a name that ends in .json, .csv or .html, or `-`", path.display());
}

/// A way of writing a report.
type Writer = fn(&Report) -> Result<String, ReportError>;

fn kind(path: &Path) -> Option<Writer> {
    match path.extension()?.to_str()?.to_ascii_lowercase().as_str() {
        "json" => Some(Report::to_json),
        "csv" => Some(Report::to_csv),
        "html" => Some(Report::to_html),
        _ => None,
    }
}

fn write(path: &Path, report: &Report) -> Result<()> {
    let text = kind(path).unwrap_or(Report::to_json)(report)?;
    if is_stream(path) {
        use std::io::Write;
        return Ok(writeln!(std::io::stdout().lock(), "{}", text.trim_end())?);
    }
    Ok(whole_file::write_whole(path, text.as_bytes())?)
}
