//! CT2Hair's strands, `.bin`, read.
//!
//! As USC's `.data`, but every point has seven floats: `x y z`, a direction `nx ny nz` and a label
//! (`load_bin_strands` and `save_bin_strands` in CT2Hair's `datautils.py`). The direction becomes the vertex
//! attribute `tangent`, the label `label`; either is left out when all of it is zero, which is how it is
//! written when there is none. CT2Hair also stores colours in the place of directions (`save_color_strands`),
//! and nothing in the file tells: they too come out as `tangent`.
//!
//! No unit and no axis are in the file; y is taken for up. CT2Hair's own data is in millimetres.

use groom::{UpAxis, Values};

use crate::assemble::{Parts, per_vertex};
use crate::counted_strands::CountedStrands;
use crate::{Format, FormatError, Loaded, ReadOptions, bytes};

/// Bytes of a point: position, direction, label.
const POINT: usize = 28;

pub(crate) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let mut strands = CountedStrands::new(name, bytes, POINT, Format::Ct2Hair)?;
    let count = strands.points();
    let (mut positions, mut tangents) = (Vec::with_capacity(count), Vec::with_capacity(count));
    let mut labels = Vec::with_capacity(count);
    for records in strands.records() {
        positions.extend(bytes::points(records, POINT));
        tangents.extend(records.chunks_exact(POINT).map(|record| bytes::vec3_at(record, 12)));
        labels.extend(records.chunks_exact(POINT).map(|record| bytes::vec3_at(record, 24).x));
    }
    let mut attributes = Vec::new();
    if tangents.iter().any(|&tangent| tangent != glam::Vec3::ZERO) {
        attributes.push(("tangent".to_owned(), per_vertex(Values::Vec3(tangents))));
    }
    if labels.iter().any(|&label| label != 0.0) {
        attributes.push(("label".to_owned(), per_vertex(Values::Float(labels))));
    }
    let parts = Parts {
        file: name,
        format: Format::Ct2Hair,
        up_axis: UpAxis::Y,
        offsets: strands.offsets.clone(),
        positions,
        attributes,
        warnings: std::mem::take(&mut strands.warnings),
    };
    parts.load(options, |point| strands.place(point))
}
