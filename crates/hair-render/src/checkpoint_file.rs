//! A checkpoint as an OpenEXR file that any viewer shows.
//!
//! `R`, `G`, `B`, `A` are the picture so far. The sums are further layers, of 32 bits a sample: `sum.0.R` and
//! `sum.1.R` of the beauty's two halves, `sum.TT.R` of a pass, each with what `.low.R` adds to it; `sum.covered`
//! and `sum.spp` are whole numbers. `sumsCheck` is a checksum over all of it: blocks of noise are stored as they
//! are, without one of their own.

use std::path::Path;

use exr::block::lines::LineRefMut;
use exr::image::write::samples::{SamplesWriter, WritableSamples};
use exr::math::RoundingMode;
use exr::meta::attribute::{LevelMode, SampleType};
use exr::meta::header::Header;
use exr::prelude as openexr;
use openexr::{AnyChannel, AttributeValue};

use crate::checkpoint::tile_sizes;
use crate::exr_file::{put_figures, text, write_layer};
use crate::exr_read::{Opened, Unreadable, floats, wholes, with_file};
use crate::frame_header::motion;
use crate::path::RayCounts;
use crate::sums::{TILE, Tally, TileSums, split};
use crate::{Aov, AovSet, Checkpoint, FrameReport, PASS_SPP, RenderError};

/// Changes whenever the layers mean something else.
const VERSION: i32 = 1;

const COLORS: [&str; 3] = ["R", "G", "B"];

/// What a channel holds. A colour is red 0, green 1, blue 2; the part of a sum is high 0, low 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Layer {
    Beauty { color: usize },
    Alpha,
    Half { half: usize, color: usize, part: usize },
    Pass { pass: usize, color: usize, part: usize },
    Covered,
    Spp,
}

/// All channels of a checkpoint that keeps these passes.
fn layers(aovs: &[Aov]) -> Vec<(String, Layer)> {
    let mut layers = vec![
        ("A".to_owned(), Layer::Alpha),
        ("sum.covered".to_owned(), Layer::Covered),
        ("sum.spp".to_owned(), Layer::Spp),
    ];
    for (color, name) in COLORS.into_iter().enumerate() {
        layers.push((name.to_owned(), Layer::Beauty { color }));
        for (part, low) in ["", "low."].into_iter().enumerate() {
            for half in 0..2 {
                layers.push((format!("sum.{half}.{low}{name}"), Layer::Half { half, color, part }));
            }
            for (pass, aov) in aovs.iter().enumerate() {
                layers.push((format!("sum.{}.{low}{name}", aov.name()), Layer::Pass { pass, color, part }));
            }
        }
    }
    layers
}

fn kind(layer: Layer) -> SampleType {
    if matches!(layer, Layer::Covered | Layer::Spp) { SampleType::U32 } else { SampleType::F32 }
}

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
        put("sumsCheck", AttributeValue::Text(text(&format!("{:016x}", self.checksum()))));
        put_figures(&mut attributes, &self.figures());
        let channels = layers(&aovs).into_iter().map(channel).collect();
        let size = [self.window.width, self.window.height];
        write_layer(path, attributes, channels, size, self.window.cutout(self.size[0], self.size[1]))
    }

    /// Reads a checkpoint and checks all of it.
    ///
    /// # Errors
    /// [`RenderError::Io`], or [`RenderError::InvalidPicture`] for what is no checkpoint, or damaged.
    pub fn read(path: &Path) -> Result<Checkpoint, RenderError> {
        with_file(path, read)
    }

    fn figures(&self) -> FrameReport {
        FrameReport {
            seconds: self.seconds,
            spp: self.spp(),
            seed: self.seed,
            threads: self.threads,
            samples: 0,
            closest_rays: self.tally.rays.closest,
            shadow_rays: self.tally.rays.shadow,
            rejected_samples: self.tally.rejected,
            rel_mse: None,
            relative_error: None,
            motion: self.motion.clone(),
        }
    }

    /// Of the sums and of what they are sums of.
    fn checksum(&self) -> u64 {
        let mut sum = Check(0);
        self.digest.bytes().for_each(|byte| sum.add(byte.into()));
        let Checkpoint { window, tally, .. } = self;
        for value in [window.x, window.y, window.width, window.height, self.spp_asked] {
            sum.add(value.into());
        }
        for value in
            [self.seed, tally.rays.closest, tally.rays.shadow, tally.rejected, self.seconds.to_bits()]
        {
            sum.add(value);
        }
        for tile in &self.tiles {
            sum.add(tile.spp.into());
            tile.covered.iter().for_each(|&covered| sum.add(covered.into()));
            let sums = tile.halves.iter().flatten().chain(&tile.parts);
            sums.flat_map(|sum| sum.to_array()).for_each(|value| sum.add(value.to_bits()));
        }
        sum.0
    }
}

/// A checksum: any change of a single value changes it, and so do nearly all others.
struct Check(u64);

impl Check {
    fn add(&mut self, value: u64) {
        let mixed = (self.0.rotate_left(23) ^ value).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        self.0 = mixed ^ (mixed >> 29);
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
        kind(self.layer)
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
        let _ = match kind(self.layer) {
            SampleType::U32 => line.write_samples(|i| self.whole(x + i, y)),
            _ => line.write_samples(|i| self.float(x + i, y)),
        };
    }
}

fn read(opened: Opened) -> Result<Checkpoint, Unreadable> {
    let mut checkpoint = empty(&opened)?;
    let attributes = opened.attributes();
    let figures = Figures {
        spp: attributes.needed("spp", 0.0..=f64::from(u32::MAX))?,
        check: attributes.text("sumsCheck").unwrap_or_default(),
    };
    let aovs: Vec<Aov> = checkpoint.aovs.iter().collect();
    let expected = layers(&aovs);
    let channels = opened.channels();
    let mut targets = Vec::with_capacity(channels.len());
    for (name, found) in &channels {
        let layer = expected.iter().find(|(own, _)| own == name).map(|(_, layer)| *layer);
        let layer = layer.ok_or_else(|| format!("channel `{name}` is none of a checkpoint's"))?;
        if *found != kind(layer) || targets.contains(&layer) {
            return Err(
                format!("channel `{name}` is {found:?} or there twice, expected {:?}", kind(layer)).into()
            );
        }
        targets.push(layer);
    }
    if let Some((missing, _)) = expected.iter().find(|(_, layer)| !targets.contains(layer)) {
        return Err(format!("there is no channel `{missing}`").into());
    }
    let edge = TILE as usize;
    let (width, across) = (checkpoint.window.width as usize, checkpoint.window.width.div_ceil(TILE) as usize);
    let passes = aovs.len();
    let tiles = &mut checkpoint.tiles;
    let mut torn = false;
    opened.lines(|channel, row, bytes| {
        let place = |x: usize| {
            let tile_width = edge.min(width - x / edge * edge);
            (row / edge * across + x / edge, row % edge * tile_width + x % edge)
        };
        match targets[channel] {
            Layer::Beauty { .. } | Layer::Alpha => {}
            Layer::Covered => {
                for (x, value) in wholes(bytes).enumerate() {
                    let (tile, at) = place(x);
                    tiles[tile].covered[at] = value;
                }
            }
            Layer::Spp => {
                for (x, value) in wholes(bytes).enumerate() {
                    let (tile, at) = place(x);
                    let spp = &mut tiles[tile].spp;
                    torn |= at > 0 && *spp != value;
                    *spp = value;
                }
            }
            // The two parts of a sum come one after the other, and adding them up is exact.
            Layer::Half { half, color, .. } => {
                for (x, value) in floats(bytes, SampleType::F32).enumerate() {
                    let (tile, at) = place(x);
                    tiles[tile].halves[at][half][color] += f64::from(value);
                }
            }
            Layer::Pass { pass, color, .. } => {
                for (x, value) in floats(bytes, SampleType::F32).enumerate() {
                    let (tile, at) = place(x);
                    tiles[tile].parts[at * passes + pass][color] += f64::from(value);
                }
            }
        }
    })?;
    if torn {
        return Err("pixels of one tile have different numbers of samples".to_owned().into());
    }
    check(&checkpoint, &figures)?;
    Ok(checkpoint)
}

/// What the header says about the sums.
struct Figures {
    spp: f64,
    check: String,
}

/// What the header says, with sums of nothing.
fn empty(opened: &Opened) -> Result<Checkpoint, String> {
    const MOST: f64 = 9_007_199_254_740_992.0;
    let attributes = opened.attributes();
    let version = attributes.number("checkpoint").ok_or("there is no attribute `checkpoint`: it is none")?;
    if version != f64::from(VERSION) {
        return Err(format!("a checkpoint of version {version}, expected {VERSION}"));
    }
    let seed = attributes.text("seed").unwrap_or_default();
    let channels = opened.channels();
    let kept = |aov: &Aov| {
        let first = format!("sum.{}.R", aov.name());
        channels.iter().any(|(name, _)| *name == first)
    };
    let aovs: AovSet = Aov::ALL.into_iter().filter(kept).collect();
    let passes = aovs.iter().count();
    let count = |name: &str| attributes.needed(name, 0.0..=MOST).map(|value| value as u64);
    let rays = RayCounts { closest: count("closestRays")?, shadow: count("shadowRays")? };
    let sums = |[width, height]: [u32; 2]| TileSums::empty((width * height) as usize, passes);
    Ok(Checkpoint {
        digest: attributes.text("digest").unwrap_or_default(),
        size: opened.size,
        window: opened.window,
        seed: seed.parse().map_err(|_| format!("attribute `seed` is `{seed}`, expected a whole number"))?,
        spp_asked: attributes.needed("sppAsked", 1.0..=f64::from(u32::MAX))? as u32,
        aovs,
        seconds: attributes.needed("seconds", 0.0..=f64::MAX)?,
        threads: attributes.needed("threads", 0.0..=MOST)? as usize,
        tally: Tally { rays, rejected: count("rejectedSamples")? },
        motion: motion(&attributes)?,
        tiles: tile_sizes(opened.window).map(sums).collect(),
    })
}

/// Whether these are sums that a render could have left, and those that were written.
fn check(checkpoint: &Checkpoint, opened: &Figures) -> Result<(), String> {
    let (spp, asked) = (checkpoint.spp(), checkpoint.spp_asked);
    if spp != asked && !(spp < asked && spp.is_multiple_of(PASS_SPP)) {
        return Err(format!("{spp} samples a pixel of {asked}, expected a multiple of {PASS_SPP}"));
    }
    if f64::from(spp) != opened.spp {
        return Err(format!("{spp} samples a pixel, and its header says {}", opened.spp));
    }
    let next = asked.min(spp.saturating_add(PASS_SPP));
    for (index, tile) in checkpoint.tiles.iter().enumerate() {
        if tile.spp != spp && tile.spp != next {
            return Err(format!("tile {index} has {} samples a pixel, expected {spp} or {next}", tile.spp));
        }
        if let Some(covered) = tile.covered.iter().find(|&&covered| covered > tile.spp) {
            return Err(format!("tile {index}: {covered} of {} samples met something", tile.spp));
        }
        if !tile.halves.iter().flatten().chain(&tile.parts).all(|sum| sum.is_finite()) {
            return Err(format!("tile {index}: a sum is not finite"));
        }
    }
    let found = format!("{:016x}", checkpoint.checksum());
    if found != opened.check {
        return Err(format!("the checksum of its sums is {found}, and its header says `{}`", opened.check));
    }
    Ok(())
}
