//! Moving and measuring a whole groom differently.

use crate::{Attribute, Groom, GroomError, UpAxis, Values, names};

impl Groom {
    /// Multiplies positions and radii by `factor`; `meters_per_unit` stays, so the groom gets larger.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `factor` is positive and finite.
    pub fn scale(&mut self, factor: f32) -> Result<(), GroomError> {
        if !(factor.is_finite() && factor > 0.0) {
            let (what, found) = ("scale", factor.to_string());
            return Err(GroomError::Argument { what, found, expected: "a positive finite number" });
        }
        for position in self.positions_mut() {
            *position *= factor;
        }
        if self.attribute(names::RADIUS).is_none() {
            return self.set_attribute(
                names::RADIUS,
                Attribute::constant_float(crate::groom::DEFAULT_RADIUS * factor),
            );
        }
        if let Some(mut radius) = self.remove_attribute(names::RADIUS) {
            if let Values::Float(values) = &mut radius.values {
                values.iter_mut().for_each(|value| *value *= factor);
            }
            self.set_attribute(names::RADIUS, radius)?;
        }
        Ok(())
    }

    /// Turns the positions so that `up_axis` becomes `to`. Attributes stay: nothing says which of
    /// them are directions. There and back gives the same bits.
    pub fn turn_to(&mut self, to: UpAxis) {
        let from = self.up_axis;
        if from != to {
            self.positions_mut().iter_mut().for_each(|position| *position = from.rotate(*position, to));
            self.up_axis = to;
        }
    }
}
