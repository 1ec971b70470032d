//! How much a file may be made into.

use crate::error::Fault;

/// Elements that any file may be made into, be it as small as it is.
const ALWAYS_ALLOWED: usize = 1 << 20;

/// Vertices, corners and keys that a file may still be made into. A few words can name the same array again and
/// again: what is asked for is held against the length of the file before memory is taken for it.
#[derive(Debug)]
pub(crate) struct Budget {
    left: usize,
    most: usize,
}

impl Budget {
    /// For a file of so many bytes, each of which may stand for so many elements.
    pub(crate) fn new(bytes: usize, elements_per_byte: usize) -> Self {
        let most = bytes.saturating_mul(elements_per_byte).saturating_add(ALWAYS_ALLOWED);
        Budget { left: most, most }
    }

    /// # Errors
    /// [`Fault::Invalid`] at `place` where `elements` are more than is left.
    pub(crate) fn take(&mut self, elements: usize, place: &str) -> Result<(), Fault> {
        let left = self.left.checked_sub(elements).ok_or_else(|| {
            let (before, most) = (self.most - self.left, self.most);
            let fault = format!("{elements} vertices, corners and keys after {before} others");
            Fault::invalid(place, format!("{fault}, expected at most {most} in a file of this length"))
        })?;
        self.left = left;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_is_no_more_than_there_is() {
        let mut budget = Budget::new(10, 3);
        budget.take(ALWAYS_ALLOWED, "a").unwrap();
        budget.take(30, "b").unwrap();
        budget.take(0, "c").unwrap();
        let told = budget.take(1, "nodes[3]").unwrap_err().in_file("x.glb".as_ref()).to_string();
        let expected = "1 vertices, corners and keys after 1048606 others, expected at most 1048606";
        assert!(told.starts_with(&format!("x.glb: nodes[3]: {expected}")), "{told}");
        assert!(Budget::new(usize::MAX, 4).take(usize::MAX, "all").is_ok());
    }
}
