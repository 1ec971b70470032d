//! From counts of walks to a density with less noise.

use crate::fur::grid::{ALONG, AROUND, CELLS, matt};

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
    let matt = matt();
    let counted = halves.clone();
    let mut error = prediction_error(&halves, &counted, &matt);
    let (mut around, mut along) = (STRIDES_AROUND.as_slice(), STRIDES_ALONG.as_slice());
    loop {
        let tried = [
            around.first().map(|&stride| halves.each_ref().map(|half| smoothed_around(half, stride))),
            along.first().map(|&stride| halves.each_ref().map(|half| smoothed_along(half, stride, &matt))),
        ];
        let errors = tried.each_ref().map(|tried| {
            tried.as_ref().map_or(f64::INFINITY, |halves| prediction_error(halves, &counted, &matt))
        });
        if errors[0].min(errors[1]) >= error {
            break;
        }
        let better = usize::from(errors[1] < errors[0]);
        let [in_turn, in_line] = tried;
        let (next, strides) = if better == 0 { (in_turn, &mut around) } else { (in_line, &mut along) };
        let Some(next) = next else { break };
        (halves, error) = (next, errors[better]);
        *strides = strides.get(1..).unwrap_or_default();
    }
    let [mut sum, other] = halves;
    for (mass, other) in sum.iter_mut().zip(other) {
        *mass += other;
    }
    sum
}

/// How far apart the entries are that one pass after the other brings together. Past the last the
/// density is as broad as the fibre.
const STRIDES_AROUND: [usize; 10] = [1, 1, 1, 2, 2, 4, 4, 8, 8, 12];
const STRIDES_ALONG: [usize; 7] = [1, 1, 1, 2, 2, 4, 4];

/// How far each smoothed half is from the other as counted: the square of the smoothed one's error, but for
/// a constant.
fn prediction_error(smoothed: &[Density; 2], counted: &[Density; 2], matt: &[f64; ALONG]) -> f64 {
    let mut sum = 0.0;
    for half in 0..2 {
        let lines = smoothed[half].chunks(AROUND).zip(counted[1 - half].chunks(AROUND));
        for ((smoothed, counted), matt) in lines.zip(matt) {
            let squares = smoothed.iter().zip(counted).map(|(a, b)| f64::from((a - b) * (a - b)));
            sum += squares.sum::<f64>() / matt;
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

/// Each entry gives a quarter to two others around the fibre.
fn smoothed_around(masses: &Density, stride: usize) -> Density {
    let mut result = Vec::with_capacity(CELLS);
    for line in masses.chunks(AROUND) {
        result.extend((0..AROUND).map(|turn| {
            let others = line[(turn + stride) % AROUND] + line[(turn + AROUND - stride) % AROUND];
            0.5 * line[turn] + 0.25 * others
        }));
    }
    result
}

/// Entries along the fibre even out up to a quarter of their difference from a matt surface's; nothing
/// is lost at the ends, and what light grazes the fibre stays as little as it is.
fn smoothed_along(masses: &Density, stride: usize, matt: &[f64; ALONG]) -> Density {
    let mut result = masses.clone();
    let ahead = stride * AROUND;
    for cell in 0..CELLS - ahead {
        let [here, there] = [cell, cell + ahead].map(|cell| matt[cell / AROUND] as f32);
        let flow = 0.25 * here.min(there) * (masses[cell + ahead] / there - masses[cell] / here);
        result[cell] += flow;
        result[cell + ahead] -= flow;
    }
    result
}
