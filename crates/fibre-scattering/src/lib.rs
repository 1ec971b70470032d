//! Hair and fur scattering after Chiang et al. 2016 and Yan et al. 2017: evaluate, sample, pdf, albedo.
//!
//! [`HairParameters`] make a [`HairBcsdf`], once per material; [`HairBcsdf::at`] makes a
//! [`HairScatter`] of it, once per hit; that evaluates and draws directions. The five [`Lobe`]s
//! stay apart all the way, for passes. [`FurBcsdf`] adds a medulla; [`FarFieldBcsdf`] is hair with the
//! offset integrated out; [`FibreBcsdf`] is any of them. Scenes, rays and threads are not known here.
//!
//! ```
//! use fibre_scattering::{HairBcsdf, HairParameters, absorption_from_color};
//! use glam::Vec3;
//!
//! let blond = HairParameters {
//!     sigma_a: absorption_from_color(Vec3::new(0.86, 0.65, 0.35), 0.3)?,
//!     ..HairParameters::default()
//! };
//! let fibre = HairBcsdf::new(&blond)?.at(Vec3::Y, 0.4);
//! if let Some(sample) = fibre.sample([0.1, 0.6, 0.3, 0.8]) {
//!     assert_eq!(sample.pdf, fibre.pdf(sample.wi));
//!     assert!(sample.weight().max_element() <= 1.0 + 1e-5);
//! }
//! # Ok::<(), fibre_scattering::ScatteringError>(())
//! ```
//!
//! # The fibre's frame
//!
//! x is the tangent from root to tip; y and z are any two axes that make it a right-handed frame.
//! Both directions are unit vectors and point *away* from the fibre: `wo` to the viewer, `wi` to the
//! light. The inclination theta of a direction has `sin(theta) = x`; its azimuth is
//! `phi = atan2(z, y)`. Only the difference of azimuths counts, `phi_i - phi_o`, but for a fibre of
//! elliptical cross-section ([`HairParameters::aspect`]): its larger axis lies along y, which has to be
//! fixed to the strand then, and not to the viewer.
//!
//! `h` says where across the fibre the ray passes, in radii (for an ellipse, in halves of the width it is
//! seen with), and has a sign. Look against the
//! tangent, the tip towards you, with the viewer to the right:
//!
//! ```text
//!        z
//!        |  ___
//!        |/     \   h = -0.7
//!        |   x   | - - - - - - - - >  wo    phi_o = 0
//!        |\ ___ /   h = +0.7
//!        +--------------------- y
//! ```
//!
//! With `e = tangent x (wo less its part along the tangent, normalised)`, a ray whose line passes
//! the axis at the offset `d` has `h = -dot(d, e) / radius`. So a mirror at `h` sends light to the
//! azimuth `phi_i - phi_o = -2 asin(h)`, as in Chiang's and pbrt's formulas. Changing the signs of
//! `h` and of `phi_i - phi_o` together changes nothing.
//!
//! For positive `alpha`, the tilt of real hair, R leaves `2 alpha` nearer to the *root* than a
//! mirror would send it, TT `alpha` and TRT `4 alpha` nearer to the tip. This is Marschner's
//! direction and that of Cycles; pbrt and Mitsuba, whose formulas are otherwise these, have it the
//! other way round for tangents that run from root to tip.
//!
//! # Beyond Chiang
//!
//! - [`RoughnessScales`]: TT and TRT as rough as one likes beside R, as in MaterialX.
//! - [`HairParameters::cuticle_layers`]: scales in layers, which reflect more, after Yan et al. 2017.
//! - [`WaterFilm`]: wet hair, darker and shinier. Hair under water has no film: divide its index by water's.
//! - [`HairParameters::aspect`]: an elliptical cross-section, through which rays are traced.
//!
//! # What it promises
//!
//! Without absorption a fibre returns all light, within 1e-4, for every roughness, tilt, index,
//! surface, cross-section, offset and direction: the longitudinal term is exact and the residual lobe holds
//! what R, TT and TRT leave over. Parameters out of range are refused by name, never brought to a bound.
//! `sample` draws from exactly the density `pdf` returns. Nothing returns NaN for finite unit directions.
//! [`ReferenceBcsdf`] is the same code in `f64`, to measure it by.

mod absorption;
mod arithmetic;
mod error;
mod fibre_bcsdf;
mod fur;
mod hair;
mod lobe;
mod parametrisation;
mod per_strand;
mod range;
mod sample;

pub use absorption::{
    Pigments, absorption_from_color, absorption_from_melanin, absorption_from_pigments, color_from_absorption,
};
pub use error::ScatteringError;
pub use fibre_bcsdf::{FibreBcsdf, FibreScatter};
pub use fur::bcsdf::{FurBcsdf, FurScatter};
pub use fur::medulla::{FurParameters, Medulla};
pub use fur::reference::{FurReference, FurReferenceScatter};
pub use fur::row::MedullaRow;
pub use fur::table::{MedullaKey, MedullaTable};
pub use fur::yan::{YanBcsdf, YanForm, YanPath, YanScatter};
pub use hair::bcsdf::{HairBcsdf, HairScatter};
pub use hair::far_field::{FarFieldBcsdf, FarFieldScatter};
pub use hair::parameters::{HairParameters, RoughnessScales, WaterFilm};
pub use hair::reference::{ReferenceBcsdf, ReferenceScatter};
pub use lobe::{Lobe, LobeValues};
pub use parametrisation::{
    ArnoldHair, CyclesHair, CyclesParametrization, MaterialXHair, MaterialXMelanin, MaterialXRoughness,
    MitsubaHair, PbrtHair, PxrMarschnerHair, beta_m_from_variance, beta_n_from_scale,
};
pub use per_strand::Absorption;
pub use sample::FibreSample;
