//! Any bytes: the PLY reader refuses them or makes a groom that is written and read back the same.
#![no_main]

use groom_formats::{Format, ReadOptions, WriteOptions, read_from, write_to};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    for points_per_strand in [None, Some(2)] {
        let options = ReadOptions { points_per_strand, ..ReadOptions::default() };
        let Ok(loaded) = read_from(Format::Ply, bytes, "fuzz", &options) else { continue };
        let mut written = Vec::new();
        // Attributes may hold what no file should: colours that are no numbers, radii whose double is none.
        if write_to(Format::Ply, &loaded.groom, &mut written, "fuzz", &WriteOptions::default()).is_err() {
            continue;
        }
        let again = read_from(Format::Ply, &written[..], "fuzz", &ReadOptions::default()).unwrap();
        assert_eq!(again.groom.offsets(), loaded.groom.offsets());
        assert_eq!(again.groom.positions(), loaded.groom.positions());
    }
});
