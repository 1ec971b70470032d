//! Bytes and seconds of reduced exports against the error they make.

use std::fmt;
use std::io::{self, Write};
use std::path::Path;
use std::time::Instant;

use anyhow::{Context, Result};
use error_report::{Point, Report, Series};
use groom::{Distance, Groom};
use groom_formats::{Format, Output, WriteOptions, write_to};

use crate::args::Args;

/// Every export is made this often; the fastest counts.
const RUNS: usize = 3;

/// What leaves out or rounds: the last edits of all.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Reduction {
    tolerance: Option<f32>,
    bits: Option<u32>,
}

impl Reduction {
    /// What the command asks for.
    fn asked(args: &Args) -> Self {
        Reduction { tolerance: args.strands.tolerance, bits: args.strands.quantize }
    }

    /// The groom with fewer or rounder points.
    fn of(self, mut groom: Groom) -> Result<Groom> {
        if let Some(tolerance) = self.tolerance {
            groom = groom.simplify(tolerance).context("--tolerance")?;
        }
        if let Some(bits) = self.bits {
            groom.quantize(bits).context("--quantize")?;
        }
        Ok(groom)
    }
}

impl fmt::Display for Reduction {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.tolerance, self.bits) {
            (None, None) => write!(f, "none"),
            (Some(tolerance), None) => write!(f, "--tolerance {tolerance}"),
            (None, Some(bits)) => write!(f, "--quantize {bits}"),
            (Some(tolerance), Some(bits)) => write!(f, "--tolerance {tolerance} --quantize {bits}"),
        }
    }
}

/// Measures what the command asks for and what its sweeps ask for, all from `full`, the groom as it would be
/// written without reduction.
///
/// A sweep changes one of --quantize and --tolerance and leaves the other as the command has it. The error
/// is the largest distance between polylines, both ways ([`Distance::between`]), in the output's units; its
/// root mean square, bytes and points stand beside it. Seconds are those of reducing and writing to memory.
/// `.gltf` is measured as `.glb`, which has the same bytes in one file.
pub(crate) fn measure(full: &Groom, args: &Args, format: Format, options: &WriteOptions) -> Result<Report> {
    let format = if format == Format::Gltf { Format::Glb } else { format };
    let bench = Bench { full, format, options };
    let (asked, sweeps) = (Reduction::asked(args), &args.measuring);
    let mut report = Report::new(format!("{} as .{format}, reduced", args.input().display()))
        .with_about("strands", full.strand_count().to_string())
        .with_about("points", full.point_count().to_string())
        .with_about("seconds", format!("reducing and writing to memory, the best of {RUNS}"))
        .with_about("threads", std::thread::available_parallelism().map_or(1, usize::from).to_string());
    let mut add = |label: &str, reductions: Vec<Reduction>| -> Result<()> {
        let mut series = Series::cases(label, "largest distance", "the groom before reduction", 0.0);
        for reduction in reductions {
            series.points.push(bench.point(reduction)?);
        }
        report.series.push(series);
        Ok(())
    };
    add("not reduced", vec![Reduction::default()])?;
    if asked != Reduction::default() {
        add("as asked", vec![asked])?;
    }
    if !sweeps.sweep_quantize.is_empty() {
        let with = |&bits: &u32| Reduction { bits: Some(bits), ..asked };
        add("--quantize", sweeps.sweep_quantize.iter().map(with).collect())?;
    }
    if !sweeps.sweep_tolerance.is_empty() {
        let with = |&tolerance: &f32| Reduction { tolerance: Some(tolerance), ..asked };
        add("--tolerance", sweeps.sweep_tolerance.iter().map(with).collect())?;
    }
    Ok(report)
}

/// Writes the report in the format its ending names, whole or not at all.
pub(crate) fn store(report: &Report, path: &Path) -> Result<()> {
    let text = match path.extension().and_then(|ending| ending.to_str()) {
        Some("json") => report.to_json()?,
        Some("csv") => report.to_csv()?,
        _ => report.to_html()?,
    };
    let mut file = Output::create(path)?;
    file.write_all(text.as_bytes()).with_context(|| path.display().to_string())?;
    file.commit()?;
    Ok(())
}

struct Bench<'a> {
    full: &'a Groom,
    format: Format,
    options: &'a WriteOptions,
}

impl Bench<'_> {
    fn point(&self, reduction: Reduction) -> Result<Point> {
        let options = WriteOptions { quantize: reduction.bits, ..self.options.clone() };
        let mut seconds = f64::INFINITY;
        let mut counter = Counter(0);
        let mut reduced = None;
        for _ in 0..RUNS {
            counter = Counter(0);
            let full = self.full.clone();
            let start = Instant::now();
            let groom = reduction.of(full)?;
            write_to(self.format, &groom, &mut counter, "the measured export", &options)?;
            seconds = seconds.min(start.elapsed().as_secs_f64());
            reduced = Some(groom);
        }
        let reduced = reduced.as_ref().unwrap_or(self.full);
        let distance = Distance::between(self.full, reduced);
        Ok(Point::new(reduction.to_string(), seconds, distance.max())
            .with("bytes", counter.0 as f64)
            .with("points", reduced.point_count() as f64)
            .with("rms distance", distance.rms()))
    }
}

/// Counts bytes and forgets them.
struct Counter(u64);

impl Write for Counter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 += bytes.len() as u64;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
