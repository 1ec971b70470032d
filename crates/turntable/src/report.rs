//! The error report of a turntable.

use error_report::{Point, Report, Series};

use crate::FrameLine;
use crate::schema::Pipeline;

/// Seconds and estimated error of every frame.
pub(crate) fn of_frames(
    name: &str,
    pipeline: &Pipeline,
    threads: Option<u32>,
    lines: &[FrameLine],
) -> Report {
    let render = &pipeline.render;
    // The error of a mean of independent samples falls as one over the root of their number.
    let mut series = Series::cases(
        format!("{} frames", pipeline.turntable.frames),
        "relative error",
        "the picture at infinitely many samples, estimated from two halves of the samples",
        0.5,
    );
    for line in lines {
        let Some(error) = line.relative_error else { continue };
        let label = format!("frame {:04}", line.number);
        let point = Point::new(label, line.seconds, error).with_samples(f64::from(line.spp));
        series.points.push(point.with("azimuth", line.azimuth));
    }
    let mut report = Report::new(format!("Turntable {name}"))
        .with_about("program", concat!("groomkit turntable ", env!("CARGO_PKG_VERSION")))
        .with_about(
            "size",
            format!("{} x {} pixels, {} samples a pixel", render.width, render.height, render.spp),
        );
    let unknown = lines.iter().filter(|line| line.relative_error.is_none()).count();
    if unknown > 0 {
        let words = format!("{unknown} frames: below 2 samples a pixel nothing tells how exact they are");
        report = report.with_about("without a figure", words);
    }
    if let Some(threads) = threads.filter(|&t| t > 0) {
        report = report.with_about("threads", threads.to_string());
    }
    report.with_series(series)
}
