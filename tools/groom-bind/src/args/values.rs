//! Values on the command line: what they may be, and what is said when they are not.

use command_line::numbers;
use glam::{DMat4, DVec3};

/// More frames than anybody means.
const MOST_FRAMES: f64 = 1e6;

/// First and last frame, and how far it is from one to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FrameRange {
    pub(crate) first: i64,
    pub(crate) last: i64,
    pub(crate) step: f64,
}

impl FrameRange {
    /// The frames, each worked out from the first: no sum of roundings.
    pub(crate) fn frames(self) -> impl ExactSizeIterator<Item = f64> {
        let steps = ((self.last - self.first) as f64 / self.step + 1e-9).floor() as usize;
        (0..steps + 1).map(move |i| self.first as f64 + i as f64 * self.step)
    }
}

fn number(text: &str) -> Option<f64> {
    text.trim().parse().ok().filter(|v: &f64| v.is_finite())
}

pub(super) fn over_zero(text: &str) -> Result<f64, String> {
    number(text).filter(|&v| v > 0.0).ok_or("expected a number over 0".into())
}

pub(super) fn distance(text: &str) -> Result<f64, String> {
    number(text).filter(|&v| v >= 0.0).ok_or("expected a number, 0 or more".into())
}

pub(super) fn vector(text: &str) -> Result<DVec3, String> {
    numbers(text).map(DVec3::from_array).ok_or("expected three numbers, as 0,1.5,-2".into())
}

pub(super) fn matrix(text: &str) -> Result<DMat4, String> {
    let rows: Option<[f64; 16]> = numbers(text);
    let expected = "expected 16 numbers, row by row, as 1,0,0,5,0,1,0,0,0,0,1,0,0,0,0,1 (moves by 5 along x)";
    rows.map(|rows| DMat4::from_cols_array(&rows).transpose()).ok_or(expected.into())
}

pub(super) fn shutter(text: &str) -> Result<[f64; 2], String> {
    let parts = || {
        let (open, close) = text.split_once(':')?;
        let (open, close) = (number(open)?, number(close)?);
        let sound = open < close && close - open <= 1.0 && open.abs() <= 1.0 && close.abs() <= 1.0;
        sound.then_some([open, close])
    };
    parts().ok_or(
        "expected when it opens and closes, from -1 to 1 frame and at most 1 long, as -0.25:0.25".into(),
    )
}

pub(super) fn frames(text: &str) -> Result<FrameRange, String> {
    let parts = || {
        let (range, step) = text.split_once(':').map_or((text, Some(1.0)), |(r, s)| (r, number(s)));
        let step = step.filter(|&step| step > 0.0)?;
        // A minus sign at the start, or after the dash, belongs to its number.
        let dash = range.get(1..)?.find('-').map(|at| at + 1);
        let (first, last) = dash.map_or((range, range), |at| (&range[..at], &range[at + 1..]));
        let (first, last) = (first.trim().parse().ok()?, last.trim().parse().ok()?);
        let is_sound = first <= last && (last as f64 - first as f64) / step < MOST_FRAMES;
        is_sound.then_some(FrameRange { first, last, step })
    };
    parts().ok_or(
        "expected first-last or first-last:step (a million frames at most), as 1-48, -10-20:2 or 5".into(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_ranges() {
        let read = |text| frames(text).map(|r| (r.first, r.last, r.step));
        assert_eq!(read("1-48"), Ok((1, 48, 1.0)));
        assert_eq!(read("-10--2:2"), Ok((-10, -2, 2.0)));
        assert_eq!(read("-3-5"), Ok((-3, 5, 1.0)));
        assert_eq!(read("-7"), Ok((-7, -7, 1.0)));
        assert_eq!(read("0-1:0.25"), Ok((0, 1, 0.25)));
        for text in ["", "-", "5-1", "a-b", "1-", "1-2:0", "1-2:-1", "1-2:x", "1.5-2", "0-9:1e-9", "ä-1"] {
            assert!(frames(text).is_err(), "{text}");
        }
        assert_eq!(frames("0-1:0.1").unwrap().frames().last(), Some(1.0));
        assert_eq!(frames("0-5:2").unwrap().frames().collect::<Vec<_>>(), [0.0, 2.0, 4.0]);
    }

    #[test]
    fn matrices_are_rows_for_column_vectors() {
        let moved = matrix("1,0,0,5, 0,1,0,6, 0,0,1,7, 0,0,0,1").unwrap();
        assert_eq!(moved, DMat4::from_translation(DVec3::new(5.0, 6.0, 7.0)));
        assert!(matrix("1,2").is_err() && vector("1,2,x").is_err());
    }

    #[test]
    fn values_out_of_range_are_refused() {
        assert_eq!(shutter("-0.25:0.25"), Ok([-0.25, 0.25]));
        for text in ["", "0", "0.5:0", "0:0", "-1:1", "0:nan", "0:2"] {
            assert!(shutter(text).is_err(), "{text}");
        }
        assert!(
            distance("-1").is_err()
                && distance("0").is_ok()
                && over_zero("0").is_err()
                && over_zero("inf").is_err()
        );
    }
}
