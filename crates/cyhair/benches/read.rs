//! How fast a HAIR file is read from the page cache, and what memory that takes.
//!
//! `cargo bench -p cyhair -- [PATH]`; without a path a file of 300 MB is made and removed again.
#![allow(clippy::print_stdout)]

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use cyhair::{HairFile, HairReader, Header};

fn main() -> Result<(), Box<dyn Error>> {
    // Cargo passes `--bench`; whatever is not a flag is the path.
    match std::env::args().skip(1).find(|argument| !argument.starts_with('-')) {
        Some(path) => measure(Path::new(&path)),
        None => {
            let path = std::env::temp_dir().join(format!("cyhair-bench-{}.hair", std::process::id()));
            let measured = make(&path).and_then(|()| measure(&path));
            std::fs::remove_file(&path)?;
            measured
        }
    }
}

/// 100,000 strands of 250 points, written strand by strand so that it takes no memory.
fn make(path: &PathBuf) -> Result<(), Box<dyn Error>> {
    let header = Header {
        hair_count: 100_000,
        point_count: 25_000_000,
        arrays: 2,
        default_segments: 249,
        ..Header::default()
    };
    let mut writer = cyhair::HairWriter::new(std::fs::File::create(path)?, header, None)?;
    for strand in 0..header.hair_count {
        let points: Vec<[f32; 3]> = (0..250_u16).map(|i| [strand as f32, f32::from(i), 0.5]).collect();
        writer.push(cyhair::Strand { points: Some(&points), ..cyhair::Strand::default() })?;
    }
    writer.finish()?;
    Ok(())
}

fn measure(path: &Path) -> Result<(), Box<dyn Error>> {
    let bytes = std::fs::metadata(path)?.len() as f64;
    let mut streamed = f64::INFINITY;
    for _ in 0..3 {
        let start = Instant::now();
        let mut reader = HairReader::new(std::fs::File::open(path)?)?;
        while reader.next_strand()?.is_some() {}
        streamed = streamed.min(start.elapsed().as_secs_f64());
    }
    println!("stream: {:.2} GB/s, peak memory {}", bytes / streamed / 1e9, peak(bytes));
    let mut whole = f64::INFINITY;
    for _ in 0..5 {
        let start = Instant::now();
        let loaded = HairFile::open(path)?;
        whole = whole.min(start.elapsed().as_secs_f64());
        drop(loaded);
    }
    println!("read:   {:.2} GB/s, peak memory {}", bytes / whole / 1e9, peak(bytes));
    Ok(())
}

/// The largest resident memory of this process so far, where Linux tells it.
fn peak(bytes: f64) -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kib = line.and_then(|line| line.trim().trim_end_matches(" kB").parse::<f64>().ok());
    match kib {
        Some(kib) => format!("{:.1} MiB = {:.2} x the file", kib / 1024.0, kib * 1024.0 / bytes),
        None => "unknown".into(),
    }
}
