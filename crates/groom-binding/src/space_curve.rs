//! Points in an order in which neighbours are near each other.

use glam::DVec3;

use crate::surface::bounds;

/// The numbers of points by where they are on a Morton curve of 1024 steps a side.
pub(crate) fn along_a_curve(points: &[DVec3]) -> Vec<u32> {
    let (low, high) = bounds(points.iter().copied());
    let scale = 1023.0 / (high - low).max_element().max(f64::MIN_POSITIVE);
    let key = |&at: &DVec3| {
        // Beyond the numbers is the far end.
        let cell = (at - low) * scale;
        spread(cell.x as u32) | spread(cell.y as u32) << 1 | spread(cell.z as u32) << 2
    };
    let mut order: Vec<(u32, u32)> = points.iter().map(key).zip(0..).collect();
    order.sort_unstable();
    order.into_iter().map(|(_, number)| number).collect()
}

/// Ten bits with two empty ones after each.
fn spread(bits: u32) -> u32 {
    let bits = bits.min(1023);
    let bits = (bits | bits << 16) & 0x0300_00ff;
    let bits = (bits | bits << 8) & 0x0300_f00f;
    let bits = (bits | bits << 4) & 0x030c_30c3;
    (bits | bits << 2) & 0x0924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_point_once_and_neighbours_near() {
        let points: Vec<DVec3> = (0..4096)
            .map(|i| {
                let i = i * 1571 % 4096;
                DVec3::new(f64::from(i % 16), f64::from(i / 16 % 16), f64::from(i / 256)) * 1e-9
            })
            .collect();
        let order = along_a_curve(&points);
        let length: f64 =
            order.windows(2).map(|w| points[w[0] as usize].distance(points[w[1] as usize])).sum();
        assert!(length < 2.0 * 4096e-9, "{length}");
        let mut sorted = order;
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..4096));
        assert_eq!(along_a_curve(&[DVec3::ONE; 3]), [0, 1, 2]);
    }
}
