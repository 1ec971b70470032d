//! Speed, use of cores and peak memory of conversions: 50,000 strands of 25 points with colours.
//!
//! `cargo bench -p groom-formats --bench convert` (`-- FILE.hair` for another input)
//!
//! Every figure comes from processes of their own, so that peaks are of one conversion; peers run between ours,
//! on the same machine at the same time.

#![allow(clippy::print_stdout)] // figures are what a bench is for

mod child;
mod naive;
mod usage;

use std::path::{Path, PathBuf};

use child::{Job, Measured};
use glam::Vec3;
use groom::{Attribute, Domain, Groom, Values, names};
use groom_formats::{Format, WriteOptions, write};

const STRANDS: usize = 50_000;
const POINTS: usize = 25;
const RUNS: usize = 5;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    if let Some(job) = Job::asked_of_this_process() {
        return job.run();
    }
    let folder = tempfile::tempdir()?;
    let given = std::env::args().skip(1).find(|argument| argument.ends_with(".hair")).map(PathBuf::from);
    let input = match given {
        Some(path) => path,
        None => {
            let path = folder.path().join("in.hair");
            write(&groom(STRANDS)?, &path, &WriteOptions::default())?;
            path
        }
    };
    println!("input: {:.1} MB of HAIR; {RUNS} runs, best and median", megabytes(&input));
    println!();
    println!("| pair | output MB | writing MB/s | median | CPU s | wall s | whole s | peak over input MB |");
    println!("|---|---|---|---|---|---|---|---|");
    for format in Format::ALL.into_iter().filter(|&format| format.can_write() && format != Format::Gltf) {
        row("hair", "whole", &input, folder.path(), format.name())?;
    }
    for format in ["hair", "txt", "data", "ply"] {
        row("hair", "streamed", &input, folder.path(), format)?;
    }
    row("hair", "naive", &input, folder.path(), "txt")?;
    row("hair", "savetxt", &input, folder.path(), "txt")?;
    reading(&input, folder.path())?;
    growth(folder.path())
}

/// One conversion as a line of the table.
fn row(from: &str, how: &str, input: &Path, folder: &Path, to: &str) -> Result<()> {
    let output = folder.join(format!("out-{how}.{to}"));
    let runs = measured(how, input, &output)?;
    let pair = format!("{from} -> {to}{}", if how == "whole" { String::new() } else { format!(", {how}") });
    let Some(runs) = runs else {
        println!("| {pair} | not to be had here | | | | | | |");
        return Ok(());
    };
    let size = megabytes(&output);
    let writing = sorted(&runs, |run| run.write_wall);
    let (best, median) = (size / writing[0], size / writing[writing.len() / 2]);
    let middle = |value: fn(&Measured) -> f64| {
        let all = sorted(&runs, value);
        all[all.len() / 2]
    };
    println!(
        "| {pair} | {size:.1} | {best:.0} | {median:.0} | {:.3} | {:.3} | {:.3} | {:+.1} |",
        middle(|run| run.write_cpu),
        middle(|run| run.write_wall),
        middle(|run| run.read_wall + run.write_wall),
        middle(|run| run.peak) / 1e6 - megabytes(input),
    );
    Ok(())
}

/// Rates of reading what was written.
fn reading(input: &Path, folder: &Path) -> Result<()> {
    println!();
    println!("| reading | MB | MB/s | median | CPU s | wall s | peak over file MB |");
    println!("|---|---|---|---|---|---|---|");
    for format in Format::ALL.into_iter().filter(|&format| format.can_read()) {
        let file = folder.join(format!("out-whole.{}", format.name()));
        let file = if format == Format::Hair { input } else { &file };
        line_of_reading(format.name(), "read", file)?;
    }
    line_of_reading("txt, naive", "naive read", &folder.join("out-whole.txt"))
}

fn line_of_reading(name: &str, how: &str, file: &Path) -> Result<()> {
    let runs = if file.exists() { measured(how, file, Path::new("nowhere"))? } else { None };
    let Some(runs) = runs else { return Ok(()) };
    let (size, walls) = (megabytes(file), sorted(&runs, |run| run.read_wall));
    let cpu = sorted(&runs, |run| run.read_cpu)[runs.len() / 2];
    let peak = sorted(&runs, |run| run.peak)[runs.len() / 2] / 1e6;
    let (best, median) = (walls[0], walls[walls.len() / 2]);
    println!(
        "| {name} | {size:.1} | {:.0} | {:.0} | {cpu:.3} | {median:.3} | {:+.1} |",
        size / best,
        size / median,
        peak - size
    );
    Ok(())
}

/// Peaks of streaming once and four times as many strands of 69 points: 3.44 million points, and four times that.
fn growth(folder: &Path) -> Result<()> {
    println!();
    println!("| streamed | strands | points | input MB | seconds | peak MB |");
    println!("|---|---|---|---|---|---|");
    for strands in [50_000, 200_000] {
        let input = folder.join("large.hair");
        let points = child::large(&input, strands)?;
        for to in ["hair", "txt", "data", "ply"] {
            let Some(run) = child::measure("streamed", &input, &folder.join("large-out").with_extension(to))?
            else {
                continue;
            };
            println!(
                "| hair -> {to} | {strands} | {points} | {:.0} | {:.2} | {:.1} |",
                megabytes(&input),
                run.write_wall,
                run.peak / 1e6
            );
        }
    }
    Ok(())
}

fn measured(how: &str, input: &Path, output: &Path) -> Result<Option<Vec<Measured>>> {
    (0..RUNS).map(|_| child::measure(how, input, output)).collect()
}

fn sorted(runs: &[Measured], value: impl Fn(&Measured) -> f64) -> Vec<f64> {
    let mut values: Vec<f64> = runs.iter().map(value).collect();
    values.sort_by(f64::total_cmp);
    values
}

fn megabytes(path: &Path) -> f64 {
    path.metadata().map_or(0.0, |metadata| metadata.len() as f64 / 1e6)
}

/// Random-looking numbers with all their digits, as scanned hair has.
fn groom(strands: usize) -> Result<Groom> {
    let number = |i: usize| (i as u32).wrapping_mul(2_654_435_761) as f32 / 2.0_f32.powi(32);
    let points = strands * POINTS;
    let positions = (0..points).map(|i| Vec3::new(number(i), number(i + 7), number(i + 13)) * 60.0 - 30.0);
    let offsets = (0..=strands).map(|strand| (strand * POINTS) as u32).collect();
    let mut groom = Groom::new(offsets, positions.collect())?;
    let colors = (0..points).map(|i| Vec3::new(number(i + 3), number(i + 5), number(i + 11))).collect();
    groom.set_attribute(names::COLOR, Attribute { domain: Domain::Vertex, values: Values::Vec3(colors) })?;
    groom.set_attribute(names::RADIUS, Attribute::constant_float(0.05))?;
    groom.up_axis = groom::UpAxis::Z;
    Ok(groom)
}
