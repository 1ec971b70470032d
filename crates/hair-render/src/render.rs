//! From a scene to a frame.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Instant;

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::estimate;
use crate::exposure::Exposure;
use crate::film::{Developed, Pixel};
use crate::filter::Filter;
use crate::path::{PathTracer, RayCounts};
use crate::sampler::Sampler;
use crate::{
    Camera, Frame, FrameReport, MotionReport, MovingCamera, Progress, RenderError, RenderSettings, Scene,
};

/// Pixels along a tile's edge: small enough that the last tiles keep every core busy.
const TILE: u32 = 16;

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
    settings.check()?;
    scene.shutter().check_lasts(camera.moves())?;
    let start = Instant::now();
    let pool = settings.pool()?;
    let work = Work {
        scene,
        settings,
        exposure: Exposure::new(scene, camera, settings.width, settings.height),
        filter: Filter::new(settings.filter_radius),
        progress,
        done: AtomicU64::new(0),
        total: u64::from(settings.width.div_ceil(TILE)) * u64::from(settings.height.div_ceil(TILE)),
    };
    let tiles: Result<Vec<Tile>, RenderError> =
        pool.install(|| (0..work.total).into_par_iter().map(|index| work.tile(index)).collect());
    let mut frame = assemble(settings, &tiles?);
    frame.report.motion = MotionReport::of(scene, camera);
    frame.report.threads = pool.current_num_threads();
    frame.report.seconds = start.elapsed().as_secs_f64();
    Ok(frame)
}

struct Work<'a> {
    scene: &'a Scene,
    settings: &'a RenderSettings,
    exposure: Exposure,
    filter: Filter,
    progress: &'a dyn Progress,
    done: AtomicU64,
    total: u64,
}

/// A square of finished pixels.
struct Tile {
    x: u32,
    y: u32,
    width: u32,
    pixels: Vec<Developed>,
    rays: RayCounts,
    rejected: u64,
}

impl Work<'_> {
    fn tile(&self, index: u64) -> Result<Tile, RenderError> {
        let across = u64::from(self.settings.width.div_ceil(TILE));
        let (x, y) = ((index % across) as u32 * TILE, (index / across) as u32 * TILE);
        let width = TILE.min(self.settings.width - x);
        let height = TILE.min(self.settings.height - y);
        let mut paths = PathTracer::new(self.scene, self.settings);
        let mut pixels = Vec::with_capacity((width * height) as usize);
        let mut rejected = 0;
        for row in y..y + height {
            for column in x..x + width {
                if self.progress.cancelled() {
                    return Err(RenderError::Cancelled);
                }
                let pixel = self.pixel(&mut paths, column, row);
                rejected += u64::from(pixel.rejected);
                pixels.push(pixel.develop());
            }
        }
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.progress.advance(done, self.total);
        Ok(Tile { x, y, width, pixels, rays: paths.rays, rejected })
    }

    /// All samples of a pixel, always in the same order.
    fn pixel(&self, paths: &mut PathTracer, x: u32, y: u32) -> Pixel {
        let mut pixel = Pixel::default();
        let second = self.settings.spp / 2;
        for (half, count) in [(0, self.settings.spp - second), (1, second)] {
            for index in 0..count {
                let sampler = Sampler::new(self.settings.seed, x, y, half, index);
                let [u, v, when, _] = PathTracer::camera_numbers(&sampler);
                let film_x = x as f32 + 0.5 + self.filter.sample(u);
                let film_y = y as f32 + 0.5 + self.filter.sample(v);
                let ray = self.exposure.ray(film_x, film_y, when);
                pixel.add(half as usize, &paths.trace(ray, &sampler));
            }
        }
        pixel
    }
}

fn assemble(settings: &RenderSettings, tiles: &[Tile]) -> Frame {
    let (width, height) = (settings.width, settings.height);
    let count = width as usize * height as usize;
    let mut beauty = vec![Vec3::ZERO; count];
    let mut alpha = vec![0.0; count];
    let mut passes: Vec<_> = settings.aovs.iter().map(|aov| (aov, vec![Vec3::ZERO; count])).collect();
    let mut variance = vec![DVec3::ZERO; if settings.spp >= 2 { count } else { 0 }];
    for tile in tiles {
        for (i, pixel) in tile.pixels.iter().enumerate() {
            let x = tile.x as usize + i % tile.width as usize;
            let y = tile.y as usize + i / tile.width as usize;
            let at = y * width as usize + x;
            beauty[at] = pixel.beauty;
            alpha[at] = pixel.alpha;
            for (aov, pixels) in &mut passes {
                pixels[at] = pixel.parts[*aov as usize];
            }
            if let (Some(kept), Some(found)) = (variance.get_mut(at), pixel.variance) {
                *kept = found;
            }
        }
    }
    let rel_mse = (settings.spp >= 2).then(|| estimate::rel_mse(width as usize, &beauty, &alpha, &variance));
    let report = FrameReport {
        seconds: 0.0,
        spp: settings.spp,
        seed: settings.seed,
        threads: 0,
        samples: count as u64 * u64::from(settings.spp),
        closest_rays: tiles.iter().map(|t| t.rays.closest).sum(),
        shadow_rays: tiles.iter().map(|t| t.rays.shadow).sum(),
        rejected_samples: tiles.iter().map(|t| t.rejected).sum(),
        rel_mse,
        relative_error: rel_mse.map(f64::sqrt),
        motion: None,
    };
    Frame { width, height, beauty, alpha, passes, report }
}
