//! From a scene to a frame.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use rayon::prelude::*;

use crate::crop::Window;
use crate::exposure::Exposure;
use crate::filter::Filter;
use crate::path::PathTracer;
use crate::sampler::Sampler;
use crate::sums::{TILE, Tally, TileSums};
use crate::{
    Aov, Camera, Checkpoint, Frame, MotionReport, MovingCamera, Next, Progress, RenderError, RenderSettings,
    Scene, SoFar,
};

/// Samples a pixel of one pass; the last pass of a picture may have fewer. Half of them go to each half of the
/// error estimate, as powers of two, which is what their sequences are best at.
pub const PASS_SPP: u32 = 16;

/// How a render ended.
// There is one of them at a time: nothing is gained by a box.
#[allow(clippy::large_enum_variant)]
#[derive(Clone, Debug, PartialEq)]
pub enum Rendered {
    /// The picture.
    Done(Frame),
    /// [`Progress`] asked to stop: all that is needed to go on.
    Stopped(Checkpoint),
}

/// Renders a frame on all cores (or `settings.threads`).
///
/// # Errors
/// [`RenderError::Argument`] for settings out of range, [`RenderError::Threads`], or
/// [`RenderError::Cancelled`] when `progress` asks to stop.
pub fn render(
    scene: &Scene,
    camera: &Camera,
    settings: &RenderSettings,
    progress: &dyn Progress,
) -> Result<Frame, RenderError> {
    render_moving(scene, &MovingCamera::from(*camera), settings, progress)
}

/// Renders a frame through a camera that moves while the shutter is open. A camera that does not gives what
/// [`render`] gives, bit for bit.
///
/// # Errors
/// As [`render`]; [`RenderError::Argument`] also for a camera that moves under a shutter that sees but an instant.
pub fn render_moving(
    scene: &Scene,
    camera: &MovingCamera,
    settings: &RenderSettings,
    progress: &dyn Progress,
) -> Result<Frame, RenderError> {
    match render_from(scene, camera, settings, "", None, progress)? {
        Rendered::Done(frame) => Ok(frame),
        Rendered::Stopped(_) => Err(RenderError::Cancelled),
    }
}

/// Renders a frame, or goes on with one from `start`, in passes of [`PASS_SPP`] samples a pixel.
///
/// `digest` stands for everything the picture depends on that `settings` do not tell; a checkpoint carries it. A
/// frame that was stopped and taken up again, however often and on however many threads, has the bits of one that
/// was not; its seconds and rays are those of all runs together.
///
/// # Errors
/// As [`render_moving`], and [`RenderError::OtherCheckpoint`] when `start` is of another digest, size, crop, seed,
/// set of passes or number of samples. Never [`RenderError::Cancelled`].
pub fn render_from(
    scene: &Scene,
    camera: &MovingCamera,
    settings: &RenderSettings,
    digest: &str,
    start: Option<Checkpoint>,
    progress: &dyn Progress,
) -> Result<Rendered, RenderError> {
    settings.check()?;
    scene.shutter().check_lasts(camera.moves())?;
    let mut checkpoint = match start {
        Some(found) => found.checked(settings, digest)?,
        None => Checkpoint::empty(settings, digest)?,
    };
    let (clock, before) = (Instant::now(), checkpoint.seconds);
    let pool = settings.pool()?;
    checkpoint.threads = pool.current_num_threads();
    checkpoint.motion = MotionReport::of(scene, camera);
    let work = Work {
        scene,
        settings,
        exposure: Exposure::new(scene, camera, settings.width, settings.height),
        filter: Filter::new(settings.filter_radius),
        window: checkpoint.window,
        aovs: checkpoint.aovs.iter().collect(),
        progress,
        done: AtomicU64::new(checkpoint.passes_done()),
        total: checkpoint.tiles.len() as u64 * u64::from(settings.spp.div_ceil(PASS_SPP)),
    };
    while checkpoint.spp() < settings.spp {
        let target = settings.spp.min(checkpoint.spp().saturating_add(PASS_SPP));
        let tally = pool.install(|| work.pass(&mut checkpoint.tiles, target));
        checkpoint.tally.add(&tally);
        checkpoint.seconds = before + clock.elapsed().as_secs_f64();
        if checkpoint.spp() < target {
            return Ok(Rendered::Stopped(checkpoint));
        }
        let last = target == settings.spp;
        if !last && progress.pass_done(&SoFar { checkpoint: &checkpoint }) == Next::Stop {
            return Ok(Rendered::Stopped(checkpoint));
        }
    }
    let mut frame = checkpoint.frame();
    frame.report.seconds = before + clock.elapsed().as_secs_f64();
    Ok(Rendered::Done(frame))
}

struct Work<'a> {
    scene: &'a Scene,
    settings: &'a RenderSettings,
    exposure: Exposure,
    filter: Filter,
    window: Window,
    aovs: Vec<Aov>,
    progress: &'a dyn Progress,
    done: AtomicU64,
    total: u64,
}

impl Work<'_> {
    /// Brings every tile to `target` samples a pixel; asked to stop, it leaves some where they are.
    fn pass(&self, tiles: &mut [TileSums], target: u32) -> Tally {
        let due = tiles.par_iter_mut().enumerate().filter(|(_, tile)| tile.spp < target);
        let tallies = due.map(|(index, tile)| self.tile(index as u32, tile, target).unwrap_or_default());
        tallies.reduce(Tally::default, |mut sum, tally| {
            sum.add(&tally);
            sum
        })
    }

    /// Brings a tile to `target` samples a pixel, or leaves it as it is: `None` when asked to stop.
    fn tile(&self, index: u32, tile: &mut TileSums, target: u32) -> Option<Tally> {
        if self.progress.cancelled() {
            return None;
        }
        let across = self.window.width.div_ceil(TILE);
        let (x, y) = (index % across * TILE, index / across * TILE);
        let width = TILE.min(self.window.width - x);
        let mut sums = tile.clone();
        let mut paths = PathTracer::new(self.scene, self.settings);
        let mut rejected = 0;
        for at in 0..sums.covered.len() {
            if self.progress.cancelled() {
                return None;
            }
            let (column, row) = (x + at as u32 % width, y + at as u32 / width);
            let pixel = [self.window.x + column, self.window.y + row];
            rejected += self.pixel(&mut paths, pixel, target, at, &mut sums);
        }
        sums.spp = target;
        sums.round();
        *tile = sums;
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.progress.advance(done, self.total);
        Some(Tally { rays: paths.rays, rejected })
    }

    /// The samples of a pixel up to `target`, always in the same order; how many were not finite.
    fn pixel(
        &self,
        paths: &mut PathTracer,
        [x, y]: [u32; 2],
        target: u32,
        at: usize,
        sums: &mut TileSums,
    ) -> u64 {
        let mut rejected = 0;
        for half in 0..2 {
            // Sample n of the pixel is sample n / 2 of half n mod 2.
            let index = |n: u32| if half == 0 { n.div_ceil(2) } else { n / 2 };
            for index in index(sums.spp)..index(target) {
                let sampler = Sampler::new(self.settings.seed, x, y, half, index);
                let [u, v, when, _] = PathTracer::camera_numbers(&sampler);
                let film_x = x as f32 + 0.5 + self.filter.sample(u);
                let film_y = y as f32 + 0.5 + self.filter.sample(v);
                let ray = self.exposure.ray(film_x, film_y, when);
                let light = paths.trace(ray, &sampler);
                rejected += u64::from(!sums.add(at, half as usize, &light, &self.aovs));
            }
        }
        rejected
    }
}
