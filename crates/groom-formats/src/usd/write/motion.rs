//! Frames, put aside one after the other.

use glam::Vec3;
use usd_layer::write::WriteError;

use crate::animation::Motion;
use crate::usd::write::array::{Array, Rows, Shape};
use crate::usd::write::curves::Curves;
use crate::usd::write::extent;
use crate::usd::write::primvars::widths;
use crate::usd::write::sink::Sink;
use crate::usd::write::stage::Samples;
use crate::{Format, FormatError, Frame};

/// Gives every frame to `sink`; one is in memory at a time.
pub(super) fn store<S: Sink>(
    sink: &mut S,
    curves: &Curves<'_>,
    motion: Motion<'_>,
    format: Format,
    file: &str,
) -> Result<Samples<S::Stored>, FormatError> {
    let Motion { frames, frame_rate, .. } = motion;
    if !(frame_rate.is_finite() && frame_rate > 0.0) {
        let expected = "a finite number over 0";
        return Err(FormatError::invalid(file, "frame rate", frame_rate.to_string(), expected));
    }
    let mut samples = Samples {
        frame_rate,
        range: (0.0, 0.0),
        points: Vec::new(),
        extents: Vec::new(),
        velocities: Vec::new(),
    };
    let failed = |e: WriteError| super::failed(e, format, file);
    for frame in frames {
        let frame = frame?;
        check(&frame, curves, &samples, file)?;
        let time = frame.time;
        let points = array(curves, &frame.positions);
        let widths = widths(curves);
        extent::refuse_too_wide(&points, &widths, format, file)?;
        samples.points.push((time, sink.store(&points).map_err(failed)?));
        let corners = extent::of(&points, &widths);
        let corners = Array { curves, rows: Rows::Float3s(&corners), shape: Shape::FIXED };
        samples.extents.push((time, sink.store(&corners).map_err(failed)?));
        if let Some(velocities) = &frame.velocities {
            let stored = sink.store(&array(curves, velocities)).map_err(failed)?;
            samples.velocities.push((time, stored));
        }
    }
    match &samples.points[..] {
        [] => Err(FormatError::invalid(file, "frames", "none", "at least one")),
        [first, .., last] => Ok(Samples { range: (first.0, last.0), ..samples }),
        [only] => Ok(Samples { range: (only.0, only.0), ..samples }),
    }
}

fn array<'a>(curves: &'a Curves<'a>, values: &'a [Vec3]) -> Array<'a> {
    Array { curves, rows: Rows::Float3s(bytemuck::cast_slice(values)), shape: Shape::points() }
}

/// Refuses what would not make an animation.
fn check<S>(frame: &Frame, curves: &Curves<'_>, before: &Samples<S>, file: &str) -> Result<(), FormatError> {
    let number = before.points.len();
    let fault = |what: &str, found: String, expected: String| {
        Err(FormatError::invalid(file, format!("{what} of frame {number}"), found, expected))
    };
    if !frame.time.is_finite() {
        return fault("time", frame.time.to_string(), "a finite number".to_owned());
    }
    if let Some((last, _)) = before.points.last().filter(|(last, _)| frame.time <= *last) {
        return fault("time", frame.time.to_string(), format!("more than {last}, that of the frame before"));
    }
    let points = curves.groom.point_count();
    let with_velocities = number == before.velocities.len();
    if number > 0 && frame.velocities.is_some() != with_velocities {
        let words = |some| if some { "some" } else { "none" }.to_owned();
        return fault("velocities", words(!with_velocities), words(with_velocities) + ", as before");
    }
    let arrays = [("position", Some(&frame.positions)), ("velocity", frame.velocities.as_ref())];
    for (what, values) in arrays.into_iter().filter_map(|(what, values)| Some((what, values?))) {
        if values.len() != points {
            let found = format!("{} values", values.len());
            return fault(what, found, format!("{points}, one a point of the groom"));
        }
        if let Some(vertex) = values.iter().position(|value| !value.is_finite()) {
            let found = format!("{} at point {vertex}", values[vertex]);
            return fault(what, found, "finite numbers".to_owned());
        }
    }
    Ok(())
}
