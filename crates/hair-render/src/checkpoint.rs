//! A render that is not finished, with all that is needed to go on.

use glam::{DVec3, Vec3};

use crate::crop::Window;
use crate::sums::{TILE, Tally, TileSums};
use crate::{AovSet, Frame, FrameReport, MotionReport, PASS_SPP, RenderError, RenderSettings, estimate};

/// The sums of all samples taken so far, how many there are, and what they are samples of.
///
/// Takes 52 bytes of memory a pixel and 24 more for each pass that is kept: 108 MB for 1920 x 1080 pixels, 357 MB
/// with five passes. This is also what a render itself works on.
#[derive(Clone, Debug, PartialEq)]
pub struct Checkpoint {
    pub(crate) digest: String,
    /// Pixels across and down the whole picture.
    pub(crate) size: [u32; 2],
    pub(crate) window: Window,
    pub(crate) seed: u64,
    pub(crate) spp_asked: u32,
    pub(crate) aovs: AovSet,
    pub(crate) seconds: f64,
    pub(crate) threads: usize,
    pub(crate) tally: Tally,
    pub(crate) motion: Option<MotionReport>,
    /// Row by row; those that are ahead of the others have samples of the pass that was broken off.
    pub(crate) tiles: Vec<TileSums>,
}

/// The tiles of a window, row by row, as (width, height).
pub(crate) fn tile_sizes(window: Window) -> impl Iterator<Item = [u32; 2]> {
    let steps = |length: u32| (0..length).step_by(TILE as usize).map(move |from| TILE.min(length - from));
    steps(window.height).flat_map(move |height| steps(window.width).map(move |width| [width, height]))
}

impl Checkpoint {
    /// A render without a sample.
    pub(crate) fn empty(settings: &RenderSettings, digest: &str) -> Result<Self, RenderError> {
        let window = settings.window()?;
        let passes = settings.aovs.iter().count();
        let empty = |[width, height]: [u32; 2]| TileSums::empty((width * height) as usize, passes);
        Ok(Checkpoint {
            digest: digest.to_owned(),
            size: [settings.width, settings.height],
            window,
            seed: settings.seed,
            spp_asked: settings.spp,
            aovs: settings.aovs,
            seconds: 0.0,
            threads: 0,
            tally: Tally::default(),
            motion: None,
            tiles: tile_sizes(window).map(empty).collect(),
        })
    }

    /// Itself, if it is of these settings and this digest.
    pub(crate) fn checked(self, settings: &RenderSettings, digest: &str) -> Result<Self, RenderError> {
        let pixels = |[w, h]: [u32; 2], crop: Window| {
            format!("{w} x {h}, of it {} x {} from {}, {}", crop.width, crop.height, crop.x, crop.y)
        };
        let names = |set: AovSet| set.iter().map(crate::Aov::name).collect::<Vec<_>>().join(",");
        let size = [settings.width, settings.height];
        let pairs = [
            ("digest", self.digest.clone(), digest.to_owned()),
            ("size", pixels(self.size, self.window), pixels(size, settings.window()?)),
            ("seed", self.seed.to_string(), settings.seed.to_string()),
            ("number of samples", self.spp_asked.to_string(), settings.spp.to_string()),
            ("set of passes", names(self.aovs), names(settings.aovs)),
        ];
        match pairs.into_iter().find(|(_, found, expected)| found != expected) {
            Some((what, found, expected)) => Err(RenderError::OtherCheckpoint { what, found, expected }),
            None => Ok(self),
        }
    }

    /// The digest of what it is a checkpoint of.
    #[must_use]
    pub fn digest(&self) -> &str {
        &self.digest
    }

    /// Samples that every pixel has.
    #[must_use]
    pub fn spp(&self) -> u32 {
        self.tiles.iter().map(|tile| tile.spp).min().unwrap_or(self.spp_asked)
    }

    /// Samples a pixel that were asked for.
    #[must_use]
    pub fn spp_asked(&self) -> u32 {
        self.spp_asked
    }

    /// Seconds spent rendering so far.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// How many passes of tiles are done.
    pub(crate) fn passes_done(&self) -> u64 {
        self.tiles.iter().map(|tile| u64::from(tile.spp.div_ceil(PASS_SPP))).sum()
    }

    /// The picture of the samples so far; its `spp` are those that every pixel has.
    #[must_use]
    pub fn frame(&self) -> Frame {
        let Window { width, height, .. } = self.window;
        let (count, spp) = (self.window.count(), self.spp());
        let mut beauty = vec![Vec3::ZERO; count];
        let mut alpha = vec![0.0; count];
        let mut variance = vec![DVec3::ZERO; if spp >= 2 { count } else { 0 }];
        let mut passes: Vec<_> = self.aovs.iter().map(|aov| (aov, vec![Vec3::ZERO; count])).collect();
        let kept = passes.len();
        self.each_pixel(|place, tile, at| {
            let pixel = tile.develop(at);
            (beauty[place], alpha[place]) = (pixel.beauty, pixel.alpha);
            if let (Some(kept), Some(found)) = (variance.get_mut(place), pixel.variance) {
                *kept = found;
            }
            for (pass, (_, pixels)) in passes.iter_mut().enumerate() {
                pixels[place] = tile.part(at, pass, kept);
            }
        });
        let rel_mse = (spp >= 2).then(|| estimate::rel_mse(width as usize, &beauty, &alpha, &variance));
        let samples = self.tiles.iter().map(|tile| tile.covered.len() as u64 * u64::from(tile.spp)).sum();
        let report = FrameReport {
            seconds: self.seconds,
            spp,
            seed: self.seed,
            threads: self.threads,
            samples,
            closest_rays: self.tally.rays.closest,
            shadow_rays: self.tally.rays.shadow,
            rejected_samples: self.tally.rejected,
            rel_mse,
            relative_error: rel_mse.map(f64::sqrt),
            motion: self.motion.clone(),
        };
        let cutout = self.window.cutout(self.size[0], self.size[1]);
        Frame { width, height, cutout, beauty, alpha, passes, report }
    }

    /// Calls `visit` with each pixel's place in the picture, its tile and its place there.
    fn each_pixel(&self, mut visit: impl FnMut(usize, &TileSums, usize)) {
        let width = self.window.width as usize;
        let across = self.window.width.div_ceil(TILE) as usize;
        for (index, (tile, [tile_width, _])) in self.tiles.iter().zip(tile_sizes(self.window)).enumerate() {
            let (x, y) = (index % across * TILE as usize, index / across * TILE as usize);
            for at in 0..tile.covered.len() {
                let (column, row) = (at % tile_width as usize, at / tile_width as usize);
                visit((y + row) * width + x + column, tile, at);
            }
        }
    }
}
