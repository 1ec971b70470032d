//! A checkpoint written to an OpenEXR file that any viewer shows.

use std::path::Path;

use exr::block::lines::LineRefMut;
use exr::image::write::samples::{SamplesWriter, WritableSamples};
use exr::math::RoundingMode;
use exr::meta::attribute::{LevelMode, SampleType};
use exr::meta::header::Header;
use exr::prelude as openexr;
use openexr::{AnyChannel, AttributeValue};

use crate::checkpoint_layers::{Layer, VERSION, layers};
use crate::exr_file::{put_figures, text, write_layer};
use crate::sums::{TILE, TileSums, split};
use crate::{Aov, Checkpoint, FrameReport, RenderError};

impl Checkpoint {
    /// Writes the checkpoint whole or not at all.
    ///
    /// # Errors
    /// [`RenderError::Io`] or [`RenderError::Encode`]; the old file, if any, is then untouched.
    pub fn write(&self, path: &Path) -> Result<(), RenderError> {
        let aovs: Vec<Aov> = self.aovs.iter().collect();
        let across = self.window.width.div_ceil(TILE) as usize;
        let channel = |(name, layer): (String, Layer)| {
            let samples = Samples { checkpoint: self, layer, across, passes: aovs.len() };
            AnyChannel::new(name.as_str(), samples)
        };
        let mut attributes = openexr::LayerAttributes::default();
        let mut put = |key: &str, value: AttributeValue| {
            attributes.other.insert(text(key), value);
        };
        put("checkpoint", AttributeValue::I32(VERSION));
        put("digest", AttributeValue::Text(text(&self.digest)));
        put("sppAsked", AttributeValue::F64(self.spp_asked.into()));
        put("sumsCheck", AttributeValue::Text(text(&self.checksum())));
        put_figures(&mut attributes, &self.figures());
        let channels = layers(&aovs).into_iter().map(channel).collect();
        let size = [self.window.width, self.window.height];
        write_layer(path, attributes, channels, size, self.window.cutout(self.size[0], self.size[1]))
    }

    fn figures(&self) -> FrameReport {
        FrameReport {
            seconds: self.seconds,
            spp: self.spp(),
            seed: self.seed,
            threads: self.threads,
            closest_rays: self.tally.rays.closest,
            shadow_rays: self.tally.rays.shadow,
            rejected_samples: self.tally.rejected,
            motion: self.motion.clone(),
            ..FrameReport::default()
        }
    }
}

/// One channel of a checkpoint, as the encoder takes it: row by row, without a copy of the whole.
#[derive(Clone, Copy)]
struct Samples<'a> {
    checkpoint: &'a Checkpoint,
    layer: Layer,
    /// Tiles across.
    across: usize,
    passes: usize,
}

impl Samples<'_> {
    fn tile(&self, x: usize, y: usize) -> (&TileSums, usize) {
        let edge = TILE as usize;
        let width = edge.min(self.checkpoint.window.width as usize - x / edge * edge);
        (&self.checkpoint.tiles[y / edge * self.across + x / edge], y % edge * width + x % edge)
    }

    fn float(&self, x: usize, y: usize) -> f32 {
        let (tile, at) = self.tile(x, y);
        match self.layer {
            Layer::Beauty { color } => tile.develop(at).beauty[color],
            Layer::Alpha => tile.develop(at).alpha,
            Layer::Half { half, color, part } => split(tile.halves[at][half][color])[part],
            Layer::Pass { pass, color, part } => split(tile.parts[at * self.passes + pass][color])[part],
            Layer::Covered | Layer::Spp => 0.0,
        }
    }

    fn whole(&self, x: usize, y: usize) -> u32 {
        let (tile, at) = self.tile(x, y);
        if self.layer == Layer::Covered { tile.covered[at] } else { tile.spp }
    }
}

impl<'s> WritableSamples<'s> for Samples<'_> {
    type Writer = Self;

    fn sample_type(&self) -> SampleType {
        self.layer.kind()
    }

    fn infer_level_modes(&self) -> (LevelMode, RoundingMode) {
        (LevelMode::Singular, RoundingMode::Down)
    }

    fn create_samples_writer(&'s self, _header: &Header) -> Self {
        *self
    }
}

impl SamplesWriter for Samples<'_> {
    fn extract_line(&self, line: LineRefMut<'_>) {
        let (x, y) = (line.location.position.x(), line.location.position.y());
        // Writing to memory of the right length cannot fail.
        let _ = match self.layer.kind() {
            SampleType::U32 => line.write_samples(|i| self.whole(x + i, y)),
            _ => line.write_samples(|i| self.float(x + i, y)),
        };
    }
}
