//! Environments as files: Radiance .hdr and OpenEXR.

use std::fs::File;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use exr::prelude as openexr;
use glam::Vec3;

use crate::{Environment, RenderError};

/// Pictures above this many pixels are refused before anything is allocated for them (4 GiB of colours).
const MOST_PIXELS: u64 = 1 << 28;

pub(crate) fn read(path: &Path) -> Result<Environment, RenderError> {
    let io = |source| RenderError::Io { path: path.to_owned(), source };
    let mut file = BufReader::new(File::open(path).map_err(io)?);
    let mut magic = Vec::new();
    file.by_ref().take(10).read_to_end(&mut magic).map_err(io)?;
    file.seek(SeekFrom::Start(0)).map_err(io)?;
    if magic.starts_with(&[0x76, 0x2f, 0x31, 0x01]) {
        read_exr(path, file)
    } else if magic.starts_with(b"#?") {
        read_hdr(path, file)
    } else {
        let reason = "expected a Radiance .hdr or an OpenEXR file".into();
        Err(RenderError::UnsupportedPicture { path: path.to_owned(), reason })
    }
}

fn invalid(path: &Path, reason: impl ToString) -> RenderError {
    RenderError::InvalidPicture { path: path.to_owned(), reason: reason.to_string() }
}

fn finish(path: &Path, width: usize, height: usize, pixels: Vec<Vec3>) -> Result<Environment, RenderError> {
    Environment::from_pixels(width, height, pixels).map_err(|fault| invalid(path, fault))
}

fn check_size(path: &Path, width: u64, height: u64) -> Result<(), RenderError> {
    match width.checked_mul(height) {
        Some(pixels) if (1..=MOST_PIXELS).contains(&pixels) => Ok(()),
        _ => Err(invalid(path, format!("{width} x {height} pixels, expected 1 to {MOST_PIXELS} in all"))),
    }
}

fn read_hdr(path: &Path, file: BufReader<File>) -> Result<Environment, RenderError> {
    use image::ImageDecoder;
    let decoder = image::codecs::hdr::HdrDecoder::new(file).map_err(|fault| invalid(path, fault))?;
    let (width, height) = decoder.dimensions();
    check_size(path, width.into(), height.into())?;
    let picture = image::DynamicImage::from_decoder(decoder).map_err(|fault| invalid(path, fault))?;
    let pixels = picture.into_rgb32f().pixels().map(|p| Vec3::from_array(p.0)).collect();
    finish(path, width as usize, height as usize, pixels)
}

fn read_exr(path: &Path, file: BufReader<File>) -> Result<Environment, RenderError> {
    use openexr::{ReadChannels, ReadLayers};
    struct Pixels {
        width: usize,
        height: usize,
        values: Vec<Vec3>,
    }
    let fits =
        |size: openexr::Vec2<usize>| check_size(path, size.width() as u64, size.height() as u64).is_ok();
    let read = openexr::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgb_channels(
            |size: openexr::Vec2<usize>, _: &openexr::RgbChannels| {
                // Nothing can be returned here: a size too large stays empty and is refused below.
                let count = if fits(size) { size.area() } else { 0 };
                Pixels { width: size.width(), height: size.height(), values: vec![Vec3::ZERO; count] }
            },
            |pixels: &mut Pixels, at, (r, g, b): (f32, f32, f32)| {
                if let Some(value) = pixels.values.get_mut(at.y() * pixels.width + at.x()) {
                    *value = Vec3::new(r, g, b);
                }
            },
        )
        .first_valid_layer()
        .all_attributes();
    let fault = |fault: exr::error::Error| match fault {
        exr::error::Error::NotSupported(reason) => {
            RenderError::UnsupportedPicture { path: path.to_owned(), reason: reason.to_string() }
        }
        exr::error::Error::Io(source) => RenderError::Io { path: path.to_owned(), source },
        other => invalid(path, other),
    };
    let pixels = read.from_buffered(file).map_err(fault)?.layer_data.channel_data.pixels;
    check_size(path, pixels.width as u64, pixels.height as u64)?;
    finish(path, pixels.width, pixels.height, pixels.values)
}
