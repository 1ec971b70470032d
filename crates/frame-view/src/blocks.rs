//! Two pixels a character: the upper half block, its colour and what is behind it.

use std::fmt::Write as _;

use crate::Picture;

/// `picture`, a character for every two of its pixels one above the other.
pub(crate) fn drawn(picture: &Picture) -> String {
    let (width, _) = picture.size();
    let mut out = String::new();
    let rows: Vec<&[[u8; 3]]> = picture.pixels().chunks(width.max(1) as usize).collect();
    for pair in rows.chunks(2) {
        let (mut front, mut back) = (None, None);
        for (x, &upper) in pair.first().copied().unwrap_or_default().iter().enumerate() {
            if front != Some(upper) {
                let [r, g, b] = upper;
                let _ = write!(out, "\x1b[38;2;{r};{g};{b}m");
                front = Some(upper);
            }
            // The last row of an odd number has nothing below it.
            let lower = pair.get(1).and_then(|row| row.get(x)).copied();
            if back != lower
                && let Some([r, g, b]) = lower
            {
                let _ = write!(out, "\x1b[48;2;{r};{g};{b}m");
                back = lower;
            }
            out.push('\u{2580}');
        }
        out.push_str("\x1b[0m\n");
    }
    out
}
