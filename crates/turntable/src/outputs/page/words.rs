//! What the page says beside its pictures.

use error_report::Report;
use hair_render::FrameHeader;

use crate::expand::Variant;
use crate::left_out::left_out;
use crate::outputs::facts;
use crate::{FrameLine, report};

/// Error against seconds of all frames, as in the error report.
pub(super) fn report(name: &str, variants: &[Variant], lines: &[FrameLine]) -> Report {
    let mut report = report::of_frames(name, variants, lines);
    // Below 2 samples a pixel nothing tells how exact a frame is.
    report.series.retain(|series| !series.points.is_empty());
    report
}

/// What a frame's header says under its picture.
pub(super) fn facts(header: &FrameHeader) -> Vec<(String, String)> {
    let error = header.relative_error.map(|error| ("relative error".to_owned(), facts::percent(error)));
    let more =
        [("seconds", facts::seconds(header.seconds)), ("samples a pixel", format!("{} spp", header.spp))];
    error.into_iter().chain(more.map(|(name, value)| (name.to_owned(), value))).collect()
}

/// Where the page comes from.
pub(super) fn about(command: &str, lines: &[FrameLine]) -> Vec<(String, String)> {
    let version = concat!("groomkit turntable ", env!("CARGO_PKG_VERSION"));
    let mut about = vec![("program", version.to_owned())];
    if let Some(first) = lines.first() {
        about.extend([("command", command.to_owned()), ("threads", first.threads.to_string())]);
    }
    let seconds: f64 = lines.iter().map(|line| line.seconds).sum();
    about.push(("rendering", format!("{} in all", facts::seconds(seconds))));
    about.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}

/// What no variant has, and why; and that passes are kept of one frame in `every` alone, where they would take more than
/// `most` bytes.
pub(super) fn what_is_left_out(variants: &[Variant], every: usize, most: u64) -> Vec<(String, String)> {
    let all = left_out(variants.iter().map(|variant| &variant.pipeline));
    let mut left_out: Vec<(String, String)> =
        all.map(|(what, why)| (what.to_owned(), why.to_owned())).collect();
    if every > 1 {
        let why = format!("those of all frames would take more than {} MB", most / 1_000_000);
        left_out.push((format!("passes of all but one frame in {every}"), why));
    }
    left_out
}
