//! Alembic written and read, on one core: 50,000 strands of 25 points with colours per vertex; ten frames.
//!
//! `cargo bench -p groom-formats --bench alembic`

#![allow(clippy::print_stdout)] // figures are what a bench is for

use std::fs::File;
use std::io::{self, Seek, SeekFrom, Write};
use std::path::Path;
use std::time::Instant;

use glam::Vec3;
use groom::{Attribute, Domain, Groom, Values, names};
use groom_formats::{
    Format, Frame, MotionOptions, ReadOptions, WriteOptions, read, read_from, write, write_animation,
    write_seekable,
};

const STRANDS: usize = 50_000;
const POINTS: usize = 25;
const FRAMES: usize = 10;
const RUNS: usize = 7;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Set for a child that does one thing and says its peak memory.
const PEAK_OF: &str = "GROOM_FORMATS_PEAK_OF";
const FOLDER: &str = "GROOM_FORMATS_FOLDER";

fn main() -> Result<()> {
    if let Ok(what) = std::env::var(PEAK_OF) {
        return once(&what);
    }
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("groom.abc");
    let groom = groom()?;
    let payload = groom.point_count() * size_of::<Vec3>() * 2 + groom.strand_count() * 4;
    println!("groom: {STRANDS} strands of {POINTS} points, {:.1} MB in memory", payload as f64 / 1e6);

    let options = WriteOptions::default();
    let mut sink = Sink::default();
    let seconds = times(|| {
        sink = Sink::default();
        write_seekable(Format::Alembic, &groom, &mut sink, "output", &options)?;
        Ok(())
    })?;
    say("write, to nowhere", sink.len, &seconds);
    let seconds = times(|| Ok(write(&groom, &path, &options).map(drop)?))?;
    let len = path.metadata()?.len();
    say("write, to a file", len, &seconds);
    let seconds = times(|| {
        let options = ReadOptions { known_len: Some(len), ..ReadOptions::default() };
        std::hint::black_box(read_from(Format::Alembic, File::open(&path)?, "input", &options)?);
        Ok(())
    })?;
    say("read", len, &seconds);

    let moving = folder.path().join("moving.abc");
    let seconds = times(|| animate(&groom, &moving))?;
    let len = moving.metadata()?.len();
    say(&format!("write {FRAMES} frames with velocities, to a file"), len, &seconds);

    drop(groom);
    for (what, base) in [("write", "groom"), ("animate", "groom"), ("read", "nothing")] {
        if let (Some(base), Some(peak)) = (peak_of(base, folder.path())?, peak_of(what, folder.path())?) {
            let over = peak.saturating_sub(base) as f64 / 1e6;
            println!(
                "{what} peaks {over:.1} MB over a process that holds {}",
                if what == "read" { "nothing" } else { "the groom" }
            );
        }
    }
    Ok(())
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

/// Ten frames, made as they are asked for.
fn animate(groom: &Groom, path: &Path) -> Result<()> {
    let mut frames = (0..FRAMES).map(|frame| {
        let positions = groom.positions().iter().map(|&p| p + Vec3::Z * frame as f32).collect();
        let velocities = Some(groom.positions().iter().map(|&p| p * (frame + 1) as f32).collect());
        Ok(Frame { time: frame as f64, positions, velocities, ..Frame::default() })
    });
    write_animation(groom, &mut frames, &MotionOptions::at_rate(24.0), path, &WriteOptions::default())?;
    Ok(())
}

/// One thing in a process of its own, and its peak memory.
fn once(what: &str) -> Result<()> {
    let folder = std::env::var_os(FOLDER).unwrap_or_default();
    let path = Path::new(&folder).join("groom.abc");
    if what == "read" {
        std::hint::black_box(read(&path, &ReadOptions::default())?);
    } else if what != "nothing" {
        let groom = groom()?;
        match what {
            "write" => drop(write(&groom, &path.with_extension("peak.abc"), &WriteOptions::default())?),
            "animate" => animate(&groom, &path.with_extension("peak.abc"))?,
            _ => {}
        }
    }
    println!("{}", peak().map_or_else(String::new, |bytes| bytes.to_string()));
    Ok(())
}

fn peak_of(what: &str, folder: &Path) -> Result<Option<u64>> {
    let mut child = std::process::Command::new(std::env::current_exe()?);
    let run = child.env(PEAK_OF, what).env(FOLDER, folder).output()?;
    Ok(String::from_utf8(run.stdout)?.trim().parse().ok())
}

/// Largest resident memory so far in bytes, where the system says it (Linux).
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<u64>().ok()? * 1024)
}

/// Seconds of every run, the best first.
fn times(mut run: impl FnMut() -> Result<()>) -> Result<Vec<f64>> {
    let mut seconds = Vec::new();
    for _ in 0..RUNS {
        let start = Instant::now();
        run()?;
        seconds.push(start.elapsed().as_secs_f64());
    }
    seconds.sort_by(f64::total_cmp);
    Ok(seconds)
}

fn say(what: &str, bytes: u64, seconds: &[f64]) {
    let (best, median) = (seconds[0], seconds[seconds.len() / 2]);
    let rate = |seconds: f64| bytes as f64 / 1e6 / seconds;
    println!(
        "{what}: {:.1} MB, best {:.0} MB/s ({best:.4} s), median {:.0} MB/s ({median:.4} s)",
        bytes as f64 / 1e6,
        rate(best),
        rate(median)
    );
}

/// Takes everything and keeps nothing but the length.
#[derive(Default)]
struct Sink {
    at: u64,
    len: u64,
}

impl Write for Sink {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.at += std::hint::black_box(bytes).len() as u64;
        self.len = self.len.max(self.at);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

impl Seek for Sink {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.at = match to {
            SeekFrom::Start(at) => at,
            SeekFrom::Current(by) => self.at.saturating_add_signed(by),
            SeekFrom::End(by) => self.len.saturating_add_signed(by),
        };
        Ok(self.at)
    }
}
