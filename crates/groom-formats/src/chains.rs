//! Strands put together from lines between numbered vertices.

use groom::Values;

use crate::FormatError;

/// Points that are never too many.
const FREE: usize = 1000;

/// Strands as indices of vertices.
#[derive(Default)]
pub(crate) struct Chains {
    /// Where every strand starts in `indices`.
    starts: Vec<u32>,
    indices: Vec<u32>,
    /// Whether another line may go on where the last one ended.
    open: bool,
}

impl Chains {
    /// Room for `points` points; lines come one after another.
    pub(crate) fn with_capacity(points: usize) -> Self {
        Chains { starts: Vec::new(), indices: Vec::with_capacity(points), open: false }
    }

    /// A line between two vertices: it goes on with the strand before if it starts where that ended.
    pub(crate) fn segment(&mut self, from: u32, to: u32) {
        if !self.open || self.indices.last() != Some(&from) {
            self.begin();
            self.indices.push(from);
        }
        self.indices.push(to);
        self.open = true;
    }

    /// Starts a strand; points follow by [`point`](Self::point).
    pub(crate) fn begin(&mut self) {
        // More indices than a u32 can count are refused by whoever asks for `offsets`.
        self.starts.push(self.indices.len() as u32);
        self.open = false;
    }

    /// The next point of the strand that was begun.
    pub(crate) fn point(&mut self, vertex: u32) {
        self.indices.push(vertex);
    }

    /// How many points all strands have together.
    pub(crate) fn len(&self) -> usize {
        self.indices.len()
    }

    /// Refuses strands of more than `most` points in all: when they use the file's vertices over and over, a few
    /// bytes of it would take any amount of memory. Small files may do as they like.
    pub(crate) fn refuse_overuse(&self, most: usize, vertices: usize, file: &str) -> Result<(), FormatError> {
        let most = most + FREE;
        if self.len() <= most {
            return Ok(());
        }
        let found = format!("strands of {} points on {vertices} vertices", self.len());
        Err(FormatError::invalid(file, "the whole file", found, format!("{most} points at most")))
    }

    /// Where each strand starts, and the number of points after them; then the vertices.
    pub(crate) fn into_offsets(mut self) -> (Vec<u32>, Vec<u32>) {
        self.starts.push(self.indices.len() as u32);
        (self.starts, self.indices)
    }
}

/// Whether the indices are `0, 1, 2...` up to `vertices`: then nothing has to be moved.
pub(crate) fn in_order(indices: &[u32], vertices: usize) -> bool {
    indices.len() == vertices && indices.iter().enumerate().all(|(i, &index)| i == index as usize)
}

/// The values at `indices`; every index is in the array.
pub(crate) fn pick<T: Copy>(values: &[T], indices: &[u32]) -> Vec<T> {
    indices.iter().map(|&index| values[index as usize]).collect()
}

/// As [`pick`], for values of any type.
pub(crate) fn pick_values(values: &Values, indices: &[u32]) -> Values {
    match values {
        Values::Float(v) => Values::Float(pick(v, indices)),
        Values::Vec2(v) => Values::Vec2(pick(v, indices)),
        Values::Vec3(v) => Values::Vec3(pick(v, indices)),
        Values::Int(v) => Values::Int(pick(v, indices)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_that_meet_are_one_strand() {
        let mut chains = Chains::default();
        for (from, to) in [(0, 1), (1, 2), (3, 4), (4, 3), (2, 1)] {
            chains.segment(from, to);
        }
        chains.begin();
        [1, 5, 6].iter().for_each(|&vertex| chains.point(vertex));
        // A strand that was given whole is whole.
        chains.segment(6, 7);
        let (offsets, indices) = chains.into_offsets();
        assert_eq!(offsets, [0, 3, 6, 8, 11, 13]);
        assert_eq!(indices, [0, 1, 2, 3, 4, 3, 2, 1, 1, 5, 6, 6, 7]);
        assert!(in_order(&[0, 1, 2], 3) && !in_order(&[0, 1], 3) && !in_order(&[0, 2, 1], 3));
        assert_eq!(pick(&["a", "b", "c"], &[2, 2, 0]), ["c", "c", "a"]);
    }
}
