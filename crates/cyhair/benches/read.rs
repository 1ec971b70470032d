//! How fast a HAIR file is read from the page cache, and what memory that takes.
//!
//! `stream` keeps nothing. `read` drops every file again, and the system then takes the memory back:
//! each pass pays for fresh pages, as a program that reads one file does. With glibc, what is left
//! without that shows under `GLIBC_TUNABLES=glibc.malloc.trim_threshold=1000000000:\
//! glibc.malloc.mmap_threshold=1000000000`.
//!
//! `cargo bench -p cyhair -- [PATH]`; without a path a file of 300 MB is made and removed again.
#![allow(clippy::print_stdout)]

use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use cyhair::{HairError, HairFile, HairReader, Header};

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
    let streamed = speeds(bytes, || {
        let file =
            std::fs::File::open(path).map_err(|source| HairError::Open { path: path.to_owned(), source })?;
        let mut reader = HairReader::new(file)?;
        while reader.next_strand()?.is_some() {}
        Ok(())
    })?;
    println!("stream: {streamed}, peak memory {}", peak(bytes));
    let whole = speeds(bytes, || HairFile::open(path).map(drop))?;
    println!("read:   {whole}, peak memory {}", peak(bytes));
    Ok(())
}

/// Best and median speed of going through a file of `bytes` bytes, in words.
fn speeds(bytes: f64, mut pass: impl FnMut() -> Result<(), HairError>) -> Result<String, HairError> {
    // Half a gigabyte and no fewer than five passes.
    let mut seconds = vec![0.0; (5e8 / bytes).ceil().clamp(5.0, 200.0) as usize];
    for seconds in &mut seconds {
        let start = Instant::now();
        pass()?;
        *seconds = start.elapsed().as_secs_f64();
    }
    seconds.sort_by(f64::total_cmp);
    let speed = |seconds: f64| bytes / seconds / 1e9;
    let (best, median) = (speed(seconds[0]), speed(seconds[seconds.len() / 2]));
    Ok(format!("{best:.2} GB/s (median {median:.2})"))
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
