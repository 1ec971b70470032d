//! How frames are shown: passes weighed, something behind them, tones mapped.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use frame_comp::{Background, Fit, Plate, Weights};
use hair_render::{Backdrop, Frame, Preview, ToneMapping};

use crate::digest::Ingredients;
use crate::expand::Variant;
use crate::schema::Pipeline;
use crate::{TurntableError, stage};

/// What a variant's frames go through before anybody sees them.
pub(super) struct Look {
    pub mapping: ToneMapping,
    pub weights: Weights,
    pub plate: Option<Arc<Background>>,
}

/// Plates by name: variants that share one hold it once.
type Plates = BTreeMap<PathBuf, Arc<Background>>;

impl Look {
    /// Reads the plate, if there is one.
    pub fn of(pipeline: &Pipeline, base: &Path) -> Result<Look, TurntableError> {
        Look::with(pipeline, base, &mut Plates::new())
    }

    /// Those of all variants.
    pub fn all(variants: &[Variant], base: &Path) -> Result<Vec<Look>, TurntableError> {
        let mut plates = Plates::new();
        variants.iter().map(|variant| Look::with(&variant.pipeline, base, &mut plates)).collect()
    }

    fn with(pipeline: &Pipeline, base: &Path, plates: &mut Plates) -> Result<Look, TurntableError> {
        let weights = pipeline.comp.weights.iter().map(|(name, &factor)| (name.as_str(), factor));
        let plate = pipeline.comp.plate.as_ref().map(|plate| plate_at(base.join(plate), plates));
        Ok(Look {
            mapping: stage::tone_mapping(&pipeline.tone),
            weights: Weights::named(weights)?,
            plate: plate.transpose()?,
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
        frame_comp::shown(frame, self.plate.as_deref(), Fit::Fill, &self.mapping)
    }

    /// A frame that was weighed, in sixteen bits; what nothing was put behind stays transparent.
    pub fn shown_deep(&self, frame: &Frame) -> Vec<u16> {
        let mapping = ToneMapping { backdrop: Backdrop::Transparent, ..self.mapping };
        frame_comp::shown_deep(frame, self.plate.as_deref(), Fit::Fill, &mapping)
    }

    /// The background as it comes out of the tone mapping.
    pub fn backdrop(&self) -> [u8; 3] {
        let rgba = hair_render::tone_map(&Frame::empty(1, 1), &self.mapping).rgba;
        [rgba[0], rgba[1], rgba[2]]
    }
}

fn plate_at(path: PathBuf, plates: &mut Plates) -> Result<Arc<Background>, TurntableError> {
    if let Some(known) = plates.get(&path) {
        return Ok(Arc::clone(known));
    }
    let plate = Arc::new(Background::Plate(Plate::read(&path)?));
    plates.insert(path, Arc::clone(&plate));
    Ok(plate)
}
