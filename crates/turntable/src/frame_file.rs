//! Frames on disk: what their headers say, whether they are whole, and their pixels.

use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use exr::block::reader::{ChunksReader as _, Reader};
use exr::meta::attribute::AttributeValue;
use exr::prelude::{ReadChannels as _, ReadLayers as _, Text};
use glam::Vec3;
use hair_render::{Frame, FrameReport};

use crate::TurntableError;

/// What a frame's header says about how it was made.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct FrameHeader {
    pub digest: String,
    pub spp: u32,
    pub threads: u32,
    pub seconds: f64,
    pub relative_error: Option<f64>,
}

/// The header of a whole frame; `None` when the file is missing, not ours or cut short.
///
/// All compressed blocks are walked over, none is unpacked; [`unpacks`] does that.
pub(crate) fn whole_header(path: &Path) -> Option<FrameHeader> {
    let reader = Reader::read_from_buffered(BufReader::new(File::open(path).ok()?), true).ok()?;
    let header = header_of(&reader)?;
    let mut chunks = reader.all_chunks(true).ok()?;
    chunks.all(|chunk| chunk.is_ok()).then_some(header)
}

/// Whether all compressed blocks of a frame can be unpacked; each holds a checksum.
pub(crate) fn unpacks(path: &Path) -> bool {
    let read = || -> exr::error::UnitResult {
        Reader::read_from_buffered(BufReader::new(File::open(path)?), true)?
            .all_chunks(true)?
            .sequential_decompressor(true)
            .try_for_each(|block| block.map(drop))
    };
    read().is_ok()
}

/// The header of a frame, whole or not.
pub(crate) fn header(path: &Path) -> Option<FrameHeader> {
    header_of(&Reader::read_from_buffered(BufReader::new(File::open(path).ok()?), true).ok()?)
}

fn header_of<R: std::io::Read + std::io::Seek>(reader: &Reader<R>) -> Option<FrameHeader> {
    let attributes = &reader.headers().first()?.own_attributes.other;
    let get = |name: &str| attributes.get(&Text::new_or_none(name)?);
    let number = |name: &str| match get(name)? {
        AttributeValue::F64(value) => Some(*value),
        AttributeValue::F32(value) => Some(f64::from(*value)),
        AttributeValue::I32(value) => Some(f64::from(*value)),
        _ => None,
    };
    let Some(AttributeValue::Text(digest)) = get("digest") else { return None };
    Some(FrameHeader {
        digest: digest.to_string(),
        spp: number("spp")? as u32,
        threads: number("threads").unwrap_or_default() as u32,
        seconds: number("seconds")?,
        relative_error: number("relativeError"),
    })
}

/// Beauty and alpha of a frame.
pub(crate) fn read_beauty(path: &Path) -> Result<Frame, TurntableError> {
    let fault = |reason: String| TurntableError::Frame { path: path.to_owned(), reason };
    let image = exr::prelude::read()
        .no_deep_data()
        .largest_resolution_level()
        .rgba_channels(
            |size, _| (size.0, vec![(Vec3::ZERO, 0.0f32); size.0 * size.1]),
            |(width, pixels): &mut (usize, Vec<(Vec3, f32)>), at, (r, g, b, a): (f32, f32, f32, f32)| {
                pixels[at.1 * *width + at.0] = (Vec3::new(r, g, b), a);
            },
        )
        .first_valid_layer()
        .all_attributes()
        .from_file(path)
        .map_err(|error| fault(error.to_string()))?;
    let (_, pixels) = image.layer_data.channel_data.pixels;
    let size = image.layer_data.size;
    let (beauty, alpha) = pixels.into_iter().unzip();
    Ok(unmeasured((size.0 as u32, size.1 as u32), beauty, alpha))
}

/// A picture without figures, for tone mapping.
pub(crate) fn unmeasured((width, height): (u32, u32), beauty: Vec<Vec3>, alpha: Vec<f32>) -> Frame {
    let report = FrameReport {
        seconds: 0.0,
        spp: 0,
        seed: 0,
        threads: 0,
        samples: 0,
        closest_rays: 0,
        shadow_rays: 0,
        rejected_samples: 0,
        rel_mse: None,
        relative_error: None,
        motion: None,
    };
    Frame { width, height, cutout: None, beauty, alpha, passes: Vec::new(), report }
}

#[cfg(test)]
mod tests {
    use hair_render::Metadata;

    use super::*;

    #[test]
    fn whole_frames_answer_and_cut_ones_do_not() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("f.exr");
        std::fs::write(&path, b"not a frame").unwrap();
        assert_eq!(whole_header(&path), None);
        let pixels: Vec<Vec3> =
            (0..40 * 30).map(|i| Vec3::new(i as f32, (i * 7919 % 31) as f32, 0.5)).collect();
        let alpha: Vec<f32> = (0..40 * 30).map(|i| (i % 2) as f32).collect();
        let report = FrameReport {
            seconds: 1.5,
            spp: 8,
            seed: 3,
            threads: 2,
            samples: 9600,
            closest_rays: 1,
            shadow_rays: 1,
            rejected_samples: 0,
            rel_mse: Some(0.0025),
            relative_error: Some(0.05),
            motion: None,
        };
        let frame =
            Frame { width: 40, height: 30, cutout: None, beauty: pixels, alpha, passes: vec![], report };
        let metadata = Metadata { digest: "abc".into(), ..Metadata::default() };
        frame.write_exr(&path, &metadata).unwrap();
        let expect = FrameHeader {
            digest: "abc".into(),
            spp: 8,
            threads: 2,
            seconds: 1.5,
            relative_error: Some(0.05),
        };
        assert_eq!(whole_header(&path), Some(expect));
        let back = read_beauty(&path).unwrap();
        assert_eq!((back.width, back.height), (40, 30));
        assert_eq!((&back.beauty, &back.alpha), (&frame.beauty, &frame.alpha));
        assert!(unpacks(&path));
        let bytes = std::fs::read(&path).unwrap();
        let mut flipped = bytes.clone();
        flipped[bytes.len() * 3 / 4] ^= 0x10;
        std::fs::write(&path, &flipped).unwrap();
        assert!(!unpacks(&path), "a flipped bit in the compressed pixels");
        for cut in (0..bytes.len()).step_by(97).chain([bytes.len() - 1]) {
            std::fs::write(&path, &bytes[..cut]).unwrap();
            assert_eq!(whole_header(&path), None, "cut at {cut} of {}", bytes.len());
        }
    }
}
