//! Bringing a groom into a mesh's numbers.

use std::path::Path;

use glam::{DMat4, DVec3};
use groom::{Groom, UpAxis, names};
use moving_mesh::MovingMesh;

use crate::BindingError;

/// What a mesh's numbers mean.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Space {
    /// Which axis points up.
    pub up_axis: UpAxis,
    /// Metres in a unit.
    pub meters_per_unit: f64,
    /// Whether the file says its unit; OBJ does not.
    pub unit_is_said: bool,
}

impl Space {
    /// That of a mesh read from a file of this name.
    #[must_use]
    pub fn of(mesh: &MovingMesh, path: &Path) -> Space {
        let is_obj = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("obj"));
        Space {
            up_axis: if mesh.is_z_up() { UpAxis::Z } else { UpAxis::Y },
            meters_per_unit: mesh.meters_per_unit(),
            unit_is_said: !is_obj,
        }
    }
}

/// How a groom is brought to a mesh.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Alignment {
    /// Which axis of the groom points up, where its file does not say.
    pub up: Option<UpAxis>,
    /// Whether somebody said how large the groom's unit is.
    pub unit_is_said: bool,
    /// Multiplies points and widths, after that.
    pub scale: Option<f64>,
    /// Moves the points, in the mesh's numbers.
    pub translate: Option<DVec3>,
    /// All of that at once: from the groom's numbers to the mesh's, for column vectors.
    pub matrix: Option<DMat4>,
}

impl Alignment {
    /// Does it, in that order; the groom is in the mesh's numbers then. Where both say their unit the groom gets the
    /// mesh's, else its numbers are taken for the mesh's.
    ///
    /// # Errors
    /// [`BindingError::Alignment`] for numbers that are out of range, which it names.
    pub fn apply(&self, groom: &mut Groom, space: Space) -> Result<(), BindingError> {
        let fault = |option: &'static str| move |source| BindingError::Alignment { option, source };
        // A motion of its own is not that of the mesh.
        groom.remove_attribute(names::VELOCITY);
        groom.up_axis = self.up.unwrap_or(groom.up_axis);
        if let Some(matrix) = &self.matrix {
            groom.transform(matrix).map_err(fault("matrix"))?;
            groom.up_axis = space.up_axis;
            groom.meters_per_unit = space.meters_per_unit;
            return Ok(());
        }
        let both_say = self.unit_is_said && space.unit_is_said;
        let units = if both_say { groom.meters_per_unit / space.meters_per_unit } else { 1.0 };
        let factor = (units * self.scale.unwrap_or(1.0)) as f32;
        if factor != 1.0 {
            groom.scale(factor).map_err(fault("scale"))?;
        }
        groom.turn_to(space.up_axis);
        if let Some(offset) = self.translate {
            groom.translate(offset).map_err(fault("translate"))?;
        }
        if space.unit_is_said || !self.unit_is_said {
            groom.meters_per_unit = space.meters_per_unit;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    fn aligned(alignment: Alignment, unit: f64, space: Space) -> Groom {
        let mut groom = Groom::new(vec![0, 1], vec![Vec3::new(1.0, 2.0, 3.0)]).unwrap();
        groom.up_axis = UpAxis::Z;
        groom.meters_per_unit = unit;
        alignment.apply(&mut groom, space).unwrap();
        groom
    }

    const METRES: Space = Space { up_axis: UpAxis::Y, meters_per_unit: 1.0, unit_is_said: true };
    const SAID: Alignment =
        Alignment { up: None, unit_is_said: true, scale: None, translate: None, matrix: None };

    #[test]
    fn units_are_taken_where_both_say_and_axes_turned() {
        let root = |groom: &Groom| groom.positions()[0];
        let (turned, unsaid) = (Vec3::new(1.0, 3.0, -2.0), Alignment { unit_is_said: false, ..SAID });
        assert_eq!(root(&aligned(SAID, 0.01, METRES)), turned * 0.01);
        assert_eq!(root(&aligned(unsaid, 0.01, METRES)), turned);
        assert_eq!(root(&aligned(SAID, 2.0, METRES)), turned * 2.0);
        let obj = Space { unit_is_said: false, ..METRES };
        assert_eq!(root(&aligned(SAID, 0.01, obj)), turned);
        assert_eq!(aligned(SAID, 0.01, obj).meters_per_unit, 0.01);
        let y_up = Alignment { up: Some(UpAxis::Y), ..unsaid };
        assert_eq!(root(&aligned(y_up, 0.01, METRES)), Vec3::new(1.0, 2.0, 3.0));
        let moved = Alignment { scale: Some(2.0), translate: Some(DVec3::Z), ..unsaid };
        assert_eq!(root(&aligned(moved, 0.01, METRES)), Vec3::new(2.0, 6.0, -3.0));
    }

    #[test]
    fn a_matrix_says_everything() {
        let rows = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 9.0, 0.0, 0.0, 0.0, 1.0];
        let matrix = Some(DMat4::from_cols_array(&rows).transpose());
        let groom = aligned(Alignment { matrix, ..SAID }, 0.01, METRES);
        assert_eq!(groom.positions()[0], Vec3::new(2.0, 3.0, 10.0));
        assert_eq!((groom.up_axis, groom.meters_per_unit), (UpAxis::Y, 1.0));
    }

    #[test]
    fn what_cannot_be_done_names_its_option() {
        let mut groom = Groom::new(vec![0, 1], vec![Vec3::ONE]).unwrap();
        let told = Alignment { scale: Some(-1.0), ..SAID }.apply(&mut groom, METRES).unwrap_err();
        assert!(told.to_string().starts_with("scale: "), "{told}");
    }
}
