//! Any bytes: the glTF reader refuses them or makes a groom that is written and read back with as many strands.
#![no_main]

use groom_formats::{Format, ReadOptions, WriteOptions, read_from, write_to};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let options = ReadOptions::default();
    let Ok(loaded) = read_from(Format::Glb, bytes, "fuzz", &options) else { return };
    let mut out = Vec::new();
    let write = WriteOptions { all_attributes: true, ..WriteOptions::default() };
    // Radii below 0 and colours that are no numbers are read and not written.
    if write_to(Format::Glb, &loaded.groom, &mut out, "fuzz", &write).is_ok() {
        let again = read_from(Format::Glb, &out[..], "fuzz", &options).unwrap();
        assert_eq!(again.groom.offsets(), loaded.groom.offsets());
    }
});
