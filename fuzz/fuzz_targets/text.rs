//! Any bytes: the text reader refuses them or makes a groom that is written and read back the same.
#![no_main]

use groom_formats::{Format, ReadOptions, WriteOptions, text, write_to};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(loaded) = text::read(bytes, "fuzz", &ReadOptions::default()) else { return };
    let write = |groom| {
        let mut out = Vec::new();
        write_to(Format::Text, groom, &mut out, "fuzz", &WriteOptions::default()).unwrap();
        out
    };
    let first = write(&loaded.groom);
    let again = text::read(&first[..], "fuzz", &ReadOptions::default()).unwrap();
    assert_eq!(first, write(&again.groom));
});
