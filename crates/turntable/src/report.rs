//! The error report of a turntable.

use error_report::{Point, Report, Series};

use crate::{FrameLine, Variant};

/// Seconds and estimated error of every frame, a series for each variant.
pub(crate) fn of_frames(name: &str, variants: &[Variant], lines: &[FrameLine]) -> Report {
    let mut report = Report::new(format!("Turntable {name}"))
        .with_about("program", concat!("groomkit turntable ", env!("CARGO_PKG_VERSION")));
    let sizes = once(variants.iter().map(|v| {
        let render = &v.pipeline.render;
        format!("{} x {} pixels, {} samples a pixel", render.width, render.height, render.spp)
    }));
    report = report.with_about("size", sizes);
    let unknown = lines.iter().filter(|line| line.relative_error.is_none()).count();
    if unknown > 0 {
        let words = format!("{unknown} frames: below 2 samples a pixel nothing tells how exact they are");
        report = report.with_about("without a figure", words);
    }
    let count = variants.iter().map(|v| v.pipeline.turntable.frames as usize).fold(0, usize::saturating_add);
    if lines.len() < count {
        report = report.with_about("frames", format!("{} of {count} are there", lines.len()));
    }
    let threads = once(lines.iter().filter(|line| line.threads > 0).map(|line| line.threads.to_string()));
    if !threads.is_empty() {
        report = report.with_about("threads", threads);
    }
    let mut rest = lines;
    for variant in variants {
        // Lines stand in the order of variants.
        let (own, others) = rest.split_at(rest.iter().take_while(|line| line.variant == variant.id).count());
        rest = others;
        report = report.with_series(series(variant, own));
    }
    report
}

fn series(variant: &Variant, lines: &[FrameLine]) -> Series {
    let count = variant.pipeline.turntable.frames;
    let gap = if variant.id.is_empty() { "" } else { ": " };
    // The error of a mean of independent samples falls as one over the root of their number.
    let mut series = Series::cases(
        format!("{}{gap}{count} frames", variant.id),
        "relative error",
        "the picture at infinitely many samples, estimated from two halves of the samples",
        0.5,
    );
    for line in lines {
        let Some(error) = line.relative_error else { continue };
        let label =
            format!("{}{}frame {:04}", variant.id, if gap.is_empty() { "" } else { " " }, line.number);
        let point = Point::new(label, line.seconds, error).with_samples(f64::from(line.spp));
        series.points.push(point.with("azimuth", line.azimuth));
    }
    series
}

/// All that differ, in the order in which they come.
fn once(words: impl Iterator<Item = String>) -> String {
    let mut all: Vec<String> = Vec::new();
    for word in words {
        if !all.contains(&word) {
            all.push(word);
        }
    }
    all.join("; ")
}
