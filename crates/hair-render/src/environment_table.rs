//! Choosing directions in proportion to the light of an environment picture.

use std::f32::consts::PI;

use glam::Vec3;

use crate::environment::{LatLong, direction_at, row_height, uv_of};

/// Cumulated brightness of a picture: of its rows, and of the pixels in each row.
///
/// A direction is uniform in solid angle within its pixel. A pixel weighs what the bilinear picture
/// holds over it, so wherever there is light the density is above 0.
#[derive(Debug)]
pub(crate) struct EnvironmentTable {
    width: usize,
    height: usize,
    rows: Vec<f32>,
    pixels: Vec<f32>,
    /// Where to begin looking in `rows`, and for every row in its part of `pixels`.
    row_guide: Vec<u32>,
    pixel_guide: Vec<u32>,
    /// Heights on the unit sphere at which rows begin, and the last one ends.
    edges: Vec<f32>,
    /// Pixels per solid angle, by row.
    pixels_per_steradian: Vec<f32>,
}

impl EnvironmentTable {
    /// The table of a picture; `None` when it is black.
    pub fn new(picture: &LatLong) -> Option<Self> {
        let (width, height) = (picture.width, picture.height);
        let mut pixels = Vec::with_capacity((width + 1) * height);
        let mut pixel_guide = Vec::with_capacity(width * height);
        let mut row_sums = Vec::with_capacity(height);
        for y in 0..height {
            let weights = (0..width).map(|x| pixel_weight(picture, x as isize, y as isize));
            row_sums.push(push_cumulated(&mut pixels, weights) * f64::from(row_height(y, height)));
            pixel_guide.extend(guide(&pixels[y * (width + 1)..]));
        }
        let mut rows = Vec::with_capacity(height + 1);
        let total = push_cumulated(&mut rows, row_sums.into_iter());
        let row_guide = guide(&rows).collect();
        let edges = (0..=height).map(|row| (PI * row as f32 / height as f32).cos()).collect();
        let pixels_per_steradian =
            (0..height).map(|row| width as f32 / (2.0 * PI * row_height(row, height))).collect();
        (total > 0.0).then_some(EnvironmentTable {
            width,
            height,
            rows,
            pixels,
            row_guide,
            pixel_guide,
            edges,
            pixels_per_steradian,
        })
    }

    /// A direction in the picture's axes and its density per solid angle.
    pub fn sample(&self, u: f32, v: f32) -> Option<(Vec3, f32)> {
        let (row, row_share, v) = choose(&self.rows, &self.row_guide, v);
        let guide = &self.pixel_guide[row * self.width..(row + 1) * self.width];
        let (column, share, u) = choose(self.row(row), guide, u);
        let y = self.edges[row] + (self.edges[row + 1] - self.edges[row]) * v;
        let pdf = self.density(row, row_share * share);
        let direction = direction_at((column as f32 + u) / self.width as f32, y);
        (pdf > 0.0).then_some((direction, pdf))
    }

    /// The density per solid angle with which [`EnvironmentTable::sample`] finds `direction`.
    pub fn pdf(&self, direction: Vec3) -> f32 {
        let [u, v] = uv_of(direction);
        let row = ((v * self.height as f32) as usize).min(self.height - 1);
        let column = ((u * self.width as f32) as usize).min(self.width - 1);
        let cumulated = self.row(row);
        let share = cumulated[column + 1] - cumulated[column];
        self.density(row, (self.rows[row + 1] - self.rows[row]) * share)
    }

    fn row(&self, row: usize) -> &[f32] {
        &self.pixels[row * (self.width + 1)..(row + 1) * (self.width + 1)]
    }

    fn density(&self, row: usize, share: f32) -> f32 {
        share * self.pixels_per_steradian[row]
    }
}

/// What the bilinear picture holds over a pixel: its own value by 6/8, its neighbours' by 1/8, in both
/// directions.
fn pixel_weight(picture: &LatLong, x: isize, y: isize) -> f64 {
    let row = |y| {
        let at = |x| f64::from(picture.pixel(x, y).element_sum());
        0.125 * (at(x - 1) + at(x + 1)) + 0.75 * at(x)
    };
    0.125 * (row(y - 1) + row(y + 1)) + 0.75 * row(y)
}

/// Appends the cumulated shares of `weights`, from 0 to 1; returns their sum.
fn push_cumulated(to: &mut Vec<f32>, weights: impl ExactSizeIterator<Item = f64>) -> f64 {
    let start = to.len();
    let count = weights.len();
    let mut sum = 0.0;
    let sums: Vec<f64> = std::iter::once(0.0)
        .chain(weights.map(|weight| {
            sum += weight;
            sum
        }))
        .collect();
    // A black row is never chosen; any rising shares keep the search in range.
    to.extend(
        sums.iter()
            .enumerate()
            .map(|(i, s)| (if sum > 0.0 { s / sum } else { i as f64 / count as f64 }) as f32),
    );
    to[start + count] = 1.0;
    sum
}

/// For n equal parts of 0..1, the interval of cumulated shares that each begins in: the search for a
/// number that starts there ends after about one step (Chen and Asau 1974).
fn guide(cumulated: &[f32]) -> impl Iterator<Item = u32> + '_ {
    let parts = cumulated.len() - 1;
    let mut interval = 0;
    (0..parts).map(move |part| {
        let begins = part as f32 / parts as f32;
        while interval + 1 < parts && cumulated[interval + 1] <= begins {
            interval += 1;
        }
        interval as u32
    })
}

/// The interval of cumulated shares that `u` falls into, its share, and how far into it `u` lies (0..1).
fn choose(cumulated: &[f32], guide: &[u32], u: f32) -> (usize, f32, f32) {
    let last = guide.len() - 1;
    let mut interval = guide[((u * guide.len() as f32) as usize).min(last)] as usize;
    // Rounding may have put `u` into the part after its own.
    while interval > 0 && cumulated[interval] > u {
        interval -= 1;
    }
    while interval < last && cumulated[interval + 1] <= u {
        interval += 1;
    }
    let (low, share) = (cumulated[interval], cumulated[interval + 1] - cumulated[interval]);
    // Below 1, so that a direction never slips into the next pixel.
    let inside = if share > 0.0 { ((u - low) / share).clamp(0.0, 0.999_999) } else { 0.5 };
    (interval, share, inside)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Environment;

    fn picture() -> Environment {
        let pixel = |i: usize| {
            let value = ((i * 2_654_435_761) >> 7) % 97;
            Vec3::new(value as f32, 1.0, 0.5) * if i == 45 { 500.0 } else { 1.0 }
        };
        Environment::from_pixels(16, 8, (0..128).map(pixel).collect()).unwrap()
    }

    /// A direction uniform over the sphere.
    fn uniform(i: usize, n: usize) -> Vec3 {
        let y = 1.0 - 2.0 * (i as f32 + 0.5) / n as f32;
        direction_at((i as f32 * 0.618_034).fract(), y)
    }

    #[test]
    fn the_density_integrates_to_one_and_samples_follow_it() {
        let environment = picture();
        let table = EnvironmentTable::new(environment.picture().unwrap()).unwrap();
        let n = 400_000;
        let integral: f64 =
            (0..n).map(|i| f64::from(table.pdf(uniform(i, n)))).sum::<f64>() / n as f64 * 4.0 * f64::from(PI);
        assert!((integral - 1.0).abs() < 2e-3, "{integral}");
        for i in 0..5000 {
            let (u, v) = ((i as f32 + 0.5) / 5000.0, (i as f32 * 0.618_034).fract());
            let (direction, pdf) = table.sample(u, v).unwrap();
            assert!((direction.length() - 1.0).abs() < 1e-5);
            let again = table.pdf(direction);
            assert!((pdf / again - 1.0).abs() < 1e-4, "{direction} {pdf} {again}");
        }
    }

    #[test]
    fn the_guide_finds_what_a_search_finds() {
        let environment = picture();
        let table = EnvironmentTable::new(environment.picture().unwrap()).unwrap();
        for i in 0..100_000 {
            let u = (i as f32 * 0.618_034).fract();
            for (cumulated, guide) in
                [(&table.rows[..], &table.row_guide[..]), (table.row(2), &table.pixel_guide[32..48])]
            {
                let searched = cumulated.partition_point(|&c| c <= u).clamp(1, cumulated.len() - 1) - 1;
                assert_eq!(choose(cumulated, guide, u).0, searched, "{u}");
            }
        }
    }

    #[test]
    fn light_over_density_is_nearly_constant_in_the_mean() {
        let environment = picture();
        let table = EnvironmentTable::new(environment.picture().unwrap()).unwrap();
        let n = 40_000;
        let mut sum = 0.0f64;
        for i in 0..n {
            let (u, v) = ((i as f32 + 0.5) / n as f32, (i as f32 * 0.618_034).fract());
            let (direction, pdf) = table.sample(u, v).unwrap();
            sum += f64::from(environment.radiance(direction).element_sum() / pdf);
        }
        let exact = f64::from(3.0 * environment.mean()) * 4.0 * f64::from(PI);
        assert!((sum / n as f64 / exact - 1.0).abs() < 0.02, "{} {exact}", sum / n as f64);
    }

    #[test]
    fn wherever_there_is_light_there_is_density() {
        let mut pixels = vec![Vec3::ZERO; 128];
        pixels[0] = Vec3::ONE;
        let environment = Environment::from_pixels(16, 8, pixels).unwrap();
        let table = EnvironmentTable::new(environment.picture().unwrap()).unwrap();
        for i in 0..20_000 {
            let direction = uniform(i, 20_000);
            assert!(environment.radiance(direction) == Vec3::ZERO || table.pdf(direction) > 0.0);
        }
        let black = Environment::from_pixels(2, 1, vec![Vec3::ZERO; 2]).unwrap();
        assert!(EnvironmentTable::new(black.picture().unwrap()).is_none());
    }
}
