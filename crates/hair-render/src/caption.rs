//! Words on a dark strip, in letters sized to a picture's width.

use std::convert::Infallible;

use embedded_graphics::Drawable as _;
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle, iso_8859_1 as fonts};
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::prelude::{DrawTarget, OriginDimensions, Pixel, Point, Size};
use embedded_graphics::text::{Baseline, Text};

use crate::Preview;

/// sRGB of the strip and of the letters on it.
const STRIP: [u8; 4] = [24, 24, 24, 255];
const LETTERS: [u8; 4] = [235, 235, 235, 255];

/// About as many letters should find room beside each other.
const LETTERS_ACROSS: u32 = 32;

/// Narrow to wide; letters narrower than the first cannot be read.
const FONTS: [&MonoFont; 7] = [
    &fonts::FONT_4X6,
    &fonts::FONT_5X8,
    &fonts::FONT_6X12,
    &fonts::FONT_7X13,
    &fonts::FONT_8X13,
    &fonts::FONT_9X15,
    &fonts::FONT_10X20,
];

/// A font for a strip under a picture.
#[derive(Clone, Copy)]
pub(crate) struct Caption {
    font: &'static MonoFont<'static>,
    /// Pixels to a dot of the font.
    dot: u32,
}

impl Caption {
    /// The largest letters of which about [`LETTERS_ACROSS`] stand side by side in `width` pixels, the smallest
    /// there are where that is narrower still.
    pub fn for_width(width: u32) -> Self {
        let wanted = width / LETTERS_ACROSS;
        let fits = |font: &&&MonoFont| font.character_size.width <= wanted;
        let font: &MonoFont = FONTS.iter().rev().find(fits).unwrap_or(&FONTS[0]);
        Caption { font, dot: (wanted / font.character_size.width).max(1) }
    }

    /// Rows of pixels that a strip of so many lines takes; none for no line.
    pub fn height(self, lines: u32) -> u32 {
        let line = self.font.character_size.height.saturating_mul(self.dot);
        let edges = if lines > 0 { 2 * self.dot } else { 0 };
        line.saturating_mul(lines).saturating_add(edges)
    }

    /// A strip of `width` pixels with a line for each of `lines`, and room for `room` of them.
    pub fn drawn<'a>(self, width: u32, room: u32, lines: impl Iterator<Item = &'a str>) -> Preview {
        let height = self.height(room);
        let rgba = STRIP.repeat(width as usize * height as usize);
        let mut strip = Strip { picture: Preview { width, height, rgba }, dot: self.dot };
        let letter = self.font.character_size;
        let letters = (width / self.dot).saturating_sub(2) / letter.width;
        let style = MonoTextStyle::new(self.font, BinaryColor::On);
        for (index, line) in (0..).zip(lines) {
            let words = fitted(line, letters as usize);
            let at = Point::new(1, 1 + index * letter.height as i32);
            let Ok(_) = Text::with_baseline(&words, at, style, Baseline::Top).draw(&mut strip);
        }
        strip.picture
    }
}

/// `line` in letters that the fonts have, at most `room` of them; three dots for what is left out, fewer where
/// not even those find room.
fn fitted(line: &str, room: usize) -> String {
    let known = |c: char| if is_known(c) { c } else { '?' };
    let letters: Vec<char> = line.replace('\u{2026}', "...").chars().map(known).collect();
    if letters.len() <= room {
        return letters.into_iter().collect();
    }
    let dots = room.min(3);
    letters[..room - dots].iter().copied().chain(std::iter::repeat_n('.', dots)).collect()
}

/// Whether the fonts have that letter.
fn is_known(c: char) -> bool {
    !c.is_control() && u32::from(c) <= 0xff
}

/// The first letter of `line` that the fonts do not have.
pub(crate) fn unknown_in(line: &str) -> Option<char> {
    line.chars().find(|&c| !is_known(c) && c != '\u{2026}')
}

/// What the letters are drawn on.
struct Strip {
    picture: Preview,
    dot: u32,
}

impl OriginDimensions for Strip {
    fn size(&self) -> Size {
        Size::new(self.picture.width / self.dot, self.picture.height / self.dot)
    }
}

impl DrawTarget for Strip {
    type Color = BinaryColor;
    type Error = Infallible;

    fn draw_iter<I: IntoIterator<Item = Pixel<BinaryColor>>>(&mut self, pixels: I) -> Result<(), Infallible> {
        let Size { width, height } = self.size();
        for Pixel(Point { x, y }, color) in pixels {
            let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { continue };
            if x >= width || y >= height || color == BinaryColor::Off {
                continue;
            }
            for row in y * self.dot..(y + 1) * self.dot {
                let start = (row as usize * self.picture.width as usize + (x * self.dot) as usize) * 4;
                if let Some(dots) = self.picture.rgba.get_mut(start..start + self.dot as usize * 4) {
                    dots.copy_from_slice(&LETTERS.repeat(self.dot as usize));
                }
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lit(strip: &Preview) -> Vec<bool> {
        strip.rgba.chunks_exact(4).map(|pixel| pixel == LETTERS).collect()
    }

    #[test]
    fn what_does_not_fit_ends_in_dots() {
        assert_eq!(fitted("smooth/sky", 10), "smooth/sky");
        assert_eq!(fitted("smooth/sky!", 10), "smooth/...");
        assert_eq!(fitted("smooth/sky", 2), "..");
        assert_eq!(fitted("smooth/sky", 0), "");
        assert_eq!(fitted("a\u{2026}\u{4e2d}\n\u{b5}", 9), "a...??\u{b5}");
        assert_eq!((unknown_in("a\u{2026}\u{b5}"), unknown_in("a\u{4e2d}b")), (None, Some('\u{4e2d}')));
    }

    #[test]
    fn letters_grow_with_the_picture_and_stay_in_the_strip() {
        let mut last = 0;
        for width in [1, 16, 64, 128, 200, 256, 320, 512, 640, 1024, 4096] {
            let caption = Caption::for_width(width);
            let strip = caption.drawn(
                width,
                2,
                ["Mg|_", "1.8 % 3.2 s, and more than finds room in a line"].into_iter(),
            );
            assert_eq!(strip.rgba.len(), (strip.width * strip.height * 4) as usize);
            assert!(strip.height >= last, "{width}");
            last = strip.height;
            let lit = lit(&strip);
            assert_eq!(lit.iter().any(|&on| on), width >= 16, "{width}");
            let edge = |i: usize| i.is_multiple_of(width as usize) || i < width as usize;
            assert!(!(0..lit.len()).any(|i| lit[i] && edge(i)), "{width}");
        }
        assert_eq!(Caption::for_width(512).height(0), 0);
    }

    #[test]
    fn every_letter_of_latin_1_looks_like_no_other() {
        let mut seen = std::collections::BTreeMap::new();
        for letter in (0x21..=0x7eu8).chain(0xa1..=0xff).map(char::from).filter(|&c| c != '\u{ad}') {
            let strip = Caption::for_width(320).drawn(320, 1, [letter.to_string().as_str()].into_iter());
            if let Some(other) = seen.insert(lit(&strip), letter) {
                assert!("|\u{a6}-\u{af}".contains(letter), "{letter} looks like {other}");
            }
        }
    }
}
