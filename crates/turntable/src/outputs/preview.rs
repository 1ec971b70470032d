//! A frame as a PNG, beside its EXR.

use super::{Finished, Wanted};
use crate::digest::Ingredients;
use crate::expand::Variant;
use crate::{State, Step, StepKind, TurntableError, frame_file, stage};

pub(super) fn wanted(variants: &[Variant], frames: &[Step]) -> Vec<Wanted> {
    let of = |(index, frame): (usize, &Step)| {
        let StepKind::Frame { number, .. } = frame.kind else { return None };
        let tone = &variants[frame.variant?].pipeline.tone;
        let is_wanted = tone.frames && frame.state != State::NotAsked;
        is_wanted.then(|| Wanted {
            variant: frame.variant,
            kind: StepKind::Preview { number },
            output: frame.output.with_extension("png"),
            digest: Ingredients::of("preview").settings(tone).digest(&frame.digest).finish(),
            needs: vec![index],
        })
    };
    frames.iter().enumerate().filter_map(of).collect()
}

pub(super) fn make(step: &Step, finished: &Finished) -> Result<bool, TurntableError> {
    let Some(variant) = step.variant.and_then(|index| finished.variants.get(index)) else { return Ok(false) };
    let path = finished.output.join(&step.output);
    let frame = frame_file::read_beauty(&path.with_extension("exr"))?;
    hair_render::tone_map(&frame, &stage::tone_mapping(&variant.pipeline.tone)).write_png(&path)?;
    Ok(true)
}
