//! What came of a binding.

use crate::BindOptions;

/// How far roots are from the surface, and which strands want a look.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BindReport {
    /// Strands of the groom.
    pub strands: usize,
    /// The diagonal of the box round the mesh at rest, in its units.
    pub mesh_size: f64,
    /// The roots' distances from their places, least first: minimum, median and maximum are read off it.
    pub distances: Vec<f64>,
    /// The mean of the distances; 0 without strands.
    pub mean_distance: f64,
    /// The strands that are farther off than the limit, whatever was done with them.
    pub beyond: Vec<u32>,
    /// The strands that are bound, when some were dropped: what [`groom::Groom::keep_strands`] is to be given
    /// before the binding is used. `None`: all.
    pub kept: Option<Vec<u32>>,
    /// Bound by texture coordinate: strands whose coordinate several triangles hold.
    pub ambiguous: Vec<u32>,
    /// Bound by texture coordinate: strands whose coordinate no triangle holds; the nearest one was taken.
    pub outside: Vec<u32>,
    /// Strands on a triangle that tells no frame at rest, which are moved without being turned: it has no area, and was
    /// named by its number or the mesh has no other; or its first edge stands on the surface's smoothed normal.
    pub without_frame: usize,
}

impl BindReport {
    /// The distance that a share of the strands does not exceed: 0 the least, 0.5 the median, 1 the greatest.
    /// `None` without strands, or when the share is not in 0..=1.
    #[must_use]
    pub fn distance_at(&self, share: f64) -> Option<f64> {
        let last = self.distances.len().checked_sub(1)?;
        let share = (0.0..=1.0).contains(&share).then_some(share)?;
        let place = (share * last as f64).round() as usize;
        self.distances.get(place).copied()
    }

    pub(crate) fn of(mesh_size: f64, distances: Vec<f64>, options: &BindOptions) -> Self {
        let strands = distances.len();
        let beyond = |&strand: &u32| options.limit.is_some_and(|limit| distances[strand as usize] > limit);
        let beyond = (0..strands as u32).filter(beyond).collect();
        let mean_distance = distances.iter().sum::<f64>() / strands.max(1) as f64;
        let mut distances = distances;
        distances.sort_unstable_by(f64::total_cmp);
        BindReport { strands, mesh_size, distances, mean_distance, beyond, ..BindReport::default() }
    }
}
