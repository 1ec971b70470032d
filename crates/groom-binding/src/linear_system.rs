//! Small dense linear systems.

use glam::DVec3;

/// A square matrix taken apart, to be solved for many right sides: LU with rows exchanged for the greatest pivot.
#[derive(Clone, Debug)]
pub(crate) struct LinearSystem {
    size: usize,
    /// Row after row, L below the diagonal and U on and above it.
    factors: Vec<f64>,
    /// Which row of the right side comes to each place.
    order: Vec<usize>,
}

impl LinearSystem {
    /// Takes `matrix` apart, rows one after another; none when it is not square or singular to working precision.
    pub(crate) fn new(size: usize, mut matrix: Vec<f64>) -> Option<Self> {
        if matrix.len() != size.checked_mul(size)? {
            return None;
        }
        let greatest = matrix.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let mut order: Vec<usize> = (0..size).collect();
        for k in 0..size {
            let size_at = |row: usize| matrix[row * size + k].abs();
            let pivot = (k..size).max_by(|&a, &b| size_at(a).total_cmp(&size_at(b)).then(b.cmp(&a)))?;
            if size_at(pivot).is_nan() || size_at(pivot) <= 1e-13 * greatest {
                return None;
            }
            if pivot != k {
                order.swap(pivot, k);
                let (upper, lower) = matrix.split_at_mut(pivot * size);
                upper[k * size..(k + 1) * size].swap_with_slice(&mut lower[..size]);
            }
            let (upper, lower) = matrix.split_at_mut((k + 1) * size);
            let row = &upper[k * size..];
            for below in lower.chunks_exact_mut(size) {
                let factor = below[k] / row[k];
                below[k] = factor;
                for (x, above) in below[k + 1..].iter_mut().zip(&row[k + 1..]) {
                    *x -= factor * above;
                }
            }
        }
        Some(LinearSystem { size, factors: matrix, order })
    }

    /// The solution for one right side of three columns, `size` rows.
    pub(crate) fn solve(&self, right: &[DVec3]) -> Vec<DVec3> {
        let size = self.size;
        let mut x: Vec<DVec3> =
            self.order.iter().map(|&row| right.get(row).copied().unwrap_or_default()).collect();
        for i in 0..size {
            let row = &self.factors[i * size..i * size + i];
            let sum: DVec3 = row.iter().zip(&x).map(|(&factor, &x)| x * factor).sum();
            x[i] -= sum;
        }
        for i in (0..size).rev() {
            let row = &self.factors[i * size..(i + 1) * size];
            let sum: DVec3 = row[i + 1..].iter().zip(&x[i + 1..]).map(|(&factor, &x)| x * factor).sum();
            x[i] = (x[i] - sum) / row[i];
        }
        x
    }
}

#[cfg(test)]
mod tests {
    use groom::random;

    use super::*;

    #[test]
    fn solutions_give_the_right_side_back() {
        let size = 40;
        let number = |id, purpose| f64::from(random(3, id, purpose)) - 0.5;
        // Zeros on the diagonal: nothing goes without exchanging rows.
        let matrix: Vec<f64> = (0..size * size)
            .map(|i| if i % (size + 1) == 0 { 0.0 } else { number(i as u32, "matrix") })
            .collect();
        let known: Vec<DVec3> =
            (0..size as u32).map(|i| DVec3::new(number(i, "x"), number(i, "y"), number(i, "z"))).collect();
        let right: Vec<DVec3> =
            matrix.chunks_exact(size).map(|row| row.iter().zip(&known).map(|(&a, &x)| x * a).sum()).collect();
        let found = LinearSystem::new(size, matrix).unwrap().solve(&right);
        assert!(found.iter().zip(&known).all(|(a, b)| a.distance(*b) < 1e-10));
    }

    #[test]
    fn what_cannot_be_solved_is_told() {
        assert!(LinearSystem::new(2, vec![1.0, 2.0, 2.0, 4.0]).is_none());
        assert!(LinearSystem::new(2, vec![f64::NAN; 4]).is_none());
        assert!(LinearSystem::new(2, vec![1.0; 3]).is_none());
        assert!(LinearSystem::new(0, vec![]).unwrap().solve(&[]).is_empty());
    }
}
