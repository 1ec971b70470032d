//! A frame as one OpenEXR file with a layer for every pass; reading it is in `frame_read.rs`.

use std::collections::BTreeMap;
use std::io::BufWriter;
use std::path::Path;

use exr::image::write::samples::WritableSamples;
use exr::prelude as openexr;
use glam::{Mat4, Vec3};
use half::f16;
use openexr::{AnyChannel, AnyChannels, AttributeValue, FlatSamples, WritableImage};
use whole_file::WholeFile;

use crate::{Camera, Cutout, Frame, FrameReport, MotionReport, RenderError};

/// How the colours are stored.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Precision {
    /// 32-bit floats: the passes add up to the beauty.
    #[default]
    Float,
    /// 16-bit floats: half the bytes, 3 significant digits, at most 65504.
    Half,
}

/// What is written beside the pixels.
#[derive(Clone, Debug, Default)]
pub struct Metadata {
    /// The command line that made the picture.
    pub command: String,
    /// A digest of everything the picture depends on, for skipping what is up to date.
    pub digest: String,
    /// The camera, stored as `worldToCamera`.
    pub camera: Option<Camera>,
    /// The matrices of a frame that was read and is written again ([`crate::FrameHeader::matrices`]), stored where
    /// there is no `camera`.
    pub matrices: Option<[Mat4; 2]>,
    /// How the colours are stored.
    pub precision: Precision,
    /// Frames a second, where there is more than one; stored as `framesPerSecond`.
    pub frame_rate: Option<f64>,
    /// Seconds that the shutter is open, of a picture that can be blurred; stored as `expTime`.
    pub exposure_seconds: Option<f64>,
    /// More attributes; keys must not be empty.
    pub extra: BTreeMap<String, String>,
}

impl Frame {
    /// Writes the picture whole or not at all.
    ///
    /// One part, ZIP compressed. Beauty and alpha are the channels `R`, `G`, `B`, `A`; a pass `TT` is
    /// `TT.R`, `TT.G`, `TT.B`. Attributes: `software`, `command`, `digest`, `seed`, `spp`, `seconds`,
    /// `threads`, `relMSE`, `relativeError` (left out when not known), `closestRays`, `shadowRays`,
    /// `rejectedSamples`, `colorInteropID` = `lin_rec709_scene`, `chromaticities`, `worldToCamera`, `worldToNDC`
    /// and the extra ones. A picture with blur also has `shutter` (opening:closing in frames, shape) and, where
    /// they move, `motionKeys` and `cameraKeys`; `expTime` and `framesPerSecond` where the metadata know them. Of
    /// a crop the data window is the crop, the display window the whole picture.
    ///
    /// # Errors
    /// [`RenderError::Io`] or [`RenderError::Encode`]; the old file, if any, is then untouched.
    pub fn write_exr(&self, path: &Path, metadata: &Metadata) -> Result<(), RenderError> {
        let mut channels: openexr::SmallVec<[AnyChannel<FlatSamples>; 4]> = openexr::SmallVec::new();
        push_color(&mut channels, "", &self.beauty, metadata.precision);
        channels.push(AnyChannel::new("A", samples(self.alpha.iter().copied(), metadata.precision)));
        for (aov, pixels) in &self.passes {
            push_color(&mut channels, &format!("{}.", aov.name()), pixels, metadata.precision);
        }
        write_layer(path, self.attributes(metadata), channels, [self.width, self.height], self.cutout)
    }

    fn attributes(&self, metadata: &Metadata) -> openexr::LayerAttributes {
        let report = &self.report;
        let aspect = match &self.cutout {
            Some(cutout) => f64::from(cutout.full_width) / f64::from(cutout.full_height.max(1)),
            None => f64::from(self.width) / f64::from(self.height.max(1)),
        };
        // OpenEXR multiplies row vectors: its rows are our columns.
        let of_camera = |c: Camera| [c.camera_from_world(), c.ndc_from_world(aspect)].map(|m| m.as_mat4());
        let matrices = metadata.camera.map(of_camera).or(metadata.matrices);
        let matrix = |place: usize| matrices.map(|matrices| matrices[place].to_cols_array());
        let mut attributes = openexr::LayerAttributes {
            world_to_camera: matrix(0),
            world_to_normalized_device: matrix(1),
            exposure: metadata.exposure_seconds.map(|seconds| seconds as f32),
            frames_per_second: metadata.frame_rate.and_then(rational),
            ..openexr::LayerAttributes::default()
        };
        let strings = [("command", &metadata.command), ("digest", &metadata.digest)];
        let strings = strings.map(|(key, value)| (key.to_owned(), value.clone()));
        for (key, value) in
            strings.into_iter().chain(metadata.extra.clone()).filter(|(key, _)| !key.is_empty())
        {
            attributes.other.insert(text(&key), AttributeValue::Text(text(&value)));
        }
        for (key, value) in [("relMSE", report.rel_mse), ("relativeError", report.relative_error)] {
            if let Some(value) = value {
                attributes.other.insert(text(key), AttributeValue::F64(value));
            }
        }
        put_figures(&mut attributes, report);
        attributes
    }
}

/// What frames and checkpoints both tell.
pub(crate) fn put_figures(attributes: &mut openexr::LayerAttributes, report: &FrameReport) {
    attributes.software_name = Some(text(concat!("groomkit hair-render ", env!("CARGO_PKG_VERSION"))));
    let whole = |value: u64| AttributeValue::I32(i32::try_from(value).unwrap_or(i32::MAX));
    // Exact up to 2^53, which rays do not reach.
    let count = |value: u64| AttributeValue::F64(value as f64);
    let mut put = |key: &str, value: AttributeValue| {
        attributes.other.insert(text(key), value);
    };
    put("colorInteropID", AttributeValue::Text(text("lin_rec709_scene")));
    put("seed", AttributeValue::Text(text(&report.seed.to_string())));
    put("spp", whole(report.spp.into()));
    put("threads", whole(report.threads as u64));
    put("seconds", AttributeValue::F64(report.seconds));
    put("closestRays", count(report.closest_rays));
    put("shadowRays", count(report.shadow_rays));
    put("rejectedSamples", count(report.rejected_samples));
    let Some(MotionReport { shutter_open, shutter_close, shutter_shape, keys, camera_keys }) = &report.motion
    else {
        return;
    };
    let shutter = format!("{shutter_open}:{shutter_close} {shutter_shape}");
    put("shutter", AttributeValue::Text(text(&shutter)));
    for (key, value) in [("motionKeys", keys), ("cameraKeys", camera_keys)] {
        if let Some(value) = value {
            put(key, whole(*value as u64));
        }
    }
}

/// A frame rate as the fraction that OpenEXR keeps: over 1, 1001 (NTSC's) or 1000.
fn rational(rate: f64) -> Option<(i32, u32)> {
    let over = [1u32, 1001, 1000].into_iter().find(|&over| {
        let scaled = rate * f64::from(over);
        (scaled - scaled.round()).abs() < 1e-6 * scaled || over == 1000
    })?;
    let scaled = (rate * f64::from(over)).round();
    (1.0..=f64::from(i32::MAX)).contains(&scaled).then_some((scaled as i32, over))
}

/// Linear Rec. 709 primaries with a D65 white.
fn rec709() -> openexr::attribute::Chromaticities {
    openexr::attribute::Chromaticities {
        red: openexr::Vec2(0.64, 0.33),
        green: openexr::Vec2(0.30, 0.60),
        blue: openexr::Vec2(0.15, 0.06),
        white: openexr::Vec2(0.3127, 0.3290),
    }
}

fn encoding() -> openexr::Encoding {
    openexr::Encoding {
        compression: openexr::Compression::ZIP16,
        blocks: openexr::Blocks::ScanLines,
        line_order: openexr::LineOrder::Increasing,
    }
}

/// Text in UTF-8, as OpenEXR and its Python module read it; the `exr` crate's own way is Latin-1, which
/// has no words for most of the world's file names.
pub(crate) fn text(words: &str) -> openexr::Text {
    openexr::Text::from_slice_unchecked(words.as_bytes())
}

fn samples(values: impl Iterator<Item = f32>, precision: Precision) -> FlatSamples {
    match precision {
        Precision::Float => FlatSamples::F32(values.collect()),
        // Too bright for a half is stored as the brightest half: infinities break what comes after.
        Precision::Half => {
            FlatSamples::F16(values.map(|v| f16::from_f32(v.clamp(-65504.0, 65504.0))).collect())
        }
    }
}

fn push_color(
    channels: &mut openexr::SmallVec<[AnyChannel<FlatSamples>; 4]>,
    prefix: &str,
    pixels: &[Vec3],
    precision: Precision,
) {
    for (channel, name) in ["R", "G", "B"].into_iter().enumerate() {
        let values = pixels.iter().map(|pixel| pixel[channel]);
        channels.push(AnyChannel::new(format!("{prefix}{name}").as_str(), samples(values, precision)));
    }
}

/// Writes colours alone, as an environment wants them.
pub(crate) fn write_rgb(
    path: &Path,
    width: usize,
    pixels: &[Vec3],
    precision: Precision,
) -> Result<(), RenderError> {
    let mut channels = openexr::SmallVec::new();
    push_color(&mut channels, "", pixels, precision);
    let attributes = openexr::LayerAttributes {
        environment_map: Some(openexr::attribute::EnvironmentMap::LatitudeLongitude),
        ..openexr::LayerAttributes::default()
    };
    let size = (width, pixels.len() / width.max(1));
    let layer = openexr::Layer::new(size, attributes, encoding(), AnyChannels::sort(channels));
    let mut image = openexr::Image::from_layer(layer);
    image.attributes.chromaticities = Some(rec709());
    write_image(path, &image)
}

/// Writes channels as the one layer of a file, at its place in the whole picture.
pub(crate) fn write_layer<S>(
    path: &Path,
    mut attributes: openexr::LayerAttributes,
    channels: openexr::SmallVec<[AnyChannel<S>; 4]>,
    [width, height]: [u32; 2],
    cutout: Option<Cutout>,
) -> Result<(), RenderError>
where
    for<'s> S: WritableSamples<'s>,
{
    // At most 65536, as the settings are checked for.
    let place = |x: u32| i32::try_from(x).unwrap_or(i32::MAX);
    let mut display = openexr::Vec2(width as usize, height as usize);
    if let Some(cutout) = cutout {
        attributes.layer_position = openexr::Vec2(place(cutout.x), place(cutout.y));
        display = openexr::Vec2(cutout.full_width as usize, cutout.full_height as usize);
    }
    let size = (width as usize, height as usize);
    let layer = openexr::Layer::new(size, attributes, encoding(), AnyChannels::sort(channels));
    let mut image = openexr::Image::from_layer(layer);
    image.attributes.display_window = openexr::IntegerBounds::new(openexr::Vec2(0, 0), display);
    image.attributes.chromaticities = Some(rec709());
    write_image(path, &image)
}

fn write_image<S>(
    path: &Path,
    image: &openexr::Image<openexr::Layer<AnyChannels<S>>>,
) -> Result<(), RenderError>
where
    for<'s> S: WritableSamples<'s>,
{
    let io = |source| RenderError::Io { path: path.to_owned(), source };
    let mut file = BufWriter::new(WholeFile::create(path)?);
    image.write().to_buffered(&mut file).map_err(|fault| match fault {
        exr::error::Error::Io(source) => io(source),
        other => RenderError::Encode { path: path.to_owned(), reason: other.to_string() },
    })?;
    let file = file.into_inner().map_err(|e| io(e.into_error()))?;
    Ok(file.commit()?)
}
