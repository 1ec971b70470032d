//! A small photographer's studio as an environment, made by rule.

use std::f32::consts::PI;
use std::path::Path;

use glam::Vec3;

use crate::environment::direction_at;
use crate::{Environment, Precision, RenderError, exr_file};

/// Pixels across that show the studio well: its soft boxes have soft edges, and a larger picture costs time
/// to look up.
pub const STUDIO_WIDTH: usize = 128;

/// One soft box: where its middle is, how far it reaches and how it shines.
struct SoftBox {
    /// Degrees from +Z towards +X.
    azimuth: f32,
    /// Degrees above the horizon.
    elevation: f32,
    /// Half its size in degrees, across and up.
    half_size: [f32; 2],
    radiance: Vec3,
}

/// A key light in front on the right, a wide fill on the left, a strip behind that lines the hair; all of
/// them large, since small bright lights are what makes hair noisy.
const BOXES: [SoftBox; 3] = [
    SoftBox { azimuth: 40.0, elevation: 38.0, half_size: [36.0, 26.0], radiance: Vec3::new(5.6, 5.3, 4.8) },
    SoftBox { azimuth: -65.0, elevation: 12.0, half_size: [34.0, 34.0], radiance: Vec3::new(1.1, 1.2, 1.4) },
    SoftBox { azimuth: 165.0, elevation: 35.0, half_size: [20.0, 36.0], radiance: Vec3::new(4.6, 4.6, 4.8) },
];

impl Environment {
    /// The studio in `width` x `width / 2` pixels: grey walls, a darker floor, three soft boxes. The key
    /// light stands between +Z and +X, so cameras near azimuth 0 see the lit side.
    ///
    /// # Errors
    /// [`RenderError::Argument`] when `width` is below 2.
    pub fn studio(width: usize) -> Result<Self, RenderError> {
        Environment::from_pixels(width, width / 2, studio_pixels(width))
    }
}

/// Writes the studio to an `.exr` file, as [`Environment::open`] reads it.
///
/// # Errors
/// [`RenderError::Argument`] when `width` is not in 2..=16384, [`RenderError::Io`] or
/// [`RenderError::Encode`] from writing.
pub fn write_studio(path: &Path, width: usize) -> Result<(), RenderError> {
    if !(2..=16_384).contains(&width) {
        return Err(RenderError::argument("studio width", width, "2..=16384 pixels"));
    }
    exr_file::write_rgb(path, width, &studio_pixels(width), Precision::Half)
}

fn studio_pixels(width: usize) -> Vec<Vec3> {
    let height = width / 2;
    let mut pixels = Vec::with_capacity(width * height);
    for row in 0..height {
        let y = (PI * (row as f32 + 0.5) / height as f32).cos();
        pixels
            .extend((0..width).map(|column| radiance(direction_at((column as f32 + 0.5) / width as f32, y))));
    }
    pixels
}

fn radiance(direction: Vec3) -> Vec3 {
    let walls = if direction.y < 0.0 { 0.12 } else { 0.25 + 0.15 * direction.y };
    BOXES
        .iter()
        .fold(Vec3::splat(walls), |sum, soft_box| sum + soft_box.radiance * soft_box.covers(direction))
}

impl SoftBox {
    /// 1 inside, 0 outside, a soft edge of 4 degrees between.
    fn covers(&self, direction: Vec3) -> f32 {
        let azimuth = direction.x.atan2(direction.z).to_degrees();
        let elevation = direction.y.clamp(-1.0, 1.0).asin().to_degrees();
        let across = (azimuth - self.azimuth + 540.0).rem_euclid(360.0) - 180.0;
        let edge = |offset: f32, half: f32| ((half - offset.abs()) / 4.0 + 0.5).clamp(0.0, 1.0);
        edge(across, self.half_size[0]) * edge(elevation - self.elevation, self.half_size[1])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_holds_the_studio() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("studio.exr");
        write_studio(&path, 64).unwrap();
        let (read, made) = (Environment::open(&path).unwrap(), Environment::studio(64).unwrap());
        let key = direction_at(0.5 - 40.0 / 360.0, 38f32.to_radians().sin());
        assert!(key.x > 0.0 && key.z > 0.0);
        for direction in [key, -key, Vec3::Y, Vec3::new(0.6, -0.64, 0.48)] {
            assert!((read.radiance(direction) - made.radiance(direction)).length() < 0.02);
        }
        assert!(made.radiance(key).x > 5.0 && made.radiance(Vec3::NEG_Y).x < 0.2);
        assert!(write_studio(&path, 1).is_err() && Environment::studio(0).is_err());
    }
}
