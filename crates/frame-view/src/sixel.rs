//! Sixels: six rows of pixels a line, one colour after the other.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use crate::Picture;
use crate::graphics::seen;

/// Steps of red, green and blue: 216 colours, which every terminal has room for.
const STEPS: u32 = 6;

/// An ordered pattern that hides the steps (Bayer 1973), 0..16.
const PATTERN: [[u32; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// The picture in about `cells` characters.
pub(crate) fn drawn(picture: &Picture, cells: (u32, u32)) -> Vec<u8> {
    let picture = seen(picture, cells);
    let (width, height) = picture.size();
    let mut out = format!("\x1bPq\"1;1;{width};{height}");
    for color in 0..STEPS.pow(3) {
        let percent = |step: u32| step * 100 / (STEPS - 1);
        let (r, g, b) = (color / 36, color / 6 % 6, color % 6);
        let _ = write!(out, "#{color};2;{};{};{}", percent(r), percent(g), percent(b));
    }
    for (band, rows) in picture.pixels().chunks(6 * width.max(1) as usize).enumerate() {
        // For every colour the columns where it stands, with a bit for each of the six rows.
        let mut colors: BTreeMap<u32, Vec<u8>> = BTreeMap::new();
        for (index, pixel) in rows.iter().enumerate() {
            let (x, row) = (index % width as usize, index / width as usize);
            let threshold = PATTERN[(band * 6 + row) % 4][x % 4];
            let step = |value: u8| (u32::from(value) * (STEPS - 1) * 16 + threshold * 255) / (255 * 16);
            let [r, g, b] = pixel.map(|value| step(value).min(STEPS - 1));
            let columns = colors.entry(r * 36 + g * 6 + b).or_insert_with(|| vec![0; width as usize]);
            columns[x] |= 1 << row;
        }
        for (color, columns) in colors {
            let _ = write!(out, "#{color}");
            for run in columns.chunk_by(|a, b| a == b) {
                let letter = char::from(63 + run[0]);
                if run.len() > 3 {
                    let _ = write!(out, "!{}{letter}", run.len());
                } else {
                    out.extend(std::iter::repeat_n(letter, run.len()));
                }
            }
            out.push('$');
        }
        out.push('-');
    }
    out.push_str("\x1b\\\n");
    out.into_bytes()
}
