//! Frames, put aside one after the other.

use glam::Vec3;
use usd_layer::write::WriteError;

use crate::animation::Motion;
use crate::frame_check::FrameCheck;
use crate::usd::write::array::{Array, Rows, Shape};
use crate::usd::write::curves::Curves;
use crate::usd::write::extent;
use crate::usd::write::primvars::widths;
use crate::usd::write::sink::Sink;
use crate::usd::write::stage::Samples;
use crate::{Format, FormatError};

/// Gives every frame to `sink`; one is in memory at a time.
pub(super) fn store<S: Sink>(
    sink: &mut S,
    curves: &Curves<'_>,
    motion: Motion<'_>,
    format: Format,
    file: &str,
) -> Result<Samples<S::Stored>, FormatError> {
    let Motion { frames, options, .. } = motion;
    let mut samples = Samples {
        frame_rate: options.frame_rate,
        range: (0.0, 0.0),
        points: Vec::new(),
        extents: Vec::new(),
        velocities: Vec::new(),
        accelerations: Vec::new(),
    };
    let failed = |e: WriteError| super::failed(e, format, file);
    let mut check = FrameCheck::new(curves.groom.point_count(), file);
    for frame in frames {
        let frame = frame?;
        check.take(&frame)?;
        let time = frame.time;
        let points = array(curves, &frame.positions);
        let widths = widths(curves);
        extent::refuse_too_wide(&points, &widths, format, file)?;
        samples.points.push((time, sink.store(&points).map_err(failed)?));
        let corners = extent::of(&points, &widths);
        let corners = Array { curves, rows: Rows::Float3s(&corners), shape: Shape::FIXED };
        samples.extents.push((time, sink.store(&corners).map_err(failed)?));
        for (values, stored) in
            [(&frame.velocities, &mut samples.velocities), (&frame.accelerations, &mut samples.accelerations)]
        {
            if let Some(values) = values {
                stored.push((time, sink.store(&array(curves, values)).map_err(failed)?));
            }
        }
    }
    check.finish()?;
    if let (Some(first), Some(last)) = (samples.points.first(), samples.points.last()) {
        samples.range = (first.0, last.0);
    }
    Ok(samples)
}

fn array<'a>(curves: &'a Curves<'a>, values: &'a [Vec3]) -> Array<'a> {
    Array { curves, rows: Rows::Float3s(bytemuck::cast_slice(values)), shape: Shape::points() }
}
