//! Any bytes: the reader of USC's .data refuses them or makes a groom that repair leaves sound.
#![no_main]

use groom_formats::{Format, ReadOptions, read_from};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let read = |repair| {
        let options = ReadOptions { repair, known_len: Some(bytes.len() as u64), ..ReadOptions::default() };
        read_from(Format::Data, bytes, "fuzz", &options)
    };
    if let Ok(loaded) = read(false) {
        assert!(loaded.groom.positions().iter().all(|point| point.is_finite()));
        assert!(loaded.groom.point_count() <= bytes.len());
    }
    if let Ok(mended) = read(true) {
        assert!(mended.groom.strands().all(|strand| strand.len() > 1));
    }
});
