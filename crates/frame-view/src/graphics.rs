//! The graphics of kitty and of iTerm2.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use image::ImageEncoder as _;

use crate::{Picture, ViewError};

/// Pixels that a character is taken to have: pictures are sent no larger than they can be seen.
const CELL: (u32, u32) = (12, 24);

/// Bytes of a piece in kitty's protocol, at most.
const PIECE: usize = 4096;

/// The picture as kitty wants it: RGB, in pieces, shown in `cells`.
pub(crate) fn kitty(picture: &Picture, cells: (u32, u32)) -> Vec<u8> {
    let picture = seen(picture, cells);
    let (width, height) = picture.size();
    let bytes = STANDARD.encode(picture.pixels().as_flattened());
    let pieces: Vec<&[u8]> = bytes.as_bytes().chunks(PIECE).collect();
    let mut out = Vec::new();
    for (index, piece) in pieces.iter().enumerate() {
        let more = u8::from(index + 1 < pieces.len());
        let keys = if index == 0 {
            // q=2: no answer, which would be read as typed.
            format!("a=T,f=24,q=2,s={width},v={height},c={},r={},m={more}", cells.0, cells.1)
        } else {
            format!("m={more}")
        };
        out.extend_from_slice(format!("\x1b_G{keys};").as_bytes());
        out.extend_from_slice(piece);
        out.extend_from_slice(b"\x1b\\");
    }
    out.push(b'\n');
    out
}

/// The picture as iTerm2 wants it: a PNG, shown in `cells`.
pub(crate) fn inline(picture: &Picture, cells: (u32, u32)) -> Result<Vec<u8>, ViewError> {
    let picture = seen(picture, cells);
    let (width, height) = picture.size();
    let mut png = Vec::new();
    image::codecs::png::PngEncoder::new(&mut png)
        .write_image(picture.pixels().as_flattened(), width, height, image::ExtendedColorType::Rgb8)
        .map_err(|fault| ViewError::Packed(fault.to_string()))?;
    let (across, down, bytes) = (cells.0, cells.1, png.len());
    let keys = format!("inline=1;size={bytes};width={across};height={down};preserveAspectRatio=1");
    Ok(format!("\x1b]1337;File={keys}:{}\x07\n", STANDARD.encode(png)).into_bytes())
}

/// The picture no larger than `cells` can show it.
pub(crate) fn seen(picture: &Picture, cells: (u32, u32)) -> Picture {
    let room = (cells.0.saturating_mul(CELL.0), cells.1.saturating_mul(CELL.1));
    let (width, height) = picture.size_in(room, false);
    picture.scaled(width, height)
}
