//! What it costs that a small file is whole: plain writes, a rename, a flushed file, a flushed file and folder.
//!
//! `cargo bench -p whole-file [FOLDER]`; the folder decides which disk is measured [default: the system's
//! temporary one].
#![allow(clippy::print_stdout, clippy::unwrap_used, missing_docs)]

use std::fs::{self, File};
use std::path::Path;
use std::time::Instant;

const FILES: usize = 200;

/// What it is called, and how it writes a file.
type Way<'a> = (&'a str, &'a dyn Fn(&Path));

fn main() {
    let folder = std::env::args().skip(1).find(|word| !word.starts_with('-'));
    let folder = folder.map_or_else(std::env::temp_dir, Into::into);
    let folder = tempfile::tempdir_in(folder).unwrap();
    let bytes = vec![0x5a; 4096];
    let renamed = |path: &Path, flush: bool| {
        let temporary = path.with_extension("tmp");
        fs::write(&temporary, &bytes).unwrap();
        if flush {
            File::open(&temporary).unwrap().sync_all().unwrap();
        }
        fs::rename(temporary, path).unwrap();
    };
    let whole = |path: &Path| whole_file::write_whole(path, &bytes).unwrap();
    let ways: [Way; 4] = [
        ("plain write", &|path| fs::write(path, &bytes).unwrap()),
        ("and a rename", &|path| renamed(path, false)),
        ("and the file flushed", &|path| renamed(path, true)),
        ("whole-file: and the folder flushed", &whole),
    ];
    for round in 0..3 {
        for (index, (words, write)) in ways.iter().enumerate() {
            let clock = Instant::now();
            for file in 0..FILES {
                write(&folder.path().join(format!("{round}.{index}.{file}")));
            }
            let each = clock.elapsed().as_secs_f64() / FILES as f64;
            println!("{words}: {:.3} ms a file of 4 KiB", each * 1e3);
        }
    }
}
