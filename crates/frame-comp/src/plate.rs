//! Pictures to be put behind a frame.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use glam::Vec3;
use hair_render::{Frame, LightPicture, RenderError, read_light};
use image::metadata::Orientation;
use image::{ImageDecoder, ImageReader, Limits};

use crate::{CompError, Fit, Fitted, fit};

/// Edges of a plate and all of it, pixels, and bytes it may unpack to: a small file may hold a large picture of nothing.
const MOST_EDGE: u32 = 32_768;
const MOST_PIXELS: u64 = 1 << 27;
const MOST_BYTES: u64 = 8 * MOST_PIXELS;

/// What the numbers of a picture stand for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// Light, as in an `.exr` or an `.hdr`: exposure and curve are for it as for the frame before it.
    Light,
    /// What a screen shows, as in a `.png` or a `.jpg`: it is to be seen as it is.
    Display,
}

/// A picture to be put behind a frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Plate {
    width: usize,
    height: usize,
    /// Linear Rec. 709.
    pixels: Vec<Vec3>,
    meaning: Meaning,
}

impl Plate {
    /// A plate of linear Rec. 709 values; `None` when there are not `width` x `height` of them, or none.
    #[must_use]
    pub fn new(width: usize, height: usize, pixels: Vec<Vec3>, meaning: Meaning) -> Option<Plate> {
        let fits = width > 0 && height > 0 && width.checked_mul(height) == Some(pixels.len());
        fits.then_some(Plate { width, height, pixels, meaning })
    }

    /// Reads a `.png` or `.jpg` (sRGB), an `.exr` or an `.hdr` (light), by its bytes and not its name. What is
    /// transparent in a PNG is black; a photograph is turned as its camera says it was held.
    ///
    /// # Errors
    /// [`CompError::Io`], [`CompError::Plate`] or [`CompError::Light`].
    pub fn read(path: &Path) -> Result<Plate, CompError> {
        let io = |source| CompError::Io { path: path.to_owned(), source };
        let fault = |reason: String| CompError::Plate { path: path.to_owned(), reason };
        let reader = ImageReader::new(BufReader::new(File::open(path).map_err(io)?));
        let reader = reader.with_guessed_format().map_err(io)?;
        if !matches!(reader.format(), Some(image::ImageFormat::Png | image::ImageFormat::Jpeg)) {
            let LightPicture { width, height, pixels } = read_light(path).map_err(|other| match other {
                RenderError::UnsupportedPicture { reason, .. } => fault(reason),
                other => CompError::Light(other),
            })?;
            return Plate::new(width, height, pixels, Meaning::Light)
                .ok_or_else(|| fault("it is empty".into()));
        }
        let mut reader = reader;
        let mut limits = Limits::default();
        limits.max_image_width = Some(MOST_EDGE);
        limits.max_image_height = Some(MOST_EDGE);
        limits.max_alloc = Some(MOST_BYTES);
        reader.limits(limits);
        let mut decoder = reader.into_decoder().map_err(|e| fault(e.to_string()))?;
        let (width, height) = decoder.dimensions();
        if u64::from(width) * u64::from(height) > MOST_PIXELS {
            return Err(fault(format!("{width} x {height} pixels, expected at most {MOST_PIXELS}")));
        }
        // What cannot be read there is no reason not to show the picture.
        let turned = decoder.orientation().unwrap_or(Orientation::NoTransforms);
        let mut picture = image::DynamicImage::from_decoder(decoder).map_err(|e| fault(e.to_string()))?;
        picture.apply_orientation(turned);
        let picture = picture.into_rgba16();
        let linear = |pixel: &image::Rgba<u16>| {
            let [red, green, blue, alpha] = pixel.0.map(|value| f32::from(value) / 65535.0);
            Vec3::new(red, green, blue).map(light_of_srgb) * alpha
        };
        let pixels = picture.pixels().map(linear).collect();
        Plate::new(picture.width() as usize, picture.height() as usize, pixels, Meaning::Display)
            .ok_or_else(|| fault("it is empty".into()))
    }

    /// Pixels across and down.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.width, self.height)
    }

    /// What its numbers stand for.
    #[must_use]
    pub fn meaning(&self) -> Meaning {
        self.meaning
    }

    /// The plate in a picture of `width` x `height` pixels.
    #[must_use]
    pub fn fitted(&self, width: u32, height: u32, fit: Fit) -> Fitted {
        fit::fitted(&self.pixels, (self.width, self.height), (width as usize, height as usize), fit)
    }

    /// The plate as it lies behind `frame`: behind a part of a picture, that part of it.
    #[must_use]
    pub fn behind(&self, frame: &Frame, fit: Fit) -> Fitted {
        let Some(cutout) = frame.cutout else { return self.fitted(frame.width, frame.height, fit) };
        let whole = self.fitted(cutout.full_width, cutout.full_height, fit);
        let rows = whole.pixels.chunks(cutout.full_width.max(1) as usize);
        let rows = rows.skip(cutout.y as usize).take(frame.height as usize);
        let columns = |row: &[Vec3]| {
            row.iter().skip(cutout.x as usize).take(frame.width as usize).copied().collect::<Vec<_>>()
        };
        Fitted { pixels: rows.flat_map(columns).collect(), ..whole }
    }
}

/// IEC 61966-2-1.
pub(crate) fn light_of_srgb(value: f32) -> f32 {
    if value <= 0.040_45 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}
