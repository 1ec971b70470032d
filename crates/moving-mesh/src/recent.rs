//! Frames that are read when they are wanted, and a few of them kept.

use std::sync::{Arc, Mutex, PoisonError};

use crate::error::Fault;

/// A pose and those a little before and after it lie among this many frames.
const KEPT: usize = 4;

/// The frames that were wanted last.
#[derive(Debug)]
pub(crate) struct Recent<T> {
    /// Number and frame, the one wanted last at the end.
    held: Mutex<Vec<(usize, Arc<T>)>>,
}

impl<T> Default for Recent<T> {
    fn default() -> Self {
        Recent { held: Mutex::default() }
    }
}

impl<T> Recent<T> {
    /// Frame `number`, read by `read` unless it is still here.
    pub(crate) fn get(
        &self,
        number: usize,
        read: impl FnOnce() -> Result<T, Fault>,
    ) -> Result<Arc<T>, Fault> {
        if let Some(frame) = self.found(number) {
            return Ok(frame);
        }
        // Not locked while reading; two who want the same frame at once read it twice.
        let frame = Arc::new(read()?);
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        held.retain(|(known, _)| *known != number);
        if held.len() >= KEPT {
            held.remove(0);
        }
        held.push((number, Arc::clone(&frame)));
        Ok(frame)
    }

    fn found(&self, number: usize) -> Option<Arc<T>> {
        let mut held = self.held.lock().unwrap_or_else(PoisonError::into_inner);
        let at = held.iter().position(|(known, _)| *known == number)?;
        let frame = held.remove(at);
        held.push(frame);
        held.last().map(|(_, frame)| Arc::clone(frame))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_frames_wanted_last_are_kept() {
        let recent = Recent::default();
        let mut reads = Vec::new();
        for number in [0, 1, 2, 3, 0, 4, 0, 1, 3] {
            recent
                .get(number, || {
                    reads.push(number);
                    Ok(number)
                })
                .unwrap();
        }
        assert_eq!(reads, [0, 1, 2, 3, 4, 1], "1 had to go for 4, 2 for 1");
        assert!(recent.get(9, || Err(Fault::invalid("", ""))).is_err());
        assert_eq!(*recent.get(9, || Ok(9)).unwrap(), 9);
    }
}
