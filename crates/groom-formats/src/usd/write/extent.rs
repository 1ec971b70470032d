//! The bounds of curves.

use crate::usd::write::array::{Array, Rows};
use crate::{Format, FormatError};

/// Bounds of `points` grown by half the largest of `widths`, as UsdGeomCurves computes it.
pub(super) fn of(points: &Array<'_>, widths: &Array<'_>) -> [[f32; 3]; 2] {
    let (mut min, mut max) = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    if let Rows::Float3s(values) = points.rows {
        points.each(values, 0..points.items(), |_, point| {
            for axis in 0..3 {
                min[axis] = min[axis].min(point[axis]);
                max[axis] = max[axis].max(point[axis]);
            }
        });
    }
    let radius = 0.5 * largest(widths);
    [min.map(|v| v - radius), max.map(|v| v + radius)]
}

/// The largest width.
pub(super) fn largest(widths: &Array<'_>) -> f32 {
    let mut largest = 0.0_f32;
    if let Rows::Floats(values) = widths.rows {
        widths.each(values, 0..widths.items(), |_, width| largest = largest.max(width));
    }
    largest
}

/// Widths and the extent must be finite too, or the file would hold `inf`.
pub(super) fn refuse_too_wide(
    points: &Array<'_>,
    widths: &Array<'_>,
    format: Format,
    file: &str,
) -> Result<(), FormatError> {
    let corners = of(points, widths);
    let finite = corners.iter().flatten().all(|v| v.is_finite()) && largest(widths).is_finite();
    if finite && points.curves.groom.meters_per_unit.is_finite() {
        return Ok(());
    }
    let what = "holds widths and an extent, and this groom's leave 32-bit floats";
    Err(FormatError::Unsupported { file: file.to_owned(), format, what })
}
