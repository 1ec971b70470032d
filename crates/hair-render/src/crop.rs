//! A part of a picture instead of the whole.

use crate::RenderError;

/// The part of the picture to render, as shares of its width and height from the upper left corner: those
/// pixels that begin in it (as pbrt's `--cropwindow`), so that crops that share an edge share no pixel and leave
/// none out. Each has the bits it has in the whole picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crop {
    /// Left edge, 0..1.
    pub x0: f64,
    /// Right edge, above `x0`, at most 1.
    pub x1: f64,
    /// Upper edge, 0..1.
    pub y0: f64,
    /// Lower edge, above `y0`, at most 1.
    pub y1: f64,
}

/// Where a cropped picture lies in the whole one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cutout {
    /// Pixels of the whole picture left of it.
    pub x: u32,
    /// Pixels of the whole picture above it.
    pub y: u32,
    /// Pixels across the whole picture.
    pub full_width: u32,
    /// Pixels down the whole picture.
    pub full_height: u32,
}

/// The pixels that are rendered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Window {
    pub x: u32,
    pub y: u32,
    pub width: u32,
    pub height: u32,
}

impl Window {
    /// How many pixels it has.
    pub fn count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Where it lies in a picture of that size; `None` where it is all of it.
    pub fn cutout(&self, full_width: u32, full_height: u32) -> Option<Cutout> {
        let whole = Window { x: 0, y: 0, width: full_width, height: full_height };
        (*self != whole).then_some(Cutout { x: self.x, y: self.y, full_width, full_height })
    }
}

impl Crop {
    /// The pixels of a picture of `width` x `height` that begin in the crop.
    pub(crate) fn window(&self, width: u32, height: u32) -> Result<Window, RenderError> {
        let (x, across) = pixels("crop (x0,x1)", self.x0, self.x1, width)?;
        let (y, down) = pixels("crop (y0,y1)", self.y0, self.y1, height)?;
        Ok(Window { x, y, width: across, height: down })
    }
}

fn pixels(what: &'static str, from: f64, to: f64, count: u32) -> Result<(u32, u32), RenderError> {
    if !(0.0 <= from && from < to && to <= 1.0) {
        let expected = "two shares of the picture in 0..1, the first below the second";
        return Err(RenderError::argument(what, format!("{from},{to}"), expected));
    }
    let edge = |share: f64| (share * f64::from(count)).ceil() as u32;
    let (first, end) = (edge(from), edge(to));
    if first >= end {
        let found = format!("{from},{to} of {count} pixels");
        return Err(RenderError::argument(what, found, "wide enough to have a pixel begin in it"));
    }
    Ok((first, end - first))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn shares_out_of_range_and_empty_crops_are_refused() {
        let crop = |x0, x1| Crop { x0, x1, y0: 0.0, y1: 1.0 }.window(10, 10);
        for (x0, x1) in [(-0.1, 0.5), (0.5, 0.5), (0.6, 0.5), (0.0, 1.1), (f64::NAN, 1.0), (0.01, 0.09)] {
            assert!(matches!(crop(x0, x1), Err(RenderError::Argument { .. })), "{x0} {x1}");
        }
        let whole = crop(0.0, 1.0).unwrap();
        assert_eq!(whole, Window { x: 0, y: 0, width: 10, height: 10 });
        assert_eq!((whole.cutout(10, 10), whole.count()), (None, 100));
        assert!(crop(0.0, 0.5).unwrap().cutout(10, 10).is_some());
    }

    proptest! {
        /// Cuts at any places divide the picture: every pixel is in one part and in one only.
        #[test]
        fn crops_that_share_an_edge_share_no_pixel(width in 1u32..5000, cut in 0.0f64..1.0) {
            let part = |from, to| pixels("", from, to, width).map_or((0, 0), |(first, count)| (first, count));
            let (left, right) = (part(0.0, cut), part(cut, 1.0));
            prop_assert_eq!(left.1 + right.1, width);
            prop_assert!(right.1 == 0 || right.0 == left.1);
        }
    }
}
