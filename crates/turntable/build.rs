//! Tells the program which sources it was built from, so that what other sources made counts as stale.
#![allow(clippy::print_stdout)] // how a build script talks to cargo

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn main() {
    let crates = Path::new("..");
    let mut files = BTreeSet::new();
    // Every room counts: to know which of them an output depends on would be one more thing to keep right.
    for room in std::fs::read_dir(crates).into_iter().flatten().flatten() {
        let sources = room.path().join("src");
        println!("cargo::rerun-if-changed={}", sources.display());
        gather(&sources, &mut files);
    }
    let lock = PathBuf::from("../../Cargo.lock");
    if lock.is_file() {
        println!("cargo::rerun-if-changed={}", lock.display());
        files.insert(lock);
    }
    let mut hash = Fnv::default();
    for file in &files {
        hash.add(file.to_string_lossy().replace('\\', "/").as_bytes());
        hash.add(&std::fs::read(file).unwrap_or_default());
    }
    println!("cargo::rustc-env=TURNTABLE_SOURCES={:016x}", hash.0);
}

fn gather(folder: &Path, files: &mut BTreeSet<PathBuf>) {
    for entry in std::fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            gather(&path, files);
        } else {
            // Scripts and style sheets of pages, too.
            files.insert(path);
        }
    }
}

/// FNV-1a: the same on every machine and with every compiler, which std's hasher does not promise.
struct Fnv(u64);

impl Default for Fnv {
    fn default() -> Self {
        Fnv(0xcbf2_9ce4_8422_2325)
    }
}

impl Fnv {
    fn add(&mut self, bytes: &[u8]) {
        let length = (bytes.len() as u64).to_le_bytes();
        for byte in length.iter().chain(bytes) {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}
