//! Films of a variant's frames, where there is an ffmpeg.

use std::path::Path;

use hair_render::Frame;
use video_encode::{Codec as Packing, Ffmpeg, Film, FilmSettings, FrameRate, Picture};

use super::look::Look;
use super::{Asked, Finished, Wanted};
use crate::digest::Ingredients;
use crate::expand::Variant;
use crate::schema::{Codec, Video};
use crate::{Event, Step, StepKind, TurntableError};

/// How the film is packed: what is said, else what its ending means.
fn packing(video: &Video) -> Packing {
    let is_mov = video.file.extension().is_some_and(|e| e.eq_ignore_ascii_case("mov"));
    match (video.codec, is_mov) {
        (Some(Codec::Prores4444), _) | (None, true) => Packing::ProRes4444,
        (Some(Codec::H264), _) | (None, false) => Packing::H264 { crf: video.crf },
    }
}

pub(super) fn wanted(asked: &Asked) -> Result<Vec<Wanted>, TurntableError> {
    let mut wanted = Vec::new();
    for (place, Variant { id, pipeline, .. }) in asked.variants.iter().enumerate() {
        let frames = asked.frames.iter().enumerate().filter(|(_, frame)| frame.variant == Some(place));
        let needs: Vec<usize> = frames.map(|(index, _)| index).collect();
        for (index, video) in pipeline.video.iter().enumerate() {
            let digest = Look::added(Ingredients::of("video"), pipeline, asked.base)?;
            let crf = matches!(packing(video), Packing::H264 { .. }).then_some(video.crf);
            let digest = digest.settings(&(video.codec, video.fps, crf)).word(&ending(&video.file));
            let frames = needs.iter().filter_map(|&frame| asked.frames.get(frame));
            let digest = frames.fold(digest, |digest, frame| digest.digest(&frame.digest)).finish();
            let kind = StepKind::Video { index };
            let output = Path::new(id).join(&video.file);
            wanted.push(Wanted { variant: Some(place), kind, output, digest, needs: needs.clone() });
        }
    }
    Ok(wanted)
}

fn ending(file: &Path) -> String {
    file.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

pub(super) fn make(step: &Step, index: usize, finished: &Finished) -> Result<bool, TurntableError> {
    let variant = step.variant.and_then(|place| finished.variants.get(place));
    let Some((variant, video)) = variant.and_then(|v| Some((v, v.pipeline.video.get(index)?))) else {
        return Ok(false);
    };
    let path = finished.output.join(&step.output);
    let Some(ffmpeg) = Ffmpeg::find() else {
        if video.required {
            return Err(TurntableError::NoFfmpeg { path });
        }
        let words = format!("{}: left out, there is no ffmpeg in $FFMPEG or in PATH", path.display());
        finished.reporter.event(&Event::Warning(&words));
        return Ok(false);
    };
    finished.reporter.event(&Event::Stage("making the film"));
    let look = Look::of(&variant.pipeline, finished.base)?;
    let mut film: Option<Film> = None;
    for frame in finished.frames.iter().filter(|frame| frame.variant == step.variant) {
        if finished.reporter.cancelled() {
            return Err(TurntableError::Interrupted);
        }
        let frame = look.read(&finished.output.join(&frame.output))?;
        let film = match &mut film {
            Some(film) => film,
            None => film.insert(begin(&ffmpeg, &path, video, &frame)?),
        };
        match packing(video) {
            Packing::H264 { .. } => film.push(Picture::Rgba8(&look.shown(&frame).rgba))?,
            Packing::ProRes4444 => film.push(Picture::Rgba16(&look.shown_deep(&frame)))?,
        }
    }
    let Some(film) = film else { return Ok(false) };
    film.finish()?;
    Ok(true)
}

fn begin(ffmpeg: &Ffmpeg, path: &Path, video: &Video, frame: &Frame) -> Result<Film, TurntableError> {
    let settings = FilmSettings {
        width: frame.width,
        height: frame.height,
        rate: FrameRate::new(video.fps)?,
        codec: packing(video),
        comment: None,
    };
    Ok(Film::begin(ffmpeg, path, settings)?)
}
