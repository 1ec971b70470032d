//! Pictures of one size side by side in one.

use crate::caption::{Caption, unknown_in};
use crate::{Preview, digits};

/// How the cells of a contact sheet stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SheetLayout {
    /// Width and height of each cell in pixels.
    pub cell: (u32, u32),
    /// Cells side by side; as many as make the sheet about square when `None`.
    pub columns: Option<u32>,
    /// Pixels between cells and around them.
    pub gap: u32,
    /// Whether each cell carries its number, from 1, in its upper left corner (large enough cells only).
    pub labels: bool,
    /// Lines of words on a dark strip under each cell, 0 for none; see [`ContactSheet::caption`].
    pub caption_lines: u32,
}

impl SheetLayout {
    /// Width and height in pixels of a sheet of `count` cells.
    #[must_use]
    pub fn size(&self, count: u32) -> (u64, u64) {
        let columns = u64::from(self.columns_of(count));
        let rows = u64::from(count).div_ceil(columns).max(1);
        let side = |cells: u64, cell: u32| {
            u64::from(self.gap) + cells * u64::from(cell.max(1).saturating_add(self.gap))
        };
        (side(columns, self.cell.0), side(rows, self.cell.1.saturating_add(self.strip())))
    }

    /// Rows of pixels that the words under a cell take.
    fn strip(&self) -> u32 {
        Caption::for_width(self.cell.0).height(self.caption_lines)
    }

    fn columns_of(&self, count: u32) -> u32 {
        let (width, height) = (self.cell.0, self.cell.1.saturating_add(self.strip()));
        self.columns
            .unwrap_or_else(|| about_square(count, width.max(1), height.max(1)))
            .clamp(1, count.max(1))
    }
}

/// A contact sheet of previews of one size, filled row by row, numbered from 1.
#[derive(Clone, Debug)]
pub struct ContactSheet {
    picture: Preview,
    columns: u32,
    layout: SheetLayout,
}

impl ContactSheet {
    /// An empty sheet for `count` cells; the sRGB colour `background` shows in the gaps.
    ///
    /// `None` for a sheet of more pixels than 32 bits count.
    #[must_use]
    pub fn new(layout: SheetLayout, count: u32, background: [u8; 3]) -> Option<Self> {
        let (width, height) = layout.size(count);
        let pixels = width.checked_mul(height).filter(|&pixels| pixels <= u64::from(u32::MAX))?;
        let [r, g, b] = background;
        let rgba = [r, g, b, 255].repeat(usize::try_from(pixels).ok()?);
        let picture =
            Preview { width: u32::try_from(width).ok()?, height: u32::try_from(height).ok()?, rgba };
        Some(ContactSheet { picture, columns: layout.columns_of(count), layout })
    }

    /// Puts cell `number` (from 1) in its place. What lies outside the sheet is left out.
    pub fn place(&mut self, number: u32, cell: &Preview) {
        self.place_labelled(number, number, cell);
    }

    /// As [`ContactSheet::place`], with another number in its corner, such as a frame's.
    pub fn place_labelled(&mut self, number: u32, label: u32, cell: &Preview) {
        let Some((left, top)) = self.corner(number) else { return };
        self.put((left, top), cell);
        if self.layout.labels {
            self.label(label, left, top);
        }
    }

    /// Writes one line of words after the other under cell `number` (from 1), white on a dark strip, in
    /// letters sized to the cell. A line that is too long is shortened and ends in dots; lines beyond
    /// [`SheetLayout::caption_lines`] are left out. Letters outside of Latin-1 show as `?`; the first of them comes
    /// back.
    pub fn caption(&mut self, number: u32, lines: &[&str]) -> Option<char> {
        let SheetLayout { cell: (width, height), caption_lines, .. } = self.layout;
        let (left, top) = self.corner(number)?;
        let top = top.checked_add(height).filter(|_| caption_lines > 0)?;
        let mut kept = lines.iter().take(caption_lines as usize).copied();
        self.put((left, top), &Caption::for_width(width).drawn(width, caption_lines, kept.clone()));
        kept.find_map(unknown_in)
    }

    /// Copies a picture to where its upper left corner is to be.
    fn put(&mut self, (left, top): (u32, u32), picture: &Preview) {
        let row_bytes = picture.width as usize * 4;
        for (y, row) in picture.rgba.chunks_exact(row_bytes.max(1)).enumerate() {
            let start = ((top as usize + y) * self.picture.width as usize + left as usize) * 4;
            if let Some(to) = self.picture.rgba.get_mut(start..start + row_bytes) {
                to.copy_from_slice(row);
            }
        }
    }

    /// The upper left corner of a cell; `None` beyond what 32 bits count.
    fn corner(&self, number: u32) -> Option<(u32, u32)> {
        let SheetLayout { cell: (width, height), gap, .. } = self.layout;
        let index = number.saturating_sub(1);
        let step = |size: u32, cells: u32| {
            let pitch = u64::from(size) + u64::from(gap);
            u32::try_from(u64::from(gap) + u64::from(cells) * pitch).ok()
        };
        let down = height.checked_add(self.layout.strip())?;
        Some((step(width, index % self.columns)?, step(down, index / self.columns)?))
    }

    /// The number in the upper left corner of its frame, sized to it; small frames have none.
    fn label(&mut self, number: u32, left: u32, top: u32) {
        let dot = self.layout.cell.0.min(self.layout.cell.1) / 110;
        let (x0, y0) = (left + 3 * dot, top + 3 * dot);
        for (x, y) in digits::dots(number) {
            for dy in 0..dot {
                for dx in 0..dot {
                    self.dim(x0 + x * dot + dx, y0 + y * dot + dy);
                }
            }
        }
    }

    /// Moves a pixel halfway to white, or to black where it is bright.
    fn dim(&mut self, x: u32, y: u32) {
        let at = (y as usize * self.picture.width as usize + x as usize) * 4;
        let Some(pixel) = self.picture.rgba.get_mut(at..at + 3) else { return };
        let bright = pixel.iter().map(|&v| u32::from(v)).sum::<u32>() > 3 * 128;
        for value in pixel {
            *value = if bright { *value / 2 } else { 128 + *value / 2 };
        }
    }

    /// The finished sheet.
    #[must_use]
    pub fn finish(self) -> Preview {
        self.picture
    }
}

/// How many columns bring the sheet nearest to a square.
fn about_square(count: u32, width: u32, height: u32) -> u32 {
    let off = |columns: u32| {
        let across = f64::from(columns) * f64::from(width);
        let down = f64::from(count.div_ceil(columns)) * f64::from(height);
        // Empty places in the last row count more; of two shapes as good, the wider one is taken.
        let empty = columns * count.div_ceil(columns) - count;
        (across / down).ln().abs() + 0.8 * f64::from(empty)
    };
    (1..=count.max(1)).rev().min_by(|&a, &b| off(a).total_cmp(&off(b))).unwrap_or(1)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout(cell: (u32, u32), columns: u32, gap: u32, labels: bool) -> SheetLayout {
        SheetLayout { cell, columns: Some(columns), gap, labels, caption_lines: 0 }
    }

    #[test]
    fn frames_stand_in_rows() {
        let mut sheet = ContactSheet::new(layout((4, 2), 2, 1, false), 3, [9, 9, 9]).unwrap();
        for number in 1..=3 {
            sheet.place(number, &Preview { width: 4, height: 2, rgba: vec![number as u8 * 50; 32] });
        }
        let picture = sheet.finish();
        assert_eq!((picture.width, picture.height), (11, 7));
        let at = |x: usize, y: usize| picture.rgba[(y * 11 + x) * 4];
        assert_eq!(
            [at(0, 0), at(1, 1), at(5, 1), at(6, 2), at(1, 4), at(4, 5), at(6, 4)],
            [9, 50, 9, 100, 150, 150, 9]
        );
    }

    #[test]
    fn sheets_are_about_square() {
        assert_eq!(about_square(12, 100, 100), 4);
        assert_eq!(about_square(8, 100, 100), 4);
        assert_eq!(about_square(8, 50, 100), 4);
        assert_eq!(about_square(1, 100, 100), 1);
        let free = SheetLayout { cell: (100, 100), columns: None, gap: 2, labels: false, caption_lines: 0 };
        assert_eq!(free.size(12), (4 * 102 + 2, 3 * 102 + 2));
    }

    #[test]
    fn no_sheet_is_too_large_or_too_small_to_refuse() {
        assert!(ContactSheet::new(layout((u32::MAX, u32::MAX), 9, u32::MAX, true), 81, [0; 3]).is_none());
        let mut empty = ContactSheet::new(layout((0, 0), 1, 0, true), 0, [0; 3]).unwrap();
        empty.place(0, &Preview { width: 3, height: 3, rgba: vec![0; 36] });
        empty.place(u32::MAX, &Preview { width: 0, height: 0, rgba: Vec::new() });
    }

    #[test]
    fn words_stand_under_their_cell_and_nowhere_else() {
        let captioned = SheetLayout { caption_lines: 2, ..layout((120, 40), 2, 3, false) };
        let mut sheet = ContactSheet::new(captioned, 3, [9, 9, 9]).unwrap();
        let strip = captioned.strip();
        assert!(strip >= 2 * 6 && captioned.size(3) == (3 + 2 * 123, 3 + 2 * u64::from(40 + strip + 3)));
        for number in 1..=3 {
            sheet.place(number, &Preview { width: 120, height: 40, rgba: [200, 0, 0, 255].repeat(120 * 40) });
        }
        let before = sheet.clone().finish();
        assert_eq!(sheet.clone().caption(1, &["sky", "\u{4e2d}"]), Some('\u{4e2d}'));
        assert_eq!(sheet.caption(2, &["sky", "1.8 % 3.2 s", "left out: \u{4e2d}"]), None);
        let after = sheet.finish();
        let changed = |x: u32, y: u32| {
            let at = (y * after.width + x) as usize * 4;
            before.rgba[at..at + 4] != after.rgba[at..at + 4]
        };
        for y in 0..after.height {
            for x in 0..after.width {
                let inside = (126..246).contains(&x) && (43..43 + strip).contains(&y);
                assert_eq!(changed(x, y), inside, "{x} {y}");
            }
        }
    }

    #[test]
    fn labels_mark_the_corner_and_nothing_else() {
        let mut sheet = ContactSheet::new(layout((220, 220), 1, 0, true), 1, [0; 3]).unwrap();
        sheet.place(1, &Preview { width: 220, height: 220, rgba: [0, 0, 0, 255].repeat(220 * 220) });
        let picture = sheet.finish();
        let lit: Vec<usize> = (0..220 * 220).filter(|i| picture.rgba[i * 4] != 0).collect();
        assert_eq!(lit.len(), digits::dots(1).len() * 4);
        assert!(lit.iter().all(|i| i % 220 < 20 && i / 220 < 20));
    }
}
