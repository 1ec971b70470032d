//! The contact sheet: the frames of all variants side by side.

use hair_render::{ContactSheet, SheetLayout};

use super::{Finished, Wanted};
use crate::digest::Ingredients;
use crate::expand::Variant;
use crate::schema::{Render, Sheet};
use crate::{Event, Step, StepKind, TurntableError, frame_file, stage};

/// The layout `sheet` asks for, of frames as `render` makes them.
pub(crate) fn layout(sheet: &Sheet, render: &Render) -> SheetLayout {
    let Sheet { columns, gap, labels, .. } = *sheet;
    SheetLayout { cell: (render.width, render.height), columns, gap, labels, caption_lines: 0 }
}

pub(super) fn wanted(variants: &[Variant], frames: &[Step]) -> Option<Wanted> {
    let pipeline = &variants.first()?.pipeline;
    let sheet = pipeline.sheet.as_ref()?;
    let digest = Ingredients::of("sheet").settings(&pipeline.tone).settings(sheet);
    let digest = frames.iter().fold(digest, |digest, frame| digest.digest(&frame.digest)).finish();
    let needs = (0..frames.len()).collect();
    Some(Wanted { variant: None, kind: StepKind::Sheet, output: sheet.file.clone(), digest, needs })
}

pub(super) fn make(step: &Step, finished: &Finished) -> Result<bool, TurntableError> {
    let Some(Variant { pipeline, .. }) = finished.variants.first() else { return Ok(false) };
    let Some(settings) = &pipeline.sheet else { return Ok(false) };
    finished.reporter.event(&Event::Stage("making the contact sheet"));
    let mapping = stage::tone_mapping(&pipeline.tone);
    let count = finished.frames.len() as u32;
    // The pipeline's check keeps sheets far below what cannot be.
    let Some(mut sheet) =
        ContactSheet::new(layout(settings, &pipeline.render), count, background_bytes(&mapping))
    else {
        return Ok(false);
    };
    for (number, frame) in (1..).zip(finished.frames) {
        let picture = frame_file::read_beauty(&finished.output.join(&frame.output))?;
        sheet.place(number, &hair_render::tone_map(&picture, &mapping));
    }
    sheet.finish().write_png(&finished.output.join(&step.output))?;
    Ok(true)
}

/// The background as it comes out of the tone mapping.
fn background_bytes(mapping: &hair_render::ToneMapping) -> [u8; 3] {
    let empty = frame_file::unmeasured((1, 1), vec![glam::Vec3::ZERO], vec![0.0]);
    let rgba = hair_render::tone_map(&empty, mapping).rgba;
    [rgba[0], rgba[1], rgba[2]]
}
