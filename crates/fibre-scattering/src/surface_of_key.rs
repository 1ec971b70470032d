//! How a fibre's surface reflects light from within.

use crate::medulla_table::MedullaKey;
use crate::surface::Surface;

/// The surface as a walk meets it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InnerSurface {
    eta2: f32,
    surface: Surface<f32>,
}

impl InnerSurface {
    pub fn new(key: &MedullaKey) -> Self {
        InnerSurface { eta2: key.eta * key.eta, surface: Surface::new(&key.parameters().hair) }
    }

    /// The share reflected of light that meets it from outside at this cosine.
    pub fn reflectance(&self, cos: f32) -> f32 {
        self.surface.reflectance(cos)
    }

    /// The share reflected of light that meets it from inside at this cosine: that of the ray it would
    /// leave as; all of it where there is none.
    pub fn reflectance_inside(&self, cos: f32) -> f32 {
        let cos2 = 1.0 - self.eta2 * (1.0 - cos) * (1.0 + cos);
        self.surface.reflectance_of_leaving(cos2)
    }
}
