//! glTF: 50,000 strands of 25 points with colours as lines, surfaces and on a grid. Speed of one core, bytes,
//! distance error, and memory above the groom.
//!
//! `cargo bench -p groom-formats --bench gltf`

#![allow(clippy::print_stdout)] // figures are what a bench is for

use std::io;
use std::path::Path;
use std::time::Instant;

use glam::{Vec2, Vec3};
use groom::{Attribute, Domain, Groom, Values, names};
use groom_formats::{Format, Mesh, ReadOptions, Warning, WriteOptions, read, write, write_to};

const STRANDS: usize = 50_000;
const POINTS: usize = 25;
const RUNS: usize = 5;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

/// Set for a child that writes once and says how its memory grew: the name of a case.
const GROWTH_OF: &str = "GROOM_FORMATS_GROWTH_OF";

fn main() -> Result<()> {
    if let Ok(name) = std::env::var(GROWTH_OF) {
        return grow(&name);
    }
    println!("{STRANDS} strands of {POINTS} points; best of {RUNS} runs");
    println!("| what | MB | seconds | MB/s | error | memory above the groom, MB |");
    println!("|---|---|---|---|---|---|");
    let groom = groom()?;
    for (name, options) in cases() {
        writing(name, &groom, &options)?;
    }
    let folder = tempfile::tempdir()?;
    for (name, options) in cases().into_iter().filter(|(_, options)| options.mesh.is_none()) {
        reading(name, &groom, &options, &folder.path().join("hair.glb"))?;
    }
    Ok(())
}

fn cases() -> Vec<(&'static str, WriteOptions)> {
    let plain = WriteOptions::default;
    vec![
        ("lines", plain()),
        ("lines, every attribute", WriteOptions { all_attributes: true, ..plain() }),
        ("lines, 16 bits", WriteOptions { quantize: Some(16), ..plain() }),
        ("lines, 12 bits", WriteOptions { quantize: Some(12), ..plain() }),
        ("tubes, 4 sides", WriteOptions { mesh: Some(Mesh::Tubes { sides: 4 }), ..plain() }),
        ("ribbons", WriteOptions { mesh: Some(Mesh::Ribbons), ..plain() }),
        ("ribbons, 16 bits", WriteOptions { mesh: Some(Mesh::Ribbons), quantize: Some(16), ..plain() }),
    ]
}

/// Curved strands on a square of 20 cm, z up and in centimetres: everything is turned and scaled.
fn groom() -> Result<Groom> {
    let number = |i: usize| (i as u32).wrapping_mul(2_654_435_761) as f32 / 2.0_f32.powi(32);
    let point = |i: usize| {
        let (strand, t) = (i / POINTS, (i % POINTS) as f32 / (POINTS - 1) as f32);
        let turn = number(strand + 5) * 6.0 + t * 4.0;
        let root = Vec3::new(number(strand), number(strand + 7), 0.0) * 20.0;
        root + Vec3::new(turn.cos() * t, turn.sin() * t, t * (5.0 + number(strand + 3)))
    };
    let points = STRANDS * POINTS;
    let offsets = (0..=STRANDS).map(|strand| (strand * POINTS) as u32).collect();
    let mut groom = Groom::new(offsets, (0..points).map(point).collect())?;
    let colors = (0..points).map(|i| Vec3::new(number(i + 3), number(i + 5), number(i + 11))).collect();
    groom.set_attribute(names::COLOR, Attribute { domain: Domain::Vertex, values: Values::Vec3(colors) })?;
    let uvs = (0..STRANDS).map(|i| Vec2::new(number(i), number(i + 7))).collect();
    groom.set_attribute(names::ROOT_UV, Attribute { domain: Domain::Strand, values: Values::Vec2(uvs) })?;
    let ids = (0..STRANDS as i32).collect();
    groom.set_attribute(names::ID, Attribute { domain: Domain::Strand, values: Values::Int(ids) })?;
    groom.set_attribute(names::RADIUS, Attribute::constant_float(0.004))?;
    groom.up_axis = groom::UpAxis::Z;
    groom.meters_per_unit = 0.01;
    Ok(groom)
}

fn writing(name: &str, groom: &Groom, options: &WriteOptions) -> Result<()> {
    let (mut out, mut warnings) = (Counting(0), Vec::new());
    let seconds = best(|| {
        out = Counting(0);
        warnings = write_to(Format::Glb, groom, &mut out, "output", options)?;
        Ok(())
    })?;
    let megabytes = out.0 as f64 / 1e6;
    let error = warnings.iter().find_map(|warning| match warning {
        Warning::PositionsRounded { error, .. } => Some(format!("{error:.1e} m")),
        _ => None,
    });
    let error = error.unwrap_or_else(|| "0".to_owned());
    let growth = std::process::Command::new(std::env::current_exe()?).env(GROWTH_OF, name).output()?;
    let growth = String::from_utf8(growth.stdout)?;
    let rate = megabytes / seconds;
    println!("| write {name} | {megabytes:.1} | {seconds:.3} | {rate:.0} | {error} | {} |", growth.trim());
    Ok(())
}

fn reading(name: &str, groom: &Groom, options: &WriteOptions, path: &Path) -> Result<()> {
    write(groom, path, options)?;
    let megabytes = path.metadata()?.len() as f64 / 1e6;
    let seconds = best(|| {
        std::hint::black_box(read(path, &ReadOptions::default())?);
        Ok(())
    })?;
    println!("| read {name} | {megabytes:.1} | {seconds:.3} | {:.0} | | |", megabytes / seconds);
    Ok(())
}

/// Writes once to nowhere and prints how much the largest resident memory grew, in MB.
fn grow(name: &str) -> Result<()> {
    let groom = groom()?;
    let Some((_, options)) = cases().into_iter().find(|(case, _)| *case == name) else { return Ok(()) };
    let before = peak();
    write_to(Format::Glb, &groom, Counting(0), "output", &options)?;
    if let (Some(before), Some(after)) = (before, peak()) {
        println!("{:.1}", (after - before) as f64 / 1e6);
    }
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
