//! From counts of walks to a density with less noise.

use crate::medulla_grid::{ALONG, AROUND, CELLS, width_along};

/// Mass of each entry, lines along the fibre one after the other.
pub(crate) type Density = Vec<f32>;

/// Counts of `cells`, smoothed as much as makes one half of the walks foretell the other best. `symmetric`
/// says that the ray is its own mirror image around the fibre, along it.
pub(crate) fn smoothed(cells: impl Iterator<Item = usize>, symmetric: [bool; 2]) -> Density {
    let mut halves = [vec![0.0; CELLS], vec![0.0; CELLS]];
    for (walk, cell) in cells.enumerate() {
        halves[walk % 2][cell] += 1.0;
    }
    let mut halves = halves.map(|half| mirrored(half, symmetric));
    let counted = halves.clone();
    let mut error = prediction_error(&halves, &counted);
    for _ in 0..MOST_PASSES {
        let around = halves.each_ref().map(smoothed_around);
        let along = halves.each_ref().map(smoothed_along);
        let (error_around, error_along) =
            (prediction_error(&around, &counted), prediction_error(&along, &counted));
        if error_around.min(error_along) >= error {
            break;
        }
        (halves, error) =
            if error_around <= error_along { (around, error_around) } else { (along, error_along) };
    }
    let [mut sum, other] = halves;
    for (mass, other) in sum.iter_mut().zip(other) {
        *mass += other;
    }
    sum
}

/// Past this many passes the density is as broad as the fibre.
const MOST_PASSES: usize = 200;

/// How far each smoothed half is from the other as counted: the square of the smoothed one's error, but for
/// a constant.
fn prediction_error(smoothed: &[Density; 2], counted: &[Density; 2]) -> f64 {
    let mut sum = 0.0;
    for half in 0..2 {
        for (cell, (a, b)) in smoothed[half].iter().zip(&counted[1 - half]).enumerate() {
            let difference = f64::from(a - b) / width_along(cell / AROUND);
            sum += difference * difference * width_along(cell / AROUND);
        }
    }
    sum
}

fn mirrored(counts: Density, [around, along]: [bool; 2]) -> Density {
    let mirror = |counts: &Density, image: &dyn Fn(usize, usize) -> usize| -> Density {
        (0..CELLS).map(|cell| counts[cell] + counts[image(cell / AROUND, cell % AROUND)]).collect()
    };
    let mut counts = counts;
    if around {
        counts = mirror(&counts, &|line, turn| line * AROUND + (AROUND - turn) % AROUND);
    }
    if along {
        counts = mirror(&counts, &|line, turn| (ALONG - 1 - line) * AROUND + turn);
    }
    counts
}

/// Each entry gives a quarter to both neighbours around the fibre.
fn smoothed_around(masses: &Density) -> Density {
    (0..CELLS)
        .map(|cell| {
            let (line, turn) = (cell / AROUND * AROUND, cell % AROUND);
            let neighbours = masses[line + (turn + 1) % AROUND] + masses[line + (turn + AROUND - 1) % AROUND];
            0.5 * masses[cell] + 0.25 * neighbours
        })
        .collect()
}

/// Neighbours along the fibre even out a quarter of their difference; nothing is lost at the ends.
fn smoothed_along(masses: &Density) -> Density {
    let mut result = masses.clone();
    for cell in 0..CELLS - AROUND {
        let next = cell + AROUND;
        let [here, there] = [cell, next].map(|cell| masses[cell] / width_along(cell / AROUND) as f32);
        let flow = 0.25 * (there - here);
        result[cell] += flow;
        result[next] -= flow;
    }
    result
}
