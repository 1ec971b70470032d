//! Light from all around: a constant colour or a picture of the sky.

use std::f32::consts::PI;
use std::path::Path;
use std::sync::Arc;

use glam::Vec3;

use crate::{RenderError, environment_file};

/// Light that comes from infinitely far away, from every direction.
///
/// A picture is laid out by latitude and longitude as OpenEXR and USD have it, Y up: the upper edge
/// is +Y, the middle of the picture is +Z, its left quarter +X and its right quarter -X, its left and
/// right edges meet at -Z. So a camera at azimuth 0 (on the +Z side) has the middle of the picture at
/// its back, lighting what it sees.
#[derive(Clone, Debug)]
pub struct Environment {
    kind: Kind,
    rotation: f32,
    intensity: f32,
}

#[derive(Clone, Debug)]
enum Kind {
    Constant(Vec3),
    Picture(Arc<LatLong>),
}

impl Environment {
    /// The same radiance (linear Rec. 709, at least 0) from everywhere.
    ///
    /// # Errors
    /// [`RenderError::Argument`] when it is negative or not finite.
    pub fn constant(radiance: Vec3) -> Result<Self, RenderError> {
        if !(radiance.is_finite() && radiance.min_element() >= 0.0) {
            return Err(RenderError::argument("environment radiance", radiance, "finite, at least 0"));
        }
        Ok(Environment { kind: Kind::Constant(radiance), rotation: 0.0, intensity: 1.0 })
    }

    /// A picture of radiances, row by row from the upper left, in the layout described above.
    ///
    /// Negative values, which resampling filters leave behind in EXR files, become 0.
    ///
    /// # Errors
    /// [`RenderError::Argument`] when the size is 0, does not fit the pixels, or a pixel is not finite.
    pub fn from_pixels(width: usize, height: usize, pixels: Vec<Vec3>) -> Result<Self, RenderError> {
        let picture = LatLong::new(width, height, pixels)?;
        Ok(Environment { kind: Kind::Picture(Arc::new(picture)), rotation: 0.0, intensity: 1.0 })
    }

    /// Reads a `.hdr` (Radiance) or `.exr` picture, told apart by their first bytes.
    ///
    /// # Errors
    /// [`RenderError::Io`], [`RenderError::InvalidPicture`] for a broken file or pixels that are not
    /// finite, [`RenderError::UnsupportedPicture`] for other formats or missing colour channels.
    pub fn open(path: &Path) -> Result<Self, RenderError> {
        environment_file::read(path)
    }

    /// The same light turned about +Y by `angle` radians, anticlockwise seen from above: what shone
    /// from +Z shines from +X after a quarter turn.
    #[must_use]
    pub fn rotated(mut self, angle: f32) -> Self {
        self.rotation += angle;
        self
    }

    /// How far it is turned about the up axis, in radians.
    #[must_use]
    pub fn rotation(&self) -> f32 {
        self.rotation
    }

    pub(crate) fn turn_to(&mut self, angle: f32) {
        self.rotation = angle;
    }

    /// The same light, `factor` times as bright (at least 0).
    #[must_use]
    pub fn scaled(mut self, factor: f32) -> Self {
        self.intensity *= factor.max(0.0);
        self
    }

    /// The radiance that arrives from the unit direction `direction`.
    #[must_use]
    pub fn radiance(&self, direction: Vec3) -> Vec3 {
        self.intensity
            * match &self.kind {
                Kind::Constant(radiance) => *radiance,
                Kind::Picture(picture) => picture.bilinear(self.to_picture(direction)),
            }
    }

    /// The picture, when it is not constant.
    pub(crate) fn picture(&self) -> Option<&LatLong> {
        match &self.kind {
            Kind::Constant(_) => None,
            Kind::Picture(picture) => Some(picture),
        }
    }

    /// Mean over the sphere of the mean of the three channels.
    pub(crate) fn mean(&self) -> f32 {
        let mean = match &self.kind {
            Kind::Constant(radiance) => radiance.element_sum() / 3.0,
            Kind::Picture(picture) => picture.mean(),
        };
        self.intensity * mean
    }

    /// A world direction turned into the picture's own axes.
    pub(crate) fn to_picture(&self, direction: Vec3) -> Vec3 {
        rotate_y(direction, -self.rotation)
    }

    /// A direction of the picture turned into the world.
    pub(crate) fn to_world(&self, direction: Vec3) -> Vec3 {
        rotate_y(direction, self.rotation)
    }
}

fn rotate_y(v: Vec3, angle: f32) -> Vec3 {
    if angle == 0.0 {
        return v;
    }
    let (sin, cos) = angle.sin_cos();
    Vec3::new(cos * v.x + sin * v.z, v.y, cos * v.z - sin * v.x)
}

/// A picture by latitude and longitude.
#[derive(Debug)]
pub(crate) struct LatLong {
    pub width: usize,
    pub height: usize,
    pixels: Vec<Vec3>,
}

impl LatLong {
    fn new(width: usize, height: usize, mut pixels: Vec<Vec3>) -> Result<Self, RenderError> {
        if width == 0 || height == 0 || width.checked_mul(height) != Some(pixels.len()) {
            let found = format!("{width} x {height} with {} pixels", pixels.len());
            return Err(RenderError::argument(
                "environment picture",
                found,
                "width x height pixels, at least one",
            ));
        }
        if let Some(bad) = pixels.iter().position(|p| !p.is_finite()) {
            let found = format!("{} at column {}, row {}", pixels[bad], bad % width, bad / width);
            return Err(RenderError::argument("environment picture's pixel", found, "finite numbers"));
        }
        pixels.iter_mut().for_each(|p| *p = p.max(Vec3::ZERO));
        Ok(LatLong { width, height, pixels })
    }

    /// The pixel at column `x` (which wraps once, from -1 to the width) and row `y` (which stops at the
    /// poles).
    pub fn pixel(&self, x: isize, y: isize) -> Vec3 {
        let width = self.width as isize;
        let x = if x < 0 { x + width } else { x - if x >= width { width } else { 0 } } as usize;
        let y = y.clamp(0, self.height as isize - 1) as usize;
        self.pixels[y * self.width + x]
    }

    fn bilinear(&self, direction: Vec3) -> Vec3 {
        let [u, v] = uv_of(direction);
        let (x, y) = (u * self.width as f32 - 0.5, v * self.height as f32 - 0.5);
        let (x0, y0) = (x.floor(), y.floor());
        let (fx, fy) = (x - x0, y - y0);
        let (x0, y0) = (x0 as isize, y0 as isize);
        let upper = self.pixel(x0, y0).lerp(self.pixel(x0 + 1, y0), fx);
        let lower = self.pixel(x0, y0 + 1).lerp(self.pixel(x0 + 1, y0 + 1), fx);
        upper.lerp(lower, fy)
    }

    fn mean(&self) -> f32 {
        let mut sum = 0.0f64;
        for (row, pixels) in self.pixels.chunks_exact(self.width).enumerate() {
            let row_sum: f64 = pixels.iter().map(|p| f64::from(p.element_sum())).sum();
            sum += row_sum * f64::from(row_height(row, self.height));
        }
        (sum / (6.0 * self.width as f64)) as f32
    }
}

/// How much of the height of the unit sphere (2 in all) a row of pixels covers.
pub(crate) fn row_height(row: usize, rows: usize) -> f32 {
    let edge = |row: usize| (std::f64::consts::PI * row as f64 / rows as f64).cos();
    (edge(row) - edge(row + 1)) as f32
}

/// Where in the picture (0..1, 0..1) a direction of the picture's axes lies.
pub(crate) fn uv_of(direction: Vec3) -> [f32; 2] {
    let u = 0.5 - direction.x.atan2(direction.z) / (2.0 * PI);
    // atan2 keeps its precision near the poles, where acos loses it.
    let v = direction.x.hypot(direction.z).atan2(direction.y) / PI;
    [u, v]
}

/// The direction at `u` across the picture whose height on the unit sphere is `y`.
pub(crate) fn direction_at(u: f32, y: f32) -> Vec3 {
    let (sin, cos) = (2.0 * PI * (0.5 - u)).sin_cos();
    let radius = (1.0 - y * y).max(0.0).sqrt();
    Vec3::new(radius * sin, y, radius * cos)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A black picture, 8 x 4, with one white pixel.
    fn one_pixel(x: usize, y: usize) -> Environment {
        let mut pixels = vec![Vec3::ZERO; 32];
        pixels[y * 8 + x] = Vec3::ONE;
        Environment::from_pixels(8, 4, pixels).unwrap()
    }

    #[test]
    fn directions_follow_the_layout() {
        for (direction, uv) in [
            (Vec3::new(1.0e-3, 1.0, 0.0).normalize(), [0.25, 0.0]),
            (Vec3::Z, [0.5, 0.5]),
            (Vec3::X, [0.25, 0.5]),
            (Vec3::NEG_X, [0.75, 0.5]),
        ] {
            let found = uv_of(direction);
            assert!(
                (found[0] - uv[0]).abs() < 1e-6 && (found[1] - uv[1]).abs() < 1e-3,
                "{direction} {found:?}"
            );
            assert!((direction_at(found[0], direction.y) - direction).length() < 2e-3);
        }
    }

    #[test]
    fn a_bright_pixel_shines_from_its_direction() {
        // Column 2 of 8 has its middle at u = 2.5 / 8, a little right of +X, towards +Z; row 1 is above the horizon.
        let direction = direction_at(2.5 / 8.0, (1.5 * PI / 4.0).cos());
        assert!(direction.x > 0.8 && direction.z > 0.0 && direction.y > 0.0);
        assert!((one_pixel(2, 1).radiance(direction).x - 1.0).abs() < 1e-5);
        assert_eq!(one_pixel(2, 1).radiance(-direction), Vec3::ZERO);
    }

    #[test]
    fn rotation_turns_the_light_from_z_to_x() {
        let from_z = direction_at(4.5 / 8.0, (1.5 * PI / 4.0).cos());
        let turned = one_pixel(4, 1).rotated(PI / 2.0).scaled(3.0);
        let from_x = Vec3::new(from_z.z, from_z.y, -from_z.x);
        assert!(from_x.x > 0.8);
        assert!((turned.radiance(from_x).x - 3.0).abs() < 1e-4);
        assert!((turned.to_world(turned.to_picture(from_x)) - from_x).length() < 1e-6);
    }

    #[test]
    fn the_mean_weighs_rows_by_their_area() {
        let all = Environment::from_pixels(5, 3, vec![Vec3::splat(2.0); 15]).unwrap();
        assert!((all.mean() - 2.0).abs() < 1e-6);
        let pole = one_pixel(0, 0).mean() / one_pixel(0, 1).mean();
        assert!((pole - row_height(0, 4) / row_height(1, 4)).abs() < 1e-6);
    }

    #[test]
    fn broken_pictures_are_refused() {
        assert!(Environment::from_pixels(0, 0, vec![]).is_err());
        assert!(Environment::from_pixels(2, 2, vec![Vec3::ONE; 3]).is_err());
        let message = Environment::from_pixels(2, 1, vec![Vec3::ONE, Vec3::NAN]).unwrap_err().to_string();
        assert!(message.contains("column 1, row 0"), "{message}");
        assert!(Environment::constant(Vec3::NEG_ONE).is_err());
    }
}
