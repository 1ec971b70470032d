//! A checkpoint read from its file, whatever became of it since.

use std::path::Path;

use exr::meta::attribute::SampleType;

use crate::checkpoint::tile_sizes;
use crate::checkpoint_layers::{Layer, VERSION, layers};
use crate::exr_read::{Opened, Unreadable, floats, wholes, with_file};
use crate::frame_header::{MOST, motion};
use crate::path::RayCounts;
use crate::sums::{TILE, Tally, TileSums};
use crate::{Aov, AovSet, Checkpoint, RenderError};

impl Checkpoint {
    /// Reads a checkpoint and checks all of it.
    ///
    /// # Errors
    /// [`RenderError::Io`], or [`RenderError::InvalidPicture`] for what is no checkpoint, or damaged.
    pub fn read(path: &Path) -> Result<Checkpoint, RenderError> {
        with_file(path, read)
    }
}

fn read(opened: Opened) -> Result<Checkpoint, Unreadable> {
    let mut checkpoint = empty(&opened)?;
    let attributes = opened.attributes();
    let told_spp = attributes.needed("spp", 0.0..=f64::from(u32::MAX))?;
    let told_sum = attributes.text("sumsCheck").unwrap_or_default();
    let aovs: Vec<Aov> = checkpoint.aovs.iter().collect();
    let targets = targets(&opened, &aovs)?;
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
    checkpoint.check_sums(told_spp, &told_sum)?;
    Ok(checkpoint)
}

/// What each of the file's channels holds; all of a checkpoint's are there, once.
fn targets(opened: &Opened, aovs: &[Aov]) -> Result<Vec<Layer>, String> {
    let expected = layers(aovs);
    let mut targets = Vec::with_capacity(expected.len());
    for (name, found) in opened.channels() {
        let layer = expected.iter().find(|(own, _)| *own == name).map(|(_, layer)| *layer);
        let layer = layer.ok_or_else(|| format!("channel `{name}` is none of a checkpoint's"))?;
        if found != layer.kind() || targets.contains(&layer) {
            let kind = layer.kind();
            return Err(format!("channel `{name}` is {found:?} or there twice, expected {kind:?}"));
        }
        targets.push(layer);
    }
    match expected.iter().find(|(_, layer)| !targets.contains(layer)) {
        Some((missing, _)) => Err(format!("there is no channel `{missing}`")),
        None => Ok(targets),
    }
}

/// What the header says, with sums of nothing.
fn empty(opened: &Opened) -> Result<Checkpoint, String> {
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
