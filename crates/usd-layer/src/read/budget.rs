//! How much memory a file may ask for.

use crate::read::ReadError;

/// Memory that even the smallest file may ask for.
const FREE: u64 = 1 << 20;

/// What is left of the memory a file may ask for: four times its size and a megabyte. Counts in files cannot
/// be trusted, and compression and shared values let a short file claim a long one.
#[derive(Debug)]
pub(crate) struct Budget {
    left: u64,
}

impl Budget {
    pub(crate) fn of(file: usize) -> Self {
        Budget { left: limit(file) }
    }

    /// Takes `bytes`; `fault` makes the error when there are not as many left.
    pub(crate) fn take(&mut self, bytes: u64, fault: impl FnOnce() -> ReadError) -> Result<(), ReadError> {
        self.left = self.left.checked_sub(bytes).ok_or_else(fault)?;
        Ok(())
    }
}

/// The most that one array of a file of this size may be.
pub(crate) fn limit(file: usize) -> u64 {
    (file as u64).saturating_mul(4).saturating_add(FREE)
}

/// What an error says was expected.
pub(crate) const EXPECTED: &str = "no more than four times the file's size and a megabyte";
