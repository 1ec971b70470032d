//! Colours from a picture.

use glam::{Vec2, Vec3};

use crate::{Attribute, Domain, Groom, GroomError, Values, names};

/// Where v = 0 is in a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum VAxis {
    /// At the bottom: USD, Alembic, Blender, Houdini.
    #[default]
    Up,
    /// At the top: glTF, Direct3D.
    Down,
}

/// A picture someone else holds, to be looked up between its pixels.
///
/// u = 0 is the left edge and v = 0 the bottom or top edge, by [`VAxis`]; pixels have their centres at half
/// steps, and the picture repeats outside 0..1.
#[derive(Clone, Copy, Debug)]
pub struct Texture<'a> {
    width: usize,
    height: usize,
    pixels: &'a [Vec3],
    v_axis: VAxis,
}

impl<'a> Texture<'a> {
    /// A picture of `width` columns: linear Rec. 709 colours, row after row from the top.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless the pixels fill at least one row and the last one whole.
    pub fn new(width: usize, pixels: &'a [Vec3], v_axis: VAxis) -> Result<Self, GroomError> {
        let height = pixels.len().checked_div(width).unwrap_or(0);
        if height == 0 || height * width != pixels.len() {
            let found = format!("{} pixels in rows of {width}", pixels.len());
            return Err(GroomError::argument("picture", found, "one whole row or more"));
        }
        Ok(Texture { width, height, pixels, v_axis })
    }

    /// The colour at `uv`, interpolated between the four pixels around it. A coordinate that is not finite
    /// gives one that is not a number.
    #[must_use]
    pub fn at(&self, uv: Vec2) -> Vec3 {
        let v = match self.v_axis {
            VAxis::Up => 1.0 - f64::from(uv.y),
            VAxis::Down => f64::from(uv.y),
        };
        let (left, right, x) = neighbours(f64::from(uv.x), self.width);
        let (top, bottom, y) = neighbours(v, self.height);
        let row = |y: usize| self.pixels[y * self.width + left].lerp(self.pixels[y * self.width + right], x);
        row(top).lerp(row(bottom), y)
    }
}

/// The two of `count` pixels in a row around `place`, and how far it is from the first to the second.
fn neighbours(place: f64, count: usize) -> (usize, usize, f32) {
    let at = (place - place.floor()) * count as f64 - 0.5;
    let before = at.floor();
    // Before the first is the last, and after the last the first. Not-a-number becomes 0.
    let first = (before + count as f64) as usize % count;
    (first, (first + 1) % count, (at - before) as f32)
}

impl Groom {
    /// Gives every strand the colour that `texture` has at the strand's `root_uv`, held to 0..1.
    ///
    /// # Errors
    /// [`GroomError::AttributeMissing`] without a `root_uv`.
    pub fn color_from_texture(&mut self, texture: &Texture<'_>) -> Result<(), GroomError> {
        let missing = |found| {
            let (name, expected) = (names::ROOT_UV, "one vec2 a strand, to look colours up in a picture");
            Err(GroomError::AttributeMissing { name, found, expected })
        };
        let Some(Attribute { domain, values }) = self.attribute(names::ROOT_UV) else {
            return missing("not there");
        };
        let Values::Vec2(uvs) = values else { return missing("of another type") };
        let index = |strand: usize| match domain {
            Domain::Groom => 0,
            Domain::Strand => strand,
            Domain::Vertex => self.offsets()[strand] as usize,
        };
        let color = |strand| texture.at(uvs[index(strand)]).clamp(Vec3::ZERO, Vec3::ONE);
        let values = Values::Vec3((0..self.strand_count()).map(color).collect());
        self.set_attribute(names::COLOR, Attribute { domain: Domain::Strand, values })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(texture: Texture<'_>, cases: &[([f32; 2], f32)]) {
        for &(uv, expected) in cases {
            assert_eq!(texture.at(uv.into()), Vec3::splat(expected), "{uv:?}");
        }
    }

    #[test]
    fn pixels_at_their_centres_and_mixed_between() {
        // Top row 0 1, bottom row 2 3.
        let pixels = [0.0, 1.0, 2.0, 3.0].map(Vec3::splat);
        let down = Texture::new(2, &pixels, VAxis::Down).unwrap();
        check(down, &[([0.25, 0.25], 0.0), ([0.75, 0.25], 1.0), ([0.25, 0.75], 2.0), ([0.5, 0.5], 1.5)]);
        let up = Texture::new(2, &pixels, VAxis::Up).unwrap();
        check(up, &[([0.25, 0.25], 2.0), ([0.75, 0.75], 1.0), ([0.5, 0.5], 1.5)]);
        // It repeats, and mixes over the edge.
        check(down, &[([1.25, -0.75], 0.0), ([0.0, 0.25], 0.5), ([1.0, 0.25], 0.5), ([-7.5, 0.5], 1.5)]);
    }

    #[test]
    fn odd_pictures_and_places_do_no_harm() {
        let one = [Vec3::ONE];
        check(Texture::new(1, &one, VAxis::Up).unwrap(), &[([0.3, 9.1], 1.0)]);
        assert!(Texture::new(1, &one, VAxis::Up).unwrap().at(Vec2::new(f32::NAN, f32::INFINITY)).is_nan());
        for (width, count) in [(0, 0), (0, 1), (1, 0), (2, 3), (2, 1)] {
            assert!(Texture::new(width, &vec![Vec3::ONE; count], VAxis::Up).is_err(), "{width} {count}");
        }
    }
}
