//! A sample groom as a HAIR file with the arrays asked for.

use cyhair::{HairFile, Header};
use groom::{Attribute, FloatView, Groom, names};

use crate::arrays::Arrays;

/// Colour of hair without a colours array: brown.
const BROWN: [f32; 3] = [0.32, 0.18, 0.085];

/// The file; what has no array is told by the header's defaults, as well as one number can.
pub fn from_groom(groom: &Groom, arrays: Arrays, info: &str) -> HairFile {
    // A sample always has a radius at each point; thickness is a diameter.
    let radii = groom.radii();
    let mut thickness = Vec::with_capacity(groom.point_count());
    for strand in 0..groom.strand_count() {
        thickness.extend(groom.strand_range(strand).map(|vertex| 2.0 * radii.get(strand, vertex)));
    }
    let mean = thickness.iter().map(|&t| f64::from(t)).sum::<f64>() / thickness.len() as f64;
    let segments = |range: &[u32]| (range[1] - range[0] - 1) as u16;
    let offsets = groom.offsets();
    let mut header = Header {
        hair_count: groom.strand_count() as u32,
        point_count: groom.point_count() as u32,
        default_segments: segments(&offsets[..2]).into(),
        default_thickness: mean as f32,
        default_color: BROWN,
        ..Header::default()
    };
    header.set_info_text(info);
    let transparency = groom.attribute(names::TRANSPARENCY).and_then(Attribute::float_view);
    let mut file = HairFile {
        header,
        segments: arrays.segments.then(|| offsets.windows(2).map(segments).collect()),
        points: arrays.points.then(|| groom.positions().iter().map(|p| p.to_array()).collect()),
        thickness: arrays.thickness.then_some(thickness),
        transparency: match transparency {
            Some(FloatView::Vertex(values)) => Some(values.to_vec()),
            _ => None,
        },
        colors: groom
            .colors()
            .map(|colors| (0..groom.point_count()).map(|v| colors.get(0, v).to_array()).collect()),
    };
    file.sync_header();
    file
}
