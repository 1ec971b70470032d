//! USD written by us and by usd-core's own writer, in CPU seconds of one run: 50,000 strands of 25 points with
//! velocities, widths, colours and root UVs, still and over ten frames.
//!
//! `cargo bench -p groom-formats --bench usd`; usd-core is looked for in `target/venv` (`cargo xtask setup`).

#![allow(clippy::print_stdout)] // figures are what a bench is for

use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;

use glam::{Vec2, Vec3};
use groom::{Attribute, Domain, Groom, Values, names};
use groom_formats::{Frame, MotionOptions, WriteOptions, write, write_animation};

const STRANDS: usize = 50_000;
const POINTS: usize = 25;
const FRAMES: usize = 10;
const RUNS: usize = 5;
const RATE: f64 = 24.0;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Set for a child that writes the still once and says its peak: an ending, or `none` for no file.
const PEAK_OF: &str = "GROOM_FORMATS_PEAK_OF";

fn main() -> Result<()> {
    let folder = tempfile::tempdir()?;
    if let Ok(ending) = std::env::var(PEAK_OF) {
        return peak_of(&ending, folder.path());
    }
    let groom = groom()?;
    let mib = |bytes: usize| bytes as f64 / 1e6;
    println!("{STRANDS} strands of {POINTS} points; points alone are {:.1} MB", mib(12 * STRANDS * POINTS));
    let ours = measured(&groom, folder.path())?;
    for (what, Figures { seconds, wall, bytes }) in &ours {
        let rate = *bytes as f64 / 1e6 / seconds;
        println!(
            "ours {what}: {seconds:.3} CPU s, {wall:.3} s, {:.1} MB, {rate:.0} MB a CPU s",
            *bytes as f64 / 1e6
        );
    }
    for ending in ["usdc", "usda"] {
        if let (Some(idle), Some(peak)) = (child_peak("none")?, child_peak(ending)?) {
            let over = peak.saturating_sub(idle) as f64 / 1e6;
            println!("ours, {ending}: peak memory {over:.1} MB over the groom's");
        }
    }
    against_usd_core(&groom, &ours, folder.path())
}

/// CPU and wall seconds, and the size of the file.
struct Figures {
    seconds: f64,
    wall: f64,
    bytes: u64,
}

fn measured(groom: &Groom, folder: &Path) -> Result<Vec<(&'static str, Figures)>> {
    let options = WriteOptions::default();
    let mut figures = Vec::new();
    for (what, name) in [("still usdc", "still.usdc"), ("still usda", "still.usda")] {
        let path = folder.join(name);
        figures.push((what, best(&path, || Ok(write(groom, &path, &options).map(drop)?))?));
    }
    let path = folder.join("moving.usdc");
    let moving = best(&path, || {
        let frame = |f| Frame {
            time: f as f64,
            positions: at(groom, f),
            velocities: Some(vec![Vec3::X * RATE as f32; groom.point_count()]),
            accelerations: None,
        };
        let mut frames = (0..FRAMES).map(|f| Ok(frame(f)));
        Ok(write_animation(groom, &mut frames, &MotionOptions::at_rate(RATE), &path, &options).map(drop)?)
    })?;
    figures.push(("ten frames usdc", moving));
    Ok(figures)
}

fn against_usd_core(groom: &Groom, ours: &[(&str, Figures)], folder: &Path) -> Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let python =
        root.join(if cfg!(windows) { "target/venv/Scripts/python.exe" } else { "target/venv/bin/python" });
    if !python.is_file() {
        println!("usd-core is not there: run `cargo xtask setup` to compare with it");
        return Ok(());
    }
    for (name, values) in raw(groom) {
        std::fs::write(folder.join(name), values)?;
    }
    let script: PathBuf = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/usd_core.py");
    let run =
        Command::new(python).arg(script).arg(folder).args([RUNS, FRAMES].map(|n| n.to_string())).output()?;
    print!("{}", String::from_utf8_lossy(&run.stderr));
    for line in String::from_utf8(run.stdout)?.lines() {
        let Some((what, figures)) = line.split_once(": ") else { continue };
        let mut numbers = figures.split(' ').map(str::parse::<f64>);
        let (Some(Ok(seconds)), Some(Ok(bytes))) = (numbers.next(), numbers.next()) else { continue };
        print!("usd-core {what}: {seconds:.3} CPU s, {:.1} MB", bytes / 1e6);
        match ours.iter().find(|(ours, _)| *ours == what) {
            Some((_, ours)) => println!("; ours takes {:.2} of its CPU seconds", ours.seconds / seconds),
            None => println!(),
        }
    }
    Ok(())
}

/// The groom's arrays as numpy reads them.
fn raw(groom: &Groom) -> [(&'static str, Vec<u8>); 4] {
    let bytes = |name| match groom.attribute(name).map(|attribute| &attribute.values) {
        Some(Values::Float(values)) => bytemuck::cast_slice(values).to_vec(),
        Some(Values::Vec2(values)) => bytemuck::cast_slice(values).to_vec(),
        Some(Values::Vec3(values)) => bytemuck::cast_slice(values).to_vec(),
        _ => Vec::new(),
    };
    [
        ("points.f32", bytemuck::cast_slice(groom.positions()).to_vec()),
        ("radii.f32", bytes(names::RADIUS)),
        ("colors.f32", bytes(names::COLOR)),
        ("uvs.f32", bytes(names::ROOT_UV)),
    ]
}

/// Random-looking positions with all their digits, thinning to the tip, a colour and a root UV a strand.
fn groom() -> Result<Groom> {
    let number = |i: usize| (i as u32).wrapping_mul(2_654_435_761) as f32 / 2.0_f32.powi(32);
    let points = STRANDS * POINTS;
    let triple = |i: usize| Vec3::new(number(i), number(i + 7), number(i + 13));
    let positions = (0..points).map(|i| triple(i) * 60.0 - 30.0);
    let offsets = (0..=STRANDS).map(|strand| (strand * POINTS) as u32).collect();
    let mut groom = Groom::new(offsets, positions.collect())?;
    let mut set = |name, domain, values| groom.set_attribute(name, Attribute { domain, values });
    let radii = (0..points).map(|i| 0.05 * (1.0 - (i % POINTS) as f32 / 30.0)).collect();
    set(names::RADIUS, Domain::Vertex, Values::Float(radii))?;
    set(names::COLOR, Domain::Strand, Values::Vec3((0..STRANDS).map(triple).collect()))?;
    let uvs = (0..STRANDS).map(|i| Vec2::new(number(i + 3), number(i + 5))).collect();
    set(names::ROOT_UV, Domain::Strand, Values::Vec2(uvs))?;
    set(names::VELOCITY, Domain::Vertex, Values::Vec3((0..points).map(|i| triple(i + 17)).collect()))?;
    Ok(groom)
}

fn at(groom: &Groom, frame: usize) -> Vec<Vec3> {
    groom.positions().iter().map(|&point| point + Vec3::X * frame as f32).collect()
}

/// The least of a few runs.
fn best(path: &Path, mut run: impl FnMut() -> Result<()>) -> Result<Figures> {
    let mut best = Figures { seconds: f64::INFINITY, wall: f64::INFINITY, bytes: 0 };
    for _ in 0..RUNS {
        let (cpu, wall) = (cpu_seconds(), Instant::now());
        run()?;
        best.wall = best.wall.min(wall.elapsed().as_secs_f64());
        let spent = cpu.zip(cpu_seconds()).map(|(before, after)| after - before);
        best.seconds = best.seconds.min(spent.unwrap_or(wall.elapsed().as_secs_f64()));
    }
    best.bytes = path.metadata()?.len();
    Ok(best)
}

/// CPU seconds of all threads, where the system says them (Linux); else the wall's are taken.
fn cpu_seconds() -> Option<f64> {
    let tasks = std::fs::read_dir("/proc/self/task").ok()?.flatten();
    let of = |task: std::fs::DirEntry| -> Option<f64> {
        let told = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        told.split(' ').next()?.parse::<f64>().ok()
    };
    Some(tasks.filter_map(of).sum::<f64>() / 1e9)
}

/// Peak memory of a process that does nothing else, in bytes.
fn child_peak(ending: &str) -> Result<Option<u64>> {
    let run = Command::new(std::env::current_exe()?).env(PEAK_OF, ending).output()?;
    Ok(String::from_utf8(run.stdout)?.trim().parse().ok())
}

fn peak_of(ending: &str, folder: &Path) -> Result<()> {
    let groom = groom()?;
    if ending != "none" {
        write(&groom, &folder.join("peak").with_extension(ending), &WriteOptions::default())?;
    }
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM:"));
    let kib: Option<u64> = line.and_then(|line| line.split_whitespace().nth(1)?.parse().ok());
    println!("{}", kib.map_or_else(String::new, |kib| (1024 * kib).to_string()));
    Ok(())
}
