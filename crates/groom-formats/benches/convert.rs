//! Speed and peak memory of conversions on one core: 50,000 strands of 25 points with colours.
//!
//! `cargo bench -p groom-formats --bench convert`

#![allow(clippy::print_stdout)] // figures are what a bench is for

use std::fs::File;
use std::io;
use std::path::Path;
use std::time::Instant;

use glam::Vec3;
use groom::{Attribute, Domain, Groom, Values, names};
use groom_formats::{Format, ReadOptions, WriteOptions, read, read_from, write, write_to};

const STRANDS: usize = 50_000;
const POINTS: usize = 25;
const RUNS: usize = 5;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Set for a child that converts once and says its peak: `FORMAT`, or `none` for no conversion.
const PEAK_OF: &str = "GROOM_FORMATS_PEAK_OF";

fn main() -> Result<()> {
    if let Ok(format) = std::env::var(PEAK_OF) {
        return convert_once(&format);
    }
    let folder = tempfile::tempdir()?;
    let input = folder.path().join("in.hair");
    write(&groom()?, &input, &WriteOptions::default())?;
    let payload = input.metadata()?.len();
    println!("input: {STRANDS} strands of {POINTS} points, {:.1} MB of HAIR", payload as f64 / 1e6);
    reading("read hair", &input)?;
    for format in [Format::Text, Format::Usda, Format::Glb, Format::Hair] {
        writing(format, &input, payload)?;
    }
    let text = folder.path().join("in.txt");
    write(&read(&input, &ReadOptions::default())?.groom, &text, &WriteOptions::default())?;
    reading("read txt", &text)
}

/// Random-looking numbers with all their digits, as scanned hair has.
fn groom() -> Result<Groom> {
    let number = |i: usize| (i as u32).wrapping_mul(2_654_435_761) as f32 / 2.0_f32.powi(32);
    let points = STRANDS * POINTS;
    let positions = (0..points).map(|i| Vec3::new(number(i), number(i + 7), number(i + 13)) * 60.0 - 30.0);
    let offsets = (0..=STRANDS).map(|strand| (strand * POINTS) as u32).collect();
    let mut groom = Groom::new(offsets, positions.collect())?;
    let colors = (0..points).map(|i| Vec3::new(number(i + 3), number(i + 5), number(i + 11))).collect();
    groom.set_attribute(names::COLOR, Attribute { domain: Domain::Vertex, values: Values::Vec3(colors) })?;
    groom.set_attribute(names::RADIUS, Attribute::constant_float(0.05))?;
    groom.up_axis = groom::UpAxis::Z;
    Ok(groom)
}

fn reading(what: &str, path: &Path) -> Result<()> {
    let bytes = path.metadata()?.len();
    let seconds = best(|| {
        let options = ReadOptions { known_len: Some(bytes), ..ReadOptions::default() };
        let format = Format::from_path(path).unwrap_or(Format::Hair);
        std::hint::black_box(read_from(format, File::open(path)?, "input", &options)?);
        Ok(())
    })?;
    println!("{what}: {:.0} MB/s", bytes as f64 / 1e6 / seconds);
    Ok(())
}

fn writing(format: Format, input: &Path, payload: u64) -> Result<()> {
    let groom = read(input, &ReadOptions::default())?.groom;
    let mut out = Counting(0);
    let seconds = best(|| {
        out = Counting(0);
        write_to(format, &groom, &mut out, "output", &WriteOptions::default())?;
        Ok(())
    })?;
    drop(groom);
    let rate = out.0 as f64 / 1e6 / seconds;
    print!("write {format}: {rate:.0} MB/s, {:.1} MB in {seconds:.3} s", out.0 as f64 / 1e6);
    match (peak_of("none", input)?, peak_of(format.name(), input)?) {
        (Some(idle), Some(peak)) => {
            let over = peak.saturating_sub(idle) as f64 - payload as f64;
            println!("; hair -> {format} peaks at payload {:+.1} MB", over / 1e6);
        }
        _ => println!(),
    }
    Ok(())
}

/// Peak memory of a process that does nothing else, in bytes.
fn peak_of(format: &str, input: &Path) -> Result<Option<u64>> {
    let mut child = std::process::Command::new(std::env::current_exe()?);
    let run = child.env(PEAK_OF, format).env("GROOM_FORMATS_INPUT", input).output()?;
    Ok(String::from_utf8(run.stdout)?.trim().parse().ok())
}

fn convert_once(format: &str) -> Result<()> {
    if let Some(format) = Format::from_name(format) {
        let input = std::env::var_os("GROOM_FORMATS_INPUT").unwrap_or_default();
        let groom = read(Path::new(&input), &ReadOptions::default())?.groom;
        write_to(format, &groom, io::sink(), "output", &WriteOptions::default())?;
    }
    println!("{}", peak().map_or_else(String::new, |bytes| bytes.to_string()));
    Ok(())
}

/// The best of a few runs, in seconds.
fn best(mut run: impl FnMut() -> Result<()>) -> Result<f64> {
    let mut best = f64::INFINITY;
    for _ in 0..RUNS {
        let start = Instant::now();
        run()?;
        best = best.min(start.elapsed().as_secs_f64());
    }
    Ok(best)
}

struct Counting(u64);

impl io::Write for Counting {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 += std::hint::black_box(bytes).len() as u64;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Largest resident memory so far in bytes, where the system says it (Linux).
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? * 1024)
}
