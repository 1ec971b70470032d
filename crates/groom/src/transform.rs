//! Moving, turning and measuring a whole groom differently.

use glam::{DMat3, DMat4, DVec3, DVec4};

use crate::{Attribute, DEFAULT_RADIUS, Groom, GroomError, UpAxis, Values, names};

/// A matrix whose columns span less than this part of the box with their lengths is called flat.
const FLAT: f64 = 1e-12;

impl Groom {
    /// Multiplies positions, radii and velocities by `factor`; `meters_per_unit` stays, so the groom gets
    /// larger.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `factor` is positive and finite.
    pub fn scale(&mut self, factor: f32) -> Result<(), GroomError> {
        if !(factor.is_finite() && factor > 0.0) {
            return Err(GroomError::argument("scale", factor, "a positive finite number"));
        }
        for position in self.positions_mut() {
            *position *= factor;
        }
        if let Some(Values::Vec3(velocities)) = self.values_mut(names::VELOCITY) {
            velocities.iter_mut().for_each(|velocity| *velocity *= factor);
        }
        self.scale_radii(factor)
    }

    /// Moves the points by `offset`, in the groom's units.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless `offset` is finite.
    pub fn translate(&mut self, offset: DVec3) -> Result<(), GroomError> {
        if !offset.is_finite() {
            return Err(GroomError::argument("translation", offset, "finite numbers"));
        }
        for position in self.positions_mut() {
            *position = (position.as_dvec3() + offset).as_vec3();
        }
        Ok(())
    }

    /// Turns positions and velocities by `radians` about the line through the origin along `axis` (of
    /// any length but 0), counter-clockwise for one who looks against the axis.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless the axis and the angle are finite and the axis has a length.
    pub fn rotate(&mut self, axis: DVec3, radians: f64) -> Result<(), GroomError> {
        let Some(axis) = axis.try_normalize() else {
            return Err(GroomError::argument("rotation axis", axis, "a finite direction, not 0 0 0"));
        };
        if !radians.is_finite() {
            return Err(GroomError::argument("rotation angle", radians, "a finite number"));
        }
        self.turn_by(DMat3::from_axis_angle(axis, radians));
        Ok(())
    }

    /// Applies `matrix` (to column vectors: its last column moves) to the positions, its linear part to
    /// the velocities, and the cube root of its |determinant| to the radii, so that a strand keeps its
    /// part of the volume. Sums are taken in double precision and rounded once.
    ///
    /// # Errors
    /// [`GroomError::Argument`], and the groom unchanged, unless the matrix is finite, its last row is
    /// 0 0 0 1 and it can be inverted.
    pub fn transform(&mut self, matrix: &DMat4) -> Result<(), GroomError> {
        let refuse = |expected| Err(GroomError::argument("matrix", matrix, expected));
        if !matrix.is_finite() {
            return refuse("finite numbers");
        }
        // Programs print 0.99999999 there.
        let last = matrix.row(3);
        if !last.abs_diff_eq(DVec4::W, 1e-6) {
            let expected = "0 0 0 1 (of a matrix for row vectors, give the transpose)";
            return Err(GroomError::argument("last row of the matrix", last, expected));
        }
        let linear = DMat3::from_mat4(*matrix);
        let (volume, box_volume) = (
            linear.determinant().abs(),
            linear.x_axis.length() * linear.y_axis.length() * linear.z_axis.length(),
        );
        let factor = volume.cbrt() as f32;
        // Written so that not-a-number is refused too.
        if !(volume > FLAT * box_volume && factor.is_finite() && factor > 0.0) {
            return refuse("one that can be inverted: its three columns must not lie in a plane");
        }
        for position in self.positions_mut() {
            *position = matrix.transform_point3(position.as_dvec3()).as_vec3();
        }
        self.turn_velocities(linear);
        // A turn's determinant may miss 1 by a rounding; radii should not wander off with it.
        if (volume - 1.0).abs() < 1e-9 { Ok(()) } else { self.scale_radii(factor) }
    }

    /// Turns positions and velocities so that `up_axis` becomes `to`. Other attributes stay: nothing says
    /// which of them are directions. There and back gives the same bits.
    pub fn turn_to(&mut self, to: UpAxis) {
        let from = self.up_axis;
        if from == to {
            return;
        }
        self.positions_mut().iter_mut().for_each(|position| *position = from.rotate(*position, to));
        if let Some(Values::Vec3(velocities)) = self.values_mut(names::VELOCITY) {
            velocities.iter_mut().for_each(|velocity| *velocity = from.rotate(*velocity, to));
        }
        self.up_axis = to;
    }

    fn turn_by(&mut self, linear: DMat3) {
        for position in self.positions_mut() {
            *position = (linear * position.as_dvec3()).as_vec3();
        }
        self.turn_velocities(linear);
    }

    fn turn_velocities(&mut self, linear: DMat3) {
        if let Some(Values::Vec3(velocities)) = self.values_mut(names::VELOCITY) {
            velocities.iter_mut().for_each(|v| *v = (linear * v.as_dvec3()).as_vec3());
        }
    }

    fn scale_radii(&mut self, factor: f32) -> Result<(), GroomError> {
        match self.values_mut(names::RADIUS) {
            Some(Values::Float(values)) => {
                values.iter_mut().for_each(|value| *value *= factor);
                Ok(())
            }
            _ => self.set_attribute(names::RADIUS, Attribute::constant_float(DEFAULT_RADIUS * factor)),
        }
    }
}
