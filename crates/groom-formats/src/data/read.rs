//! USC hair data as a groom.

use groom::UpAxis;

use crate::assemble::Parts;
use crate::bytes;
use crate::counted_strands::CountedStrands;
use crate::{Format, FormatError, Loaded, ReadOptions};

/// Bytes of a point: three floats.
const POINT: usize = 12;

pub(crate) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let mut strands = CountedStrands::new(name, bytes, POINT, Format::Data)?;
    let mut positions = Vec::with_capacity(strands.points());
    for records in strands.records() {
        positions.extend(bytes::points(records, POINT));
    }
    let parts = Parts {
        file: name,
        format: Format::Data,
        up_axis: UpAxis::Y,
        offsets: strands.offsets.clone(),
        positions,
        attributes: Vec::new(),
        warnings: std::mem::take(&mut strands.warnings),
    };
    parts.load(options, |point| strands.place(point))
}
