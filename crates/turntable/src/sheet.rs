//! All frames side by side in one picture.

use hair_render::Preview;

use crate::digits;
use crate::schema::{Render, Sheet};

/// A contact sheet of previews of one size, filled row by row, numbered from 1.
pub(crate) struct ContactSheet {
    picture: Preview,
    columns: u32,
    gap: u32,
    labels: bool,
    cell: (u32, u32),
}

impl ContactSheet {
    /// An empty sheet for `count` frames; `background` shows in the gaps.
    pub fn new(sheet: &Sheet, count: u32, render: &Render, background: [u8; 3]) -> Self {
        let (width, height) = (render.width, render.height);
        let columns = columns_of(sheet, count, width, height);
        // The pipeline's check keeps both far below what 32 bits hold.
        let (across, down) = size_of(sheet, count, render);
        let (across, down) = (across as u32, down as u32);
        let [r, g, b] = background;
        let rgba = [r, g, b, 255].repeat(across as usize * down as usize);
        let picture = Preview { width: across, height: down, rgba };
        ContactSheet { picture, columns, gap: sheet.gap, labels: sheet.labels, cell: (width, height) }
    }

    /// Puts frame `number` (from 1) in its place.
    pub fn place(&mut self, number: u32, frame: &Preview) {
        let index = number - 1;
        let left = self.gap + index % self.columns * (self.cell.0 + self.gap);
        let top = self.gap + index / self.columns * (self.cell.1 + self.gap);
        let row_bytes = frame.width as usize * 4;
        for (y, row) in frame.rgba.chunks_exact(row_bytes.max(1)).enumerate() {
            let start = ((top as usize + y) * self.picture.width as usize + left as usize) * 4;
            if let Some(to) = self.picture.rgba.get_mut(start..start + row_bytes) {
                to.copy_from_slice(row);
            }
        }
        if self.labels {
            self.label(number, left, top);
        }
    }

    /// The number in the upper left corner of its frame, sized to it; small frames have none.
    fn label(&mut self, number: u32, left: u32, top: u32) {
        let dot = self.cell.0.min(self.cell.1) / 110;
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
    pub fn finish(self) -> Preview {
        self.picture
    }
}

fn columns_of(sheet: &Sheet, count: u32, width: u32, height: u32) -> u32 {
    sheet.columns.unwrap_or_else(|| about_square(count, width, height)).clamp(1, count.max(1))
}

/// Width and height of the sheet of a pipeline, in pixels.
pub(crate) fn size_of(sheet: &Sheet, count: u32, render: &Render) -> (u64, u64) {
    let (width, height) = (render.width.max(1), render.height.max(1));
    let columns = u64::from(columns_of(sheet, count, width, height));
    let rows = u64::from(count).div_ceil(columns).max(1);
    let side =
        |cells: u64, cell: u32| u64::from(sheet.gap) + cells * u64::from(cell.saturating_add(sheet.gap));
    (side(columns, width), side(rows, height))
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

    fn cell(width: u32, height: u32) -> Render {
        Render { width, height, ..Render::default() }
    }

    #[test]
    fn frames_stand_in_rows() {
        let settings = Sheet { columns: Some(2), gap: 1, labels: false, ..Sheet::default() };
        let mut sheet = ContactSheet::new(&settings, 3, &cell(4, 2), [9, 9, 9]);
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
    }

    #[test]
    fn labels_mark_the_corner_and_nothing_else() {
        let settings = Sheet { gap: 0, columns: Some(1), ..Sheet::default() };
        let mut sheet = ContactSheet::new(&settings, 1, &cell(220, 220), [0; 3]);
        sheet.place(1, &Preview { width: 220, height: 220, rgba: [0, 0, 0, 255].repeat(220 * 220) });
        let picture = sheet.finish();
        let lit: Vec<usize> = (0..220 * 220).filter(|i| picture.rgba[i * 4] != 0).collect();
        assert_eq!(lit.len(), digits::dots(1).len() * 4);
        assert!(lit.iter().all(|i| i % 220 < 20 && i / 220 < 20));
    }
}
