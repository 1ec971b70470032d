//! A groom that moves as Alembic.

use std::io::{Seek, Write};

use glam::Vec3;
use ogawa::TimeSampling;

use super::curves::{Clock, CurvesWriter};
use crate::animation::Motion;
use crate::{FormatError, Frame, Warning, WriteOptions};

/// How far, in frames, times may lie from an even step and still be written as one.
const EVEN: f64 = 1e-9;

pub(crate) fn write_animation(
    motion: Motion<'_>,
    stream: &mut (impl Write + Seek),
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let Motion { groom, frames, frame_rate } = motion;
    if !(frame_rate.is_finite() && frame_rate > 0.0) {
        let expected = "a positive number of frames a second";
        return Err(FormatError::invalid(name, "frame rate", frame_rate.to_string(), expected));
    }
    let mut frames = frames.peekable();
    // Whether frames bring velocities shows in the first; an error in it is met in its turn.
    let brings = matches!(frames.peek(), Some(Ok(frame)) if frame.velocities.is_some());
    let mut curves = CurvesWriter::new(groom, stream, name, options, !brings)?;
    let mut times: Vec<f64> = Vec::new();
    for frame in frames {
        let frame = frame?;
        check(&frame, times.last().copied(), groom.point_count(), brings).map_err(
            |(place, found, expected)| {
                FormatError::invalid(name, format!("frame {}{place}", times.len()), found, expected)
            },
        )?;
        curves.positions(&frame.positions)?;
        if let Some(velocities) = &frame.velocities {
            curves.velocities(velocities)?;
        }
        times.push(frame.time);
    }
    if times.is_empty() {
        return Err(FormatError::invalid(name, "frames", "none", "one or more"));
    }
    curves.finish(Some(Clock { times: sampling(&times, frame_rate), frame_rate }))
}

/// Place, found and expected of what is wrong with a frame.
type Fault = (String, String, String);

fn check(frame: &Frame, before: Option<f64>, points: usize, velocities: bool) -> Result<(), Fault> {
    let fault = |place: &str, found: String, expected: &str| Err((place.into(), found, expected.into()));
    if !frame.time.is_finite() || before.is_some_and(|before| frame.time <= before) {
        let expected = before.map_or("a finite number".into(), |before| format!("a number over {before}"));
        return fault(", time", frame.time.to_string(), &expected);
    }
    if frame.velocities.is_some() != velocities {
        let words = |there| if there { "there" } else { "missing" };
        return fault(", velocities", words(!velocities).into(), words(velocities));
    }
    let arrays = [(", positions", Some(&frame.positions)), (", velocities", frame.velocities.as_ref())];
    for (place, array) in arrays {
        let Some(array) = array else { continue };
        if array.len() != points {
            return fault(place, array.len().to_string(), &format!("{points}, as many as the groom has"));
        }
        if let Some(point) = array.iter().position(|v: &Vec3| !v.is_finite()) {
            let place = format!("{place}, point {point}");
            return fault(&place, array[point].to_string(), "finite numbers");
        }
    }
    Ok(())
}

/// Even times as a step, others as a list.
fn sampling(times: &[f64], frame_rate: f64) -> TimeSampling {
    let (first, last) = (times[0], times[times.len() - 1]);
    let step = if times.len() > 1 { (last - first) / (times.len() - 1) as f64 } else { 1.0 };
    let even =
        |(i, time): (usize, &f64)| (first + step * i as f64 - time).abs() <= EVEN * time.abs().max(1.0);
    if times.iter().enumerate().all(even) {
        return TimeSampling::uniform(step / frame_rate, first / frame_rate);
    }
    TimeSampling::acyclic(times.iter().map(|time| time / frame_rate).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn even_times_are_a_step_and_others_a_list() {
        let even = sampling(&[1.0, 1.5, 2.0], 25.0);
        assert_eq!((even.seconds_per_cycle, even.times), (Some(0.02), vec![0.04]));
        let one = sampling(&[7.0], 24.0);
        assert_eq!((one.seconds_per_cycle, one.time(0)), (Some(1.0 / 24.0), Some(7.0 / 24.0)));
        assert_eq!(sampling(&[0.0, 1.0, 4.0], 2.0), TimeSampling::acyclic(vec![0.0, 0.5, 2.0]));
    }
}
