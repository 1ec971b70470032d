//! A groom that moves as Alembic.

use std::io::{Seek, Write};

use ogawa::TimeSampling;

use super::curves::{Clock, CurvesWriter};
use crate::animation::Motion;
use crate::frame_check::FrameCheck;
use crate::{Format, FormatError, Warning, WriteOptions};

/// How far, in frames, times may lie from an even step and still be written as one.
const EVEN: f64 = 1e-9;

pub(crate) fn write_animation(
    motion: Motion<'_>,
    stream: &mut (impl Write + Seek),
    name: &str,
    options: &WriteOptions,
) -> Result<Vec<Warning>, FormatError> {
    let Motion { groom, frames, options: motion } = motion;
    let mut frames = frames.peekable();
    // Whether frames bring velocities shows in the first; an error in it is met in its turn.
    let first = frames.peek().and_then(|frame| frame.as_ref().ok());
    let brings = first.is_some_and(|frame| frame.velocities.is_some());
    let accelerates = first.is_some_and(|frame| frame.accelerations.is_some());
    let mut curves = CurvesWriter::new(groom, stream, name, options, motion.origin, !brings)?;
    let mut times: Vec<f64> = Vec::new();
    let mut check = FrameCheck::new(groom.point_count(), name);
    for frame in frames {
        let frame = frame?;
        check.take(&frame)?;
        curves.positions(&frame.positions)?;
        if let Some(velocities) = &frame.velocities {
            curves.velocities(velocities)?;
        }
        times.push(frame.time);
    }
    check.finish()?;
    let frame_rate = motion.frame_rate;
    let mut warnings = curves.finish(Some(Clock { times: sampling(&times, frame_rate), frame_rate }))?;
    if accelerates {
        let name = "acceleration".to_owned();
        warnings.push(Warning::AttributeLeftOut { format: Format::Alembic, name });
    }
    Ok(warnings)
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
