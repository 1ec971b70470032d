//! Digits of 3 x 5 dots, enough to number the frames of a sheet.

/// Rows of each digit, top to bottom; bit 2 is the left dot.
const DIGITS: [[u8; 5]; 10] = [
    [0b111, 0b101, 0b101, 0b101, 0b111],
    [0b010, 0b110, 0b010, 0b010, 0b111],
    [0b111, 0b001, 0b111, 0b100, 0b111],
    [0b111, 0b001, 0b011, 0b001, 0b111],
    [0b101, 0b101, 0b111, 0b001, 0b001],
    [0b111, 0b100, 0b111, 0b001, 0b111],
    [0b111, 0b100, 0b111, 0b101, 0b111],
    [0b111, 0b001, 0b010, 0b010, 0b010],
    [0b111, 0b101, 0b111, 0b101, 0b111],
    [0b111, 0b101, 0b111, 0b001, 0b111],
];

/// The lit dots of `number` as columns and rows from its upper left corner; each dot is one unit.
pub(crate) fn dots(number: u32) -> Vec<(u32, u32)> {
    let mut dots = Vec::new();
    for (place, digit) in number.to_string().bytes().enumerate() {
        let rows = DIGITS[usize::from(digit - b'0')];
        for (y, row) in rows.into_iter().enumerate() {
            let lit = (0..3).filter(move |x| row >> (2 - x) & 1 == 1);
            dots.extend(lit.map(|x| (place as u32 * 4 + x, y as u32)));
        }
    }
    dots
}
