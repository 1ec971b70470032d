//! The mean colour of one groom under even light, with its own noise.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use crate::exposure::Exposure;
use crate::path::PathTracer;
use crate::sampler::Sampler;
use crate::{Progress, RenderError, RenderSettings, Scene};

/// Estimates that know nothing of each other; how much they differ tells the noise of their mean.
const REPLICAS: usize = 8;

/// What is looked at, and how closely.
pub(crate) struct Probe<'a> {
    pub object: u32,
    pub exposure: Exposure,
    /// Left, upper, right and lower edge of the part that counts, in pixels.
    pub patch: [u32; 4],
    /// Samples a pixel; rounded up to a multiple of the replicas.
    pub spp: u32,
    pub settings: &'a RenderSettings,
}

/// What was seen.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seen {
    /// Mean radiance of the groom where the camera sees it.
    pub color: DVec3,
    /// Standard error of that mean.
    pub noise: DVec3,
    /// Share of the patch the groom covers.
    pub coverage: f64,
}

#[derive(Clone, Copy, Default)]
struct Sum {
    light: DVec3,
    count: u64,
}

impl Probe<'_> {
    /// Looks once. Every look uses the same random numbers, so that two looks differ by what was changed
    /// between them and little else.
    pub fn look(&self, scene: &Scene, progress: &dyn Progress) -> Result<Seen, RenderError> {
        let [_, top, _, bottom] = self.patch;
        let rows: Result<Vec<[Sum; REPLICAS]>, RenderError> = (top..bottom)
            .into_par_iter()
            .map(|y| if progress.cancelled() { Err(RenderError::Cancelled) } else { Ok(self.row(scene, y)) })
            .collect();
        let mut sums = [Sum::default(); REPLICAS];
        for row in rows? {
            for (sum, part) in sums.iter_mut().zip(row) {
                sum.light += part.light;
                sum.count += part.count;
            }
        }
        Ok(self.seen(&sums))
    }

    fn row(&self, scene: &Scene, y: u32) -> [Sum; REPLICAS] {
        let mut paths = PathTracer::new(scene, self.settings);
        let [left, _, right, _] = self.patch;
        let mut sums = [Sum::default(); REPLICAS];
        for x in left..right {
            for (replica, sum) in sums.iter_mut().enumerate() {
                let seed = self.settings.seed.wrapping_add(replica as u64);
                for index in 0..self.spp.div_ceil(REPLICAS as u32) {
                    let sampler = Sampler::new(seed, x, y, 0, index);
                    let [u, v, when, _] = PathTracer::camera_numbers(&sampler);
                    let ray = self.exposure.ray(x as f32 + u, y as f32 + v, when);
                    let light = paths.trace(ray, &sampler);
                    let radiance: Vec3 = light.parts.iter().sum();
                    if light.fibre == Some(self.object) && radiance.is_finite() {
                        sum.light += radiance.as_dvec3();
                        sum.count += 1;
                    }
                }
            }
        }
        sums
    }

    fn seen(&self, sums: &[Sum; REPLICAS]) -> Seen {
        let count: u64 = sums.iter().map(|s| s.count).sum();
        let color = sums.iter().map(|s| s.light).sum::<DVec3>() / count.max(1) as f64;
        let squares = sums
            .iter()
            .filter(|s| s.count > 0)
            .map(|s| (s.light / s.count as f64 - color).powf(2.0))
            .sum::<DVec3>();
        let noise = (squares / (REPLICAS * (REPLICAS - 1)) as f64).map(f64::sqrt);
        let [left, top, right, bottom] = self.patch.map(f64::from);
        let samples = f64::from(self.spp.div_ceil(REPLICAS as u32)) * REPLICAS as f64;
        Seen { color, noise, coverage: count as f64 / ((right - left) * (bottom - top) * samples) }
    }
}
