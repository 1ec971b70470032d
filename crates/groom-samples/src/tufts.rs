//! Which tuft a strand belongs to.

use std::collections::HashMap;

use glam::DVec3;

use crate::scatter::Root;

/// Roots in cells of a lattice, to find the closest.
pub(crate) struct Tufts<'a> {
    roots: &'a [Root],
    cells: HashMap<[i64; 3], Vec<u32>>,
    cell: f64,
    low: DVec3,
}

impl<'a> Tufts<'a> {
    /// Tufts around `roots` that are about `spacing` apart.
    pub(crate) fn new(roots: &'a [Root], spacing: f64) -> Self {
        let low = roots.iter().fold(DVec3::INFINITY, |low, root| low.min(root.place));
        let mut tufts = Tufts { roots, cells: HashMap::new(), cell: spacing, low };
        for (i, root) in roots.iter().enumerate() {
            tufts.cells.entry(tufts.cell_of(root.place)).or_default().push(i as u32);
        }
        tufts
    }

    fn cell_of(&self, place: DVec3) -> [i64; 3] {
        ((place - self.low) / self.cell).floor().to_array().map(|x| x as i64)
    }

    /// The closest tuft within one to two cells on skin that faces the same way: an ear's inside does not reach
    /// through to its outside.
    pub(crate) fn closest(&self, root: &Root) -> Option<usize> {
        let [x, y, z] = self.cell_of(root.place);
        let mut best: Option<(f64, u32)> = None;
        for (dx, dy, dz) in (0..27).map(|i| (i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)) {
            let cell = [x.saturating_add(dx), y.saturating_add(dy), z.saturating_add(dz)];
            let Some(members) = self.cells.get(&cell) else { continue };
            for &i in members {
                let other = &self.roots[i as usize];
                let distance = other.place.distance_squared(root.place);
                let closer = best.is_none_or(|best| (distance, i) < best);
                if closer && other.normal.dot(root.normal) > 0.5 {
                    best = Some((distance, i));
                }
            }
        }
        best.map(|(_, i)| i as usize)
    }
}
