//! The contact sheet: the frames of all variants side by side.

use hair_render::{ContactSheet, SheetLayout};

use super::look::Look;
use super::{Asked, Finished, Wanted, facts};
use crate::digest::Ingredients;
use crate::expand::Variant;
use crate::schema::{Caption, Render, Sheet};
use crate::{Event, Step, StepKind, TurntableError};

/// The layout `sheet` asks for, of frames as `render` makes them.
pub(crate) fn layout(sheet: &Sheet, render: &Render) -> SheetLayout {
    let Sheet { columns, gap, labels, .. } = *sheet;
    let named = sheet.captions.contains(&Caption::Variant);
    let figures = sheet.captions.iter().any(|caption| *caption != Caption::Variant);
    let caption_lines = u32::from(named) + u32::from(figures);
    SheetLayout { cell: (render.width, render.height), columns, gap, labels, caption_lines }
}

/// The layout for all variants: cells in which the largest of their frames has room; where nothing else is said, a
/// row for every variant, or, of variants with one frame, a row for all settings of the last axis.
fn layout_of(sheet: &Sheet, variants: &[Variant], frames: usize) -> Option<SheetLayout> {
    let first = variants.first()?;
    let mut layout = layout(sheet, &first.pipeline.render);
    for Variant { pipeline, .. } in variants {
        layout.cell = (layout.cell.0.max(pipeline.render.width), layout.cell.1.max(pipeline.render.height));
    }
    if layout.columns.is_none() && variants.len() > 1 {
        let last = |variant: &Variant| variant.axes.last().cloned();
        let settings = variants.iter().map(last).collect::<std::collections::BTreeSet<_>>().len();
        let each = frames / variants.len();
        layout.columns = u32::try_from(if each > 1 { each } else { settings }).ok();
    }
    Some(layout)
}

pub(super) fn wanted(asked: &Asked) -> Result<Option<Wanted>, TurntableError> {
    let Some(sheet) = asked.variants.first().and_then(|v| v.pipeline.sheet.as_ref()) else { return Ok(None) };
    let mut digest = Ingredients::of("sheet").settings(sheet);
    for Variant { id, pipeline, .. } in asked.variants {
        digest = Look::added(digest, pipeline, asked.base)?;
        if sheet.captions.contains(&Caption::Variant) {
            digest = digest.word(id);
        }
    }
    let digest = asked.frames.iter().fold(digest, |digest, frame| digest.digest(&frame.digest)).finish();
    let needs = (0..asked.frames.len()).collect();
    Ok(Some(Wanted { variant: None, kind: StepKind::Sheet, output: sheet.file.clone(), digest, needs }))
}

pub(super) fn make(step: &Step, finished: &Finished) -> Result<bool, TurntableError> {
    let Some(Variant { pipeline, .. }) = finished.variants.first() else { return Ok(false) };
    let Some(settings) = &pipeline.sheet else { return Ok(false) };
    finished.reporter.event(&Event::Stage("making the contact sheet"));
    let looks = Look::all(finished.variants, finished.base)?;
    let backdrop = looks.first().map_or([0; 3], Look::backdrop);
    let count = finished.frames.len();
    // The pipeline's check keeps sheets far below what cannot be.
    let Some(mut sheet) = layout_of(settings, finished.variants, count)
        .and_then(|layout| ContactSheet::new(layout, u32::try_from(count).ok()?, backdrop))
    else {
        return Ok(false);
    };
    let mut strange = None;
    for (cell, frame) in (1..).zip(finished.frames) {
        let variant =
            frame.variant.and_then(|index| Some((finished.variants.get(index)?, looks.get(index)?)));
        let (Some((variant, look)), StepKind::Frame { number, .. }) = (variant, frame.kind) else { continue };
        let path = finished.output.join(&frame.output);
        sheet.place_labelled(cell, number, &look.shown(&look.read(&path)?));
        let lines = facts::lines(&settings.captions, variant, number, &path);
        if let Some(letter) = sheet.caption(cell, &lines.iter().map(String::as_str).collect::<Vec<_>>()) {
            strange = strange.or_else(|| Some((letter, variant.id.clone())));
        }
    }
    if let Some((letter, name)) = strange {
        let words = format!("the sheet's letters are those of Latin-1: `{letter}` of `{name}` shows as `?`");
        finished.reporter.event(&Event::Warning(&words));
    }
    sheet.finish().write_png(&finished.output.join(&step.output))?;
    Ok(true)
}
