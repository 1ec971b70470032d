//! Pictures of any size brought to a frame's.

use glam::Vec3;

/// How a picture of another shape is brought into a frame.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Fit {
    /// As large as needed to leave no gap; what stands out is cut, alike on both sides.
    #[default]
    Fill,
    /// As large as can be seen whole; black beside it.
    Whole,
    /// Pulled to the frame's shape.
    Stretch,
}

impl Fit {
    /// The fit of that name: `fill`, `whole` or `stretch`.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Fit> {
        match name {
            "fill" => Some(Fit::Fill),
            "whole" => Some(Fit::Whole),
            "stretch" => Some(Fit::Stretch),
            _ => None,
        }
    }
}

/// What a fit did.
#[derive(Clone, Debug, PartialEq)]
pub struct Fitted {
    /// Pixels of the frame, or of the part of it that was asked for.
    pub pixels: Vec<Vec3>,
    /// Factor on its width and height.
    pub scale: (f64, f64),
    /// Share of the picture that is not seen, 0..1.
    pub cut: f64,
    /// Share of the frame that it does not reach, 0..1.
    pub bare: f64,
}

/// Brings a picture of `from` pixels to `to` pixels: every pixel is the mean of the area it covers, or, where it is
/// made larger, blended between its neighbours.
pub(crate) fn fitted(pixels: &[Vec3], from: (usize, usize), to: (usize, usize), fit: Fit) -> Fitted {
    let whole = |axis: fn((usize, usize)) -> usize| axis(to) as f64 / axis(from).max(1) as f64;
    let (across, down) = (whole(|size| size.0), whole(|size| size.1));
    let scale = match fit {
        Fit::Fill => (across.max(down), across.max(down)),
        Fit::Whole => (across.min(down), across.min(down)),
        Fit::Stretch => (across, down),
    };
    let columns = taps(from.0, to.0, scale.0);
    let rows = taps(from.1, to.1, scale.1);
    let mut out = Vec::with_capacity(to.0 * to.1);
    // Rows first, once for each row of the picture that is seen.
    let mut narrow: Vec<Option<Vec<Vec3>>> = vec![None; from.1];
    for row in &rows {
        let mut line = vec![Vec3::ZERO; to.0];
        for &(y, weight) in row {
            let Some(slot) = narrow.get_mut(y) else { continue };
            let source = slot.get_or_insert_with(|| {
                let at = |x: usize| pixels.get(y * from.0 + x).copied().unwrap_or(Vec3::ZERO);
                columns.iter().map(|taps| taps.iter().map(|&(x, weight)| at(x) * weight).sum()).collect()
            });
            line.iter_mut().zip(source).for_each(|(sum, value)| *sum += *value * weight);
        }
        out.extend(line);
    }
    let seen = |from: usize, to: usize, scale: f64| (to as f64 / (from as f64 * scale)).min(1.0);
    let reached = |from: usize, to: usize, scale: f64| (from as f64 * scale / to as f64).min(1.0);
    let both =
        |share: fn(usize, usize, f64) -> f64| share(from.0, to.0, scale.0) * share(from.1, to.1, scale.1);
    Fitted { pixels: out, scale, cut: none_of(1.0 - both(seen)), bare: none_of(1.0 - both(reached)) }
}

/// What rounding leaves is nothing.
fn none_of(share: f64) -> f64 {
    if share < 1e-9 { 0.0 } else { share }
}

/// For every pixel of an axis of `to` pixels: those of `from` it is made of, with their weights.
fn taps(from: usize, to: usize, scale: f64) -> Vec<Vec<(usize, f32)>> {
    let begin = (to as f64 - from as f64 * scale) / 2.0;
    let last = from as f64;
    let of = |pixel: usize| {
        let (low, high) = ((pixel as f64 - begin) / scale, (pixel as f64 + 1.0 - begin) / scale);
        if scale >= 1.0 {
            let middle = (low + high) / 2.0;
            if middle < 0.0 || middle > last {
                return Vec::new();
            }
            let at = (middle - 0.5).clamp(0.0, last - 1.0);
            let (first, share) = (at.floor() as usize, at.fract() as f32);
            return vec![(first, 1.0 - share), ((first + 1).min(from - 1), share)];
        }
        // Half a pixel at the edge of the frame may stick out of the picture.
        let (low, high) = (low.max(0.0), high.min(last));
        let cells = low.floor() as usize..(high.ceil() as usize).min(from);
        let part = |cell: usize| high.min(cell as f64 + 1.0) - low.max(cell as f64);
        let whole = 1.0 / scale;
        cells.map(|cell| (cell, (part(cell) / whole) as f32)).filter(|&(_, weight)| weight > 0.0).collect()
    };
    if from == 0 { vec![Vec::new(); to] } else { (0..to).map(of).collect() }
}
