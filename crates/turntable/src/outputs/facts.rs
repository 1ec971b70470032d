//! What is said about a frame under its picture.

use std::path::Path;

use hair_render::FrameHeader;

use crate::expand::Variant;
use crate::schema::Caption;

/// The lines under a frame on the sheet: the variant's name, then the figures.
pub(super) fn lines(captions: &[Caption], variant: &Variant, number: u32, path: &Path) -> Vec<String> {
    let header = FrameHeader::read(path).ok();
    let mut lines = Vec::new();
    if captions.contains(&Caption::Variant) {
        lines.push(variant.id.clone());
    }
    let figures: Vec<String> = captions
        .iter()
        .filter_map(|caption| match caption {
            Caption::Variant => None,
            Caption::Frame => Some(format!("frame {number:04}")),
            Caption::Error => header.as_ref()?.relative_error.map(percent),
            Caption::Seconds => header.as_ref().map(|header| seconds(header.seconds)),
        })
        .collect();
    if captions.iter().any(|caption| *caption != Caption::Variant) {
        lines.push(figures.join("  "));
    }
    lines
}

/// A relative error in words.
pub(super) fn percent(error: f64) -> String {
    format!("{:.1} %", 100.0 * error)
}

/// Seconds in words.
pub(super) fn seconds(seconds: f64) -> String {
    format!("{seconds:.1} s")
}
