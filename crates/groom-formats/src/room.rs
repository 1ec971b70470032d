//! How much memory the groom of a file may take.

use std::cell::Cell;

/// Memory that even the smallest file may ask for.
const FREE: u64 = 1 << 20;

/// What is left of the memory that a groom may take: four times the size of its file and a megabyte. Files hold
/// equal arrays once, compress them and share values, so that a short one can ask for a long groom.
#[derive(Debug)]
pub(crate) struct Room {
    all: u64,
    left: Cell<u64>,
}

impl Room {
    pub(crate) fn of(file: usize) -> Self {
        let all = (file as u64).saturating_mul(4).saturating_add(FREE);
        Room { all, left: Cell::new(all) }
    }

    /// As it was at first: what was taken is not needed any more.
    pub(crate) fn refill(&self) {
        self.left.set(self.all);
    }

    /// Takes room for `count` values of `size` bytes; what was found and expected when there is not as much left.
    pub(crate) fn take(&self, count: usize, size: usize) -> Result<(), (String, String)> {
        let bytes = (count as u64).saturating_mul(size as u64);
        let left = self.left.get().checked_sub(bytes).ok_or_else(|| {
            let found = format!("{count} more values of {size} bytes");
            (found, "no more than four times the file's size and a megabyte in all".to_owned())
        })?;
        self.left.set(left);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn room_is_four_times_the_file_and_a_megabyte() {
        let room = Room::of(10);
        assert_eq!(room.take(1 << 18, 4), Ok(()));
        assert_eq!(room.take(10, 4), Ok(()));
        assert!(room.take(1, 1).is_err_and(|(found, _)| found == "1 more values of 1 bytes"));
        assert!(Room::of(10).take(usize::MAX, usize::MAX).is_err());
    }
}
