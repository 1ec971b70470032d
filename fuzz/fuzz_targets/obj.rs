//! Any bytes: the OBJ reader refuses them or makes a groom that is written and read back the same.
#![no_main]

use groom_formats::{Format, ReadOptions, WriteOptions, read_from, write_to};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let read = |bytes| read_from(Format::Obj, bytes, "fuzz", &ReadOptions::default());
    let Ok(loaded) = read(bytes) else { return };
    let mut written = Vec::new();
    if write_to(Format::Obj, &loaded.groom, &mut written, "fuzz", &WriteOptions::default()).is_ok() {
        let again = read(&written).unwrap();
        assert_eq!(again.groom.offsets(), loaded.groom.offsets());
        assert_eq!(again.groom.positions(), loaded.groom.positions());
    }
});
