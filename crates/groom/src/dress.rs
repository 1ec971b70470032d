//! Colours and widths for strands that came without.

use glam::Vec3;

use crate::length::arc_lengths;
use crate::{Attribute, Domain, Groom, GroomError, Values, names};

impl Groom {
    /// Gives the whole groom one colour (linear Rec. 709, 0 to 1).
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless the channels lie in 0..=1.
    pub fn set_color(&mut self, color: Vec3) -> Result<(), GroomError> {
        check_color(color)?;
        let values = Values::Vec3(vec![color]);
        self.set_attribute(names::COLOR, Attribute { domain: Domain::Groom, values })
    }

    /// Gives the whole groom one width: a diameter, twice the radius that is stored.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `width` is finite and not negative.
    pub fn set_width(&mut self, width: f32) -> Result<(), GroomError> {
        check_width(width)?;
        self.set_attribute(names::RADIUS, Attribute::constant_float(width * 0.5))
    }

    /// Lets the width (a diameter) run from `root` to `tip`, evenly along each strand's length.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless both are finite and not negative.
    pub fn ramp_width(&mut self, root: f32, tip: f32) -> Result<(), GroomError> {
        check_width(root)?;
        check_width(tip)?;
        let along = self.along_strands().into_iter();
        let values = Values::Float(along.map(|t| 0.5 * (root * (1.0 - t) + tip * t)).collect());
        self.set_attribute(names::RADIUS, Attribute { domain: Domain::Vertex, values })
    }

    /// Lets the colour run from `root` to `tip`, evenly along each strand's length.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless the channels lie in 0..=1.
    pub fn ramp_color(&mut self, root: Vec3, tip: Vec3) -> Result<(), GroomError> {
        check_color(root)?;
        check_color(tip)?;
        let along = self.along_strands().into_iter();
        let values = Values::Vec3(along.map(|t| root * (1.0 - t) + tip * t).collect());
        self.set_attribute(names::COLOR, Attribute { domain: Domain::Vertex, values })
    }

    /// How far along its strand each point is: 0 at the root, 1 at the tip, by length; by index on a
    /// strand without length, and 0 on a single point.
    #[must_use]
    pub fn along_strands(&self) -> Vec<f32> {
        let (mut along, mut lengths) = (Vec::with_capacity(self.point_count()), Vec::new());
        for strand in self.strands() {
            let length = arc_lengths(strand, &mut lengths);
            if length.is_finite() && length > 0.0 {
                along.extend(lengths.iter().map(|l| (l / length) as f32));
            } else {
                let last = (strand.len() - 1).max(1) as f32;
                along.extend((0..strand.len()).map(|i| i as f32 / last));
            }
        }
        along
    }
}

fn check_color(color: Vec3) -> Result<(), GroomError> {
    // Written so that not-a-number is refused too.
    if color.to_array().iter().all(|channel| (0.0..=1.0).contains(channel)) {
        return Ok(());
    }
    let (what, found) = ("colour", format!("{} {} {}", color.x, color.y, color.z));
    Err(GroomError::Argument { what, found, expected: "channels from 0 to 1" })
}

fn check_width(width: f32) -> Result<(), GroomError> {
    if width.is_finite() && width >= 0.0 {
        return Ok(());
    }
    let (what, found) = ("width", width.to_string());
    Err(GroomError::Argument { what, found, expected: "a finite number, 0 or more" })
}
