//! The five-lobe fur model of Yan et al. 2017, "An Efficient and Practical Near and Far Field Fur Reflectance
//! Model" (doi:10.1145/3072959.3073600), to compare with. For pictures there is
//! [`FurBcsdf`](crate::FurBcsdf), which is right where this is not.
//!
//! R, TT and TRT are Gaussians, dimmed by what the medulla scatters and absorbs; TTs and TRTs, the light that
//! was scattered on the first and the second crossing, leave as from a bare medulla cylinder: the boundary
//! on their way out, which reflects a fifth to a half of them back inside, is not in the model.
//!
//! What is ours: the medulla's distributions come from a walk per material, not from the authors' tables;
//! Gaussians are divided by the cosine of the direction they are of, and the scattered lobes normalised over
//! solid angle, so that each lobe's light is its attenuation. Roughnesses are those deviations, in radians, that
//! the parameters of Chiang et al. mean.

use std::f64::consts::{PI, TAU};

use crate::error::ScatteringError;
use crate::fur::medulla::FurParameters;
use crate::fur::yan_medulla::YanMedulla;
use crate::hair::attenuation::Chord;
use crate::hair::parameters::{azimuthal_deviation, longitudinal_variance};
use crate::hair::surface::Surface;

/// What the light that enters the scattered lobes is multiplied by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum YanForm {
    /// TTs carries F, the light that did *not* enter: so printed, and darker than any fibre is.
    Printed,
    /// `(1 - F) F^(p-1)`, as in the authors' program: up to 9 % too bright without absorption, for light that
    /// passes unscattered is counted twice.
    Released,
    /// `(1 - F) F^(p-1) (1 - exp(-2 s_m sigma'_ms))`: what is scattered is what does not pass. Without
    /// absorption all lobes sum to 1 but for the light reflected twice inside.
    Corrected,
}

/// How long scattered light is taken to be in the medulla.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum YanPath {
    /// One radius of the medulla, as printed.
    Radius,
    /// The mean path of the walk, as in the authors' program.
    Mean,
}

/// A fibre of the five-lobe model.
#[derive(Debug, Clone)]
pub struct YanBcsdf {
    parameters: FurParameters,
    form: YanForm,
    path: YanPath,
    surface: Surface<f64>,
    medulla: Option<YanMedulla>,
}

impl YanBcsdf {
    /// Prepares a material; its medulla's distributions are made of `walks` walks each (some 200 of them).
    ///
    /// # Errors
    /// The first parameter outside its bounds.
    pub fn new(
        parameters: &FurParameters,
        form: YanForm,
        path: YanPath,
        walks: u32,
    ) -> Result<YanBcsdf, ScatteringError> {
        parameters.check()?;
        let medulla = parameters
            .medulla
            .scatters()
            .then(|| YanMedulla::walk(&parameters.medulla, f64::from(parameters.hair.eta), walks));
        Ok(YanBcsdf { parameters: *parameters, form, path, surface: Surface::new(&parameters.hair), medulla })
    }

    /// The fibre as seen from `wo` at the offset `h`.
    #[must_use]
    pub fn at(&self, wo: [f64; 3], h: f64) -> YanScatter<'_> {
        let h = h.clamp(-1.0, 1.0);
        let cos_theta = wo[1].hypot(wo[2]).min(1.0);
        let chord = Chord::under(&self.surface, cos_theta, h);
        let mut scatter = YanScatter {
            bcsdf: self,
            turn_o: wo[2].atan2(wo[1]),
            theta_o: wo[0].clamp(-1.0, 1.0).asin(),
            chord,
            albedo: [[0.0; 3]; 5],
        };
        let channels = [0, 1, 2].map(|channel| scatter.attenuations(channel));
        scatter.albedo = std::array::from_fn(|lobe| channels.map(|shares| shares[lobe]));
        scatter
    }
}

/// A fibre of the five-lobe model met by a ray.
#[derive(Debug, Clone, Copy)]
pub struct YanScatter<'a> {
    bcsdf: &'a YanBcsdf,
    turn_o: f64,
    theta_o: f64,
    chord: Chord<f64>,
    albedo: [[f64; 3]; 5],
}

impl YanScatter<'_> {
    /// The share of light in R, TT, TRT, TTs and TRTs.
    #[must_use]
    pub fn albedo(&self) -> [[f64; 3]; 5] {
        self.albedo
    }

    /// f cos(theta_i) of R, TT, TRT, TTs and TRTs for light from the unit direction `wi`.
    #[must_use]
    pub fn evaluate(&self, wi: [f64; 3]) -> [[f64; 3]; 5] {
        let phi = wi[2].atan2(wi[1]) - self.turn_o;
        let theta_i = wi[0].clamp(-1.0, 1.0).asin();
        let cos_theta_i = theta_i.cos().max(1e-9);
        let mut values = self.albedo;
        for (lobe, value) in values.iter_mut().enumerate() {
            let density = match lobe {
                0..3 => self.along(lobe, theta_i, phi) * self.around(lobe, phi) / cos_theta_i,
                _ => self.scattered(lobe - 3, theta_i.sin(), phi),
            };
            *value = value.map(|share| share * density);
        }
        values
    }

    /// Angles of the ray against the normal, outside and inside, in the cross-section.
    fn gammas(&self) -> (f64, f64) {
        let angle = |(sin, cos): (f64, f64)| sin.atan2(cos);
        (angle(self.chord.turn_i), angle(self.chord.turn_t))
    }

    /// Half chords in medulla and cortex, in the cross-section.
    fn halves(&self) -> (f64, f64) {
        let kappa = f64::from(self.bcsdf.parameters.medulla.kappa);
        let (sin_t, cos_t) = self.chord.turn_t;
        let medulla = ((kappa - sin_t) * (kappa + sin_t)).max(0.0).sqrt();
        (medulla, cos_t - medulla)
    }

    fn attenuations(&self, channel: usize) -> [f64; 5] {
        let FurParameters { hair, medulla } = &self.bcsdf.parameters;
        let stretch = self.chord.stretch;
        let in_cortex = f64::from(hair.sigma_a[channel]) * stretch;
        let in_medulla = f64::from(medulla.sigma_a[channel]) * stretch;
        let scattering = f64::from(medulla.sigma_s) * stretch;
        let (s_m, s_c) = self.halves();
        let kappa = f64::from(medulla.kappa);
        let reflected = self.chord.fresnel;
        let entered = 1.0 - reflected;
        let pass = (-2.0 * s_c * in_cortex - 2.0 * s_m * (in_medulla + scattering)).exp();
        let unscattered = [reflected, entered * entered * pass, entered * entered * reflected * pass * pass];
        let mut scattered = [0.0; 2];
        if let (Some(distributions), true) = (&self.bcsdf.medulla, s_m > 0.0) {
            let path = match self.bcsdf.path {
                YanPath::Radius => kappa,
                YanPath::Mean => kappa * distributions.path(self.offset(), self.theta_o.sin()),
            };
            let to_medulla = (-(s_c + 1.0 - kappa) * in_cortex - path * in_medulla).exp();
            let (first, factor) = match self.bcsdf.form {
                YanForm::Printed => (reflected, 1.0),
                YanForm::Released => (entered, 1.0),
                YanForm::Corrected => (entered, -(-2.0 * s_m * scattering).exp_m1()),
            };
            scattered = [first * factor * to_medulla, entered * factor * reflected * pass * to_medulla];
        }
        [unscattered[0], unscattered[1], unscattered[2], scattered[0], scattered[1]]
    }

    /// Offset in the medulla, in its radii.
    fn offset(&self) -> f64 {
        self.chord.turn_t.0 / f64::from(self.bcsdf.parameters.medulla.kappa)
    }

    /// M of R, TT, TRT, against the inclination.
    fn along(&self, lobe: usize, theta_i: f64, phi: f64) -> f64 {
        let hair = &self.bcsdf.parameters.hair;
        let (alpha, beta) = (f64::from(hair.alpha), longitudinal_variance(f64::from(hair.beta_m)).sqrt());
        let (centre, width) = match lobe {
            0 => {
                let half = (0.5 * phi).cos().abs();
                let (sin, cos) = self.theta_o.sin_cos();
                // Their alpha is a scale's, and leans R to the root by twice as much.
                let (sin_a, cos_a) = (-alpha).sin_cos();
                let u = half * cos_a * cos + sin_a * sin;
                let centre = -(sin - 2.0 * u * sin_a).clamp(-1.0, 1.0).asin();
                (centre, (2.0_f64.sqrt() * beta * half).max(0.02_f64.to_radians()))
            }
            1 => (-self.theta_o + alpha, beta),
            _ => (-self.theta_o + 3.0 * alpha, 1.5 * beta),
        };
        gaussian(theta_i - centre, width)
    }

    /// N of R, TT, TRT.
    fn around(&self, lobe: usize, phi: f64) -> f64 {
        let width =
            azimuthal_deviation(f64::from(self.bcsdf.parameters.hair.beta_n)) * ((lobe + 1) as f64).sqrt();
        let p = lobe as f64;
        let (gamma_i, gamma_t) = self.gammas();
        let centre = 2.0 * p * gamma_t - 2.0 * gamma_i + p * PI;
        let away = (phi - centre + PI).rem_euclid(TAU) - PI;
        // Turns enough that the roughest lobe has none of its light left out.
        (-8..=8).map(|turn| gaussian(away + TAU * f64::from(turn), width)).sum()
    }

    /// D M of TTs (0) and TRTs (1), over solid angle.
    fn scattered(&self, reflections: usize, sin_theta_i: f64, phi: f64) -> f64 {
        let Some(distributions) = &self.bcsdf.medulla else { return 0.0 };
        let (gamma_i, gamma_t) = self.gammas();
        // Against where the light in the medulla came from.
        let turned = phi - (gamma_t - gamma_i) - reflections as f64 * (PI + 2.0 * gamma_t);
        let around = distributions.around(self.offset(), self.theta_o.sin(), turned);
        let away = ((phi + PI).rem_euclid(TAU) - PI).abs() / PI;
        around * distributions.along(self.theta_o.sin(), away, sin_theta_i)
    }
}

fn gaussian(x: f64, deviation: f64) -> f64 {
    (-0.5 * (x / deviation).powi(2)).exp() / (deviation * TAU.sqrt())
}
