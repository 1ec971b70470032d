//! How frames are shown: passes weighed, something behind them, tones mapped.

use std::path::Path;

use frame_comp::{Background, Fit, Plate, Weights};
use hair_render::{Backdrop, Frame, Preview, ToneMapping};

use crate::digest::Ingredients;
use crate::schema::Pipeline;
use crate::{TurntableError, stage};

/// What a variant's frames go through before anybody sees them.
pub(super) struct Look {
    pub mapping: ToneMapping,
    pub weights: Weights,
    pub plate: Option<Background>,
}

impl Look {
    /// Reads the plate, if there is one.
    pub fn of(pipeline: &Pipeline, base: &Path) -> Result<Look, TurntableError> {
        let weights = pipeline.comp.weights.iter().map(|(name, &factor)| (name.as_str(), factor));
        let plate = pipeline.comp.plate.as_ref().map(|plate| Plate::read(&base.join(plate))).transpose()?;
        Ok(Look {
            mapping: stage::tone_mapping(&pipeline.tone),
            weights: Weights::named(weights)?,
            plate: plate.map(Background::Plate),
        })
    }

    /// What it depends on beside the frame.
    pub fn added(
        digest: Ingredients,
        pipeline: &Pipeline,
        base: &Path,
    ) -> Result<Ingredients, TurntableError> {
        let digest = digest.settings(&pipeline.tone).settings(&pipeline.comp.weights);
        match &pipeline.comp.plate {
            Some(plate) => digest.file(&base.join(plate)),
            None => Ok(digest),
        }
    }

    /// A frame with its passes as they are weighed.
    pub fn read(&self, path: &Path) -> Result<Frame, TurntableError> {
        let (frame, _) = Frame::read_exr(path)?;
        let is_weighed = self.weights.changed().next().is_some();
        Ok(if is_weighed { frame_comp::reweigh(&frame, &self.weights)? } else { frame })
    }

    /// A frame that was weighed, in eight bits.
    pub fn shown(&self, frame: &Frame) -> Preview {
        frame_comp::shown(frame, self.plate.as_ref(), Fit::Fill, &self.mapping)
    }

    /// A frame that was weighed, in sixteen bits; what nothing was put behind stays transparent.
    pub fn shown_deep(&self, frame: &Frame) -> Vec<u16> {
        let mapping = ToneMapping { backdrop: Backdrop::Transparent, ..self.mapping };
        frame_comp::shown_deep(frame, self.plate.as_ref(), Fit::Fill, &mapping)
    }

    /// The background as it comes out of the tone mapping.
    pub fn backdrop(&self) -> [u8; 3] {
        let rgba = hair_render::tone_map(&Frame::empty(1, 1), &self.mapping).rgba;
        [rgba[0], rgba[1], rgba[2]]
    }
}
