//! Files that lie, made from one that does not.
#![allow(dead_code)] // each test file uses some of it

use groom_formats::{Format, FormatError};

use super::from_bytes;

/// Refuses every file that `bytes` starts with, naming a place; returns the errors.
pub fn cut_everywhere(format: Format, bytes: &[u8]) -> Vec<FormatError> {
    let cut = |length| match from_bytes(format, &bytes[..length]) {
        Err(error) => error,
        Ok(_) => panic!("{format} cut at {length} of {} bytes is read", bytes.len()),
    };
    let errors: Vec<FormatError> = (0..bytes.len()).map(cut).collect();
    for error in &errors {
        let told = error.to_string();
        assert!(matches!(error, FormatError::Invalid { .. } | FormatError::Groom { .. }), "{told}");
        assert!(told.contains(": found ") && told.contains(", expected "), "{told}");
    }
    errors
}

/// Reads the file with every byte changed in a few ways: whatever comes of it, nothing may panic.
pub fn change_everywhere(format: Format, bytes: &[u8]) {
    for at in 0..bytes.len() {
        for change in [1_u8, 0x80, 0xff, 0x55] {
            let mut changed = bytes.to_vec();
            changed[at] ^= change;
            let _ = from_bytes(format, &changed);
        }
    }
}

/// The file with the `u32` at `at` replaced.
pub fn with_u32(bytes: &[u8], at: usize, value: u32) -> Vec<u8> {
    let mut bytes = bytes.to_vec();
    bytes[at..at + 4].copy_from_slice(&value.to_le_bytes());
    bytes
}

/// What is said of a file that is refused.
pub fn told(format: Format, bytes: &[u8]) -> String {
    match from_bytes(format, bytes) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("{format} is read"),
    }
}
