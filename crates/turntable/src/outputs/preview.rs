//! A frame as a PNG, beside its EXR.

use super::look::Look;
use super::{Asked, Finished, Wanted};
use crate::digest::Ingredients;
use crate::{State, Step, StepKind, TurntableError};

pub(super) fn wanted(asked: &Asked) -> Result<Vec<Wanted>, TurntableError> {
    let mut wanted = Vec::new();
    for (index, frame) in asked.frames.iter().enumerate() {
        let StepKind::Frame { number, .. } = frame.kind else { continue };
        let Some(variant) = frame.variant.and_then(|v| asked.variants.get(v)) else { continue };
        if !variant.pipeline.tone.frames || frame.state == State::NotAsked {
            continue;
        }
        let digest = Look::added(Ingredients::of("preview"), &variant.pipeline, asked.base)?;
        wanted.push(Wanted {
            variant: frame.variant,
            kind: StepKind::Preview { number },
            output: frame.output.with_extension("png"),
            digest: digest.digest(&frame.digest).finish(),
            needs: vec![index],
        });
    }
    Ok(wanted)
}

pub(super) fn make(step: &Step, finished: &Finished) -> Result<bool, TurntableError> {
    let Some(variant) = step.variant.and_then(|index| finished.variants.get(index)) else { return Ok(false) };
    let look = Look::of(&variant.pipeline, finished.base)?;
    let path = finished.output.join(&step.output);
    look.shown(&look.read(&path.with_extension("exr"))?).write_png(&path)?;
    Ok(true)
}
