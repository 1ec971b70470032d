//! Any bytes: the Alembic reader refuses them or makes a groom that is written and read back the same.
#![no_main]

use std::io::Cursor;

use groom_formats::{Format, ReadOptions, WriteOptions, read_from, write_seekable};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(loaded) = read_from(Format::Alembic, bytes, "fuzz", &ReadOptions::default()) else { return };
    let mut file = Cursor::new(Vec::new());
    // Values that are not finite are refused.
    let written = write_seekable(Format::Alembic, &loaded.groom, &mut file, "fuzz", &WriteOptions::default());
    if written.is_ok_and(|warnings| warnings.is_empty()) {
        let again = read_from(Format::Alembic, &file.get_ref()[..], "fuzz", &ReadOptions::default()).unwrap();
        assert_eq!(again.groom.positions(), loaded.groom.positions());
        // Guides that strands follow go by other names, and take ids along.
        let others = loaded.groom.attributes().filter(|(name, _)| !name.contains("guide"));
        others.for_each(|(name, _)| assert!(again.groom.attribute(name).is_some(), "{name}"));
    }
});
