//! A fibre where a ray met it: the scattering function and the frame it is stated in.

use fibre_scattering::{Absorption, FibreBcsdf, FibreScatter};
use glam::Vec3;

/// What a fibre is like at a hit.
pub(crate) struct FibrePoint<'a> {
    /// How it scatters.
    pub material: &'a FibreBcsdf,
    /// What it swallows there.
    pub absorption: Absorption,
    /// An offset across the fibre in place of the hit's own.
    pub fixed_offset: Option<f32>,
    /// Roughly where the larger axis of an elliptical cross-section points; `None` for a round one.
    pub major_axis: Option<Vec3>,
}

/// A fibre at a hit.
pub(crate) struct FibreHit<'a> {
    scatter: FibreScatter<'a>,
    /// Along the fibre and two axes across it; the bcsdf's x, y and z.
    axes: [Vec3; 3],
}

impl<'a> FibreHit<'a> {
    /// `toward` is the unit direction back along the ray that hit.
    ///
    /// `h` counts along z x x of the tracer's frame, which is the negative of the bcsdf's third axis
    /// where the viewer is at azimuth 0: light that enters at positive h leaves towards negative z, as
    /// the geometric reflection has it.
    #[inline]
    pub fn new(point: FibrePoint<'a>, tangent: Vec3, h: f32, toward: Vec3) -> Self {
        let FibrePoint { material, absorption, fixed_offset, major_axis } = point;
        let h = fixed_offset.unwrap_or(h);
        let along = toward.dot(tangent);
        let Some(major_axis) = major_axis else {
            // A round fibre is the same from all sides: the viewer's azimuth is 0 by the choice of axes.
            let facing = (toward - tangent * along)
                .try_normalize()
                .unwrap_or_else(|| tangent.any_orthonormal_vector());
            let axes = [tangent, facing, tangent.cross(facing)];
            let wo = Vec3::new(along, toward.dot(facing), 0.0).normalize();
            return FibreHit { scatter: material.at(wo, h, absorption), axes };
        };
        let across = major_axis - tangent * major_axis.dot(tangent);
        // What is left of an axis along the fibre is rounding.
        let across = if across.length_squared() > 1e-6 {
            across.normalize()
        } else {
            tangent.any_orthonormal_vector()
        };
        let axes = [tangent, across, tangent.cross(across)];
        let wo = Vec3::from_array(axes.map(|axis| axis.dot(toward))).normalize();
        FibreHit { scatter: material.at(wo, h, absorption), axes }
    }

    pub fn scatter(&self) -> &FibreScatter<'a> {
        &self.scatter
    }

    pub fn to_fibre(&self, v: Vec3) -> Vec3 {
        Vec3::from_array(self.axes.map(|axis| axis.dot(v)))
    }

    pub fn to_world(&self, v: Vec3) -> Vec3 {
        (self.axes[0] * v.x + self.axes[1] * v.y + self.axes[2] * v.z).normalize()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use fibre_scattering::{HairBcsdf, HairParameters};

    /// A round fibre scatters the same in whichever frame it is stated.
    #[test]
    fn turning_the_frame_of_a_round_fibre_changes_nothing() {
        let parameters = HairParameters { sigma_a: Vec3::new(0.1, 0.3, 0.7), ..HairParameters::default() };
        let material = FibreBcsdf::Hair(HairBcsdf::new(&parameters).unwrap());
        let absorption = Absorption::new(parameters.sigma_a, Vec3::ZERO).unwrap();
        let tangent = Vec3::new(0.3, 0.9, -0.2).normalize();
        let toward = Vec3::new(-0.5, 0.1, 0.8).normalize();
        let at = |major_axis| {
            let point = FibrePoint { material: &material, absorption, fixed_offset: None, major_axis };
            FibreHit::new(point, tangent, 0.35, toward)
        };
        let plain = at(None);
        for major_axis in [Vec3::X, Vec3::new(-0.2, 0.4, 0.9), tangent, Vec3::ZERO] {
            let turned = at(Some(major_axis));
            for wi in [Vec3::Z, Vec3::new(-0.6, 0.0, 0.8), Vec3::new(0.0, -0.6, -0.8)] {
                let (a, a_pdf) = plain.scatter().evaluate_with_pdf(plain.to_fibre(wi));
                let (b, b_pdf) = turned.scatter().evaluate_with_pdf(turned.to_fibre(wi));
                assert!((a.sum() - b.sum()).abs().max_element() < 1e-4 * a.sum().max_element());
                assert!((a_pdf - b_pdf).abs() < 1e-4 * a_pdf);
                assert!((turned.to_world(turned.to_fibre(wi)) - wi).length() < 1e-6);
            }
        }
    }
}
