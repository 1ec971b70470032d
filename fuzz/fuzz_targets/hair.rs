//! Any bytes: every way of reading agrees on whether they are a file, and what is read is written back.
#![no_main]

use std::io::Cursor;

use cyhair::{HairError, HairFile, HairReader, HairView};
use libfuzzer_sys::fuzz_target;

fn stream(bytes: &[u8]) -> Result<u64, HairError> {
    let mut reader = HairReader::new(Cursor::new(bytes))?;
    let mut strands = 0;
    while reader.next_strand()?.is_some() {
        strands += 1;
    }
    Ok(strands)
}

fuzz_target!(|bytes: &[u8]| {
    let loaded = HairFile::from_bytes(bytes);
    assert_eq!(loaded.is_ok(), HairFile::read(bytes, None).is_ok());
    assert_eq!(loaded.is_ok(), HairView::new(bytes).is_ok());
    // A header without arrays may promise 2^32 strands: right, but going through them takes minutes.
    if loaded.as_ref().is_ok_and(|loaded| loaded.file.strand_count() > bytes.len()) {
        return;
    }
    assert_eq!(loaded.is_ok(), stream(bytes).is_ok());
    if let Ok(loaded) = loaded {
        let written = loaded.file.to_bytes().unwrap();
        assert_eq!(written[16..], bytes[16..written.len()]);
        assert_eq!(stream(bytes).unwrap(), u64::from(loaded.file.header.hair_count));
    }
    if let Ok(repaired) = HairFile::read_and_repair(bytes) {
        let again = HairFile::from_bytes(&repaired.file.to_bytes().unwrap()).unwrap();
        assert!(again.warnings.len() <= usize::from(repaired.file.points.is_none()));
    }
});
