//! What a fibre scatters, by quadrature: in all, by lobe, and the integral of the density.

use fibre_scattering::Absorption;

use crate::landmarks::narrowest;
use crate::scatterer::{Model, View};
use crate::sphere::{Integrals, Sphere};

/// Integrals over all directions, as seen from one.
#[derive(Debug, Clone, Copy)]
pub struct Energy {
    /// From where.
    pub view: View,
    /// Single precision.
    pub single: Integrals,
    /// Double precision, where there is such a path.
    pub double: Option<Integrals>,
    /// What each lobe says it scatters.
    pub stated: [[f64; 3]; 5],
}

impl Energy {
    /// What the lobes say they scatter together, per channel.
    #[must_use]
    pub fn stated_total(&self) -> [f64; 3] {
        [0, 1, 2].map(|channel| self.stated.iter().map(|lobe| lobe[channel]).sum())
    }

    /// The largest difference of a lobe's integral from what it says, in any channel.
    #[must_use]
    pub fn lobe_error(&self) -> f64 {
        let pairs = self.single.lobes.as_flattened().iter().zip(self.stated.as_flattened());
        crate::verdict::worst(pairs.map(|(found, stated)| ((found - stated).abs(), ()))).0
    }
}

/// Integrates the fibre with this absorption as seen from `view`; in double precision only if asked, which is
/// slow.
#[must_use]
pub fn energy(model: &dyn Model, view: View, absorption: Absorption, double: bool) -> Energy {
    let scatterer = model.at(view, absorption);
    let sphere = Sphere::new(&model.landmarks(view));
    let double = if double { model.double_at(view, absorption) } else { None };
    Energy {
        view,
        single: sphere.refined(parts(model)).single(&*scatterer),
        double: double.map(|double| sphere.double(&*double)),
        stated: scatterer.albedo().map(|lobe| lobe.as_dvec3().to_array()),
    }
}

/// Rounding a direction to single precision moves a lobe narrower than this by a noticeable part of its value:
/// noise, which more nodes average.
fn parts(model: &dyn Model) -> u32 {
    if narrowest(model.parameters()) < 5e-3 { 3 } else { 1 }
}
