//! Environments as files: Radiance .hdr and OpenEXR.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;

use exr::prelude as openexr;
use glam::Vec3;

use crate::{Environment, RenderError};

/// Pictures above this many pixels are refused before anything is allocated for them (3 GiB of colours).
const MOST_PIXELS: u64 = 1 << 28;

/// Pixels that a byte of a run-length coded .hdr file can stand for: 2 bytes repeat one of 4 channels
/// 127 times.
const HDR_PIXELS_A_BYTE: u64 = 16;

/// The same of an .exr file: deflate makes at most 1032 bytes of one.
const EXR_PIXELS_A_BYTE: u64 = 1024;

/// Bytes that a block of an .exr file may unpack to for each byte of the file: 12 a pixel.
const EXR_BLOCK_BYTES_A_BYTE: u64 = 12 * EXR_PIXELS_A_BYTE;

/// A picture file that is being read.
struct Source<'a> {
    path: &'a Path,
    file: BufReader<File>,
    bytes: u64,
}

pub(crate) fn read(path: &Path) -> Result<Environment, RenderError> {
    let LightPicture { width, height, pixels } = read_light(path)?;
    Environment::from_pixels(width, height, pixels).map_err(|fault| invalid(path, fault))
}

/// A picture of light: linear Rec. 709, row by row from the upper left.
#[derive(Clone, Debug, PartialEq)]
pub struct LightPicture {
    /// Pixels across.
    pub width: usize,
    /// Pixels down.
    pub height: usize,
    /// width x height values.
    pub pixels: Vec<Vec3>,
}

/// Reads the colours of a Radiance `.hdr` or an OpenEXR file, by its bytes and not its name; alpha is left out.
///
/// # Errors
/// [`RenderError::Io`], [`RenderError::InvalidPicture`] or [`RenderError::UnsupportedPicture`].
pub fn read_light(path: &Path) -> Result<LightPicture, RenderError> {
    let io = |source| RenderError::Io { path: path.to_owned(), source };
    let mut file = BufReader::new(File::open(path).map_err(io)?);
    let bytes = file.get_ref().metadata().map_err(io)?.len();
    let mut magic = Vec::new();
    file.by_ref().take(10).read_to_end(&mut magic).map_err(io)?;
    file.seek(SeekFrom::Start(0)).map_err(io)?;
    let source = Source { path, file, bytes };
    let decode = if magic.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
        read_exr
    } else if magic.starts_with(b"#?") {
        read_hdr
    } else {
        let reason = "it is neither a Radiance .hdr nor an OpenEXR file".into();
        return Err(RenderError::UnsupportedPicture { path: path.to_owned(), reason });
    };
    // The decoders are other people's: one that panics on a broken file must not end the program.
    catch_unwind(AssertUnwindSafe(|| decode(source)))
        .unwrap_or_else(|_| Err(invalid(path, "its decoder gave up on it")))
}

fn invalid(path: &Path, reason: impl ToString) -> RenderError {
    RenderError::InvalidPicture { path: path.to_owned(), reason: reason.to_string() }
}

/// Refuses a size that is out of bounds, or that a file of `bytes` cannot hold.
fn check_size([width, height]: [u64; 2], bytes: u64, pixels_a_byte: u64) -> Result<(), String> {
    let most = MOST_PIXELS.min(bytes.saturating_mul(pixels_a_byte));
    match width.checked_mul(height) {
        Some(pixels) if (1..=most).contains(&pixels) => Ok(()),
        _ => {
            Err(format!("{width} x {height} pixels, expected 1 to {most} in all in a file of {bytes} bytes"))
        }
    }
}

fn read_hdr(Source { path, file, bytes }: Source) -> Result<LightPicture, RenderError> {
    use image::ImageDecoder;
    let decoder = image::codecs::hdr::HdrDecoder::new(file).map_err(|fault| invalid(path, fault))?;
    let (width, height) = decoder.dimensions();
    check_size([width.into(), height.into()], bytes, HDR_PIXELS_A_BYTE).map_err(|e| invalid(path, e))?;
    let picture = image::DynamicImage::from_decoder(decoder).map_err(|fault| invalid(path, fault))?;
    let pixels = picture.into_rgb32f().pixels().map(|p| Vec3::from_array(p.0)).collect();
    Ok(LightPicture { width: width as usize, height: height as usize, pixels })
}

/// Refuses headers for which the decoder would take more memory than the file can fill: it allocates
/// whole blocks as the header has them, and a failed allocation ends the program.
fn check_headers(headers: &[exr::meta::header::Header], bytes: u64) -> Result<(), String> {
    for header in headers {
        let [size, block] = [header.layer_size, header.max_block_pixel_size()];
        check_size([size.width() as u64, size.height() as u64], bytes, EXR_PIXELS_A_BYTE)?;
        let most = bytes.saturating_mul(EXR_BLOCK_BYTES_A_BYTE);
        let found = [block.width(), block.height(), header.channels.bytes_per_pixel]
            .iter()
            .fold(1u64, |product, &factor| product.saturating_mul(factor as u64));
        if found > most {
            return Err(format!(
                "blocks of {found} bytes, expected at most {most} in a file of {bytes} bytes"
            ));
        }
    }
    Ok(())
}

fn read_exr(Source { path, file, bytes }: Source) -> Result<LightPicture, RenderError> {
    use openexr::{ReadChannels, ReadLayers};
    struct Pixels {
        width: usize,
        height: usize,
        values: Vec<Vec3>,
    }
    let read = openexr::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size: openexr::Vec2<usize>, _: &openexr::RgbChannels| Pixels {
                width: size.width(),
                height: size.height(),
                values: vec![Vec3::ZERO; size.area()],
            },
            |pixels: &mut Pixels, at, (r, g, b): (f32, f32, f32)| {
                if let Some(value) = pixels.values.get_mut(at.y() * pixels.width + at.x()) {
                    *value = Vec3::new(r, g, b);
                }
            },
        )
        .first_valid_layer()
        .all_attributes()
        // A panic in one of its own threads could not be caught.
        .non_parallel();
    let fault = |fault: exr::error::Error| match fault {
        exr::error::Error::NotSupported(reason) => {
            RenderError::UnsupportedPicture { path: path.to_owned(), reason: reason.to_string() }
        }
        exr::error::Error::Io(source) => RenderError::Io { path: path.to_owned(), source },
        other => invalid(path, other),
    };
    let chunks = exr::block::read(file, false).map_err(fault)?;
    check_headers(chunks.headers(), bytes).map_err(|reason| invalid(path, reason))?;
    let pixels = read.from_chunks(chunks).map_err(fault)?.layer_data.channel_data.pixels;
    let Pixels { width, height, values } = pixels;
    Ok(LightPicture { width, height, pixels: values })
}
