//! What the surface of a fibre reflects: bare, under scales of cuticle, under a film of water.

use crate::arithmetic::real::Real;
use crate::hair::attenuation::fresnel;
use crate::hair::parameters::HairParameters;

/// A fibre's surface. Light is reflected alike from both sides: from inside at the angle to which light from
/// outside is bent.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surface<T> {
    /// `eta^2 - 1` of the fibre against the air: what bends the light that enters, film or no film, whose
    /// two faces are parallel.
    pub eta2_minus_1: T,
    layers: Option<T>,
    /// `eta^2 - 1` of the film against the air.
    film: Option<T>,
}

impl<T: Real> Surface<T> {
    /// `parameters` have passed their check.
    pub fn new(parameters: &HairParameters) -> Self {
        let over_one = |eta: f32| T::of((f64::from(eta) - 1.0) * (f64::from(eta) + 1.0));
        Surface {
            eta2_minus_1: over_one(parameters.eta),
            layers: parameters.cuticle_layers.map(|layers| T::of(f64::from(layers))),
            film: parameters.film.map(|film| over_one(film.eta)),
        }
    }

    /// The share reflected of unpolarised light that meets the surface at this cosine, in the air.
    pub fn reflectance(&self, cos: T) -> T {
        let e = self.eta2_minus_1;
        match (self.film, self.layers) {
            (None, None) => fresnel(e, cos),
            (None, Some(layers)) => layered(layers, polarised(T::ZERO, e, cos)),
            (Some(film), None) => mean(under_film(polarised(T::ZERO, film, cos), polarised(film, e, cos))),
            (Some(film), Some(layers)) => {
                let scales = layered(layers, polarised(film, e, cos));
                mean(under_film(polarised(T::ZERO, film, cos), [scales; 2]))
            }
        }
    }

    /// The same for light that meets the surface from inside; all of it where none could leave. `cos2` is
    /// the squared cosine of the angle at which it would leave, less than 0 where it cannot.
    pub fn reflectance_of_leaving(&self, cos2: T) -> T {
        if cos2 > T::ZERO { self.reflectance(cos2.sqrt()) } else { T::ONE }
    }
}

/// Reflectances, one across and one along the plane of incidence, between two media of
/// `eta^2 = 1 + from` and `1 + into`, both at least 1; `cos` is that of the ray in the air.
///
/// Where `from` is 0 these are the two whose mean is [`fresnel`].
fn polarised<T: Real>(from: T, into: T, cos: T) -> [T; 2] {
    let cos2 = cos * cos;
    // eta cos(theta) in either medium, by Snell's law.
    let before = (from + cos2).sqrt();
    let behind = (into + cos2).sqrt();
    let (from2, into2) = (T::ONE + from, T::ONE + into);
    let across_below = before + behind;
    let along_below = into2 * before + from2 * behind;
    let step = into - from;
    let across = step / (across_below * across_below);
    // Differences over sums, multiplied out as in `fresnel`.
    let along = step * (from2 * into2 - (from2 + into2) * (T::ONE - cos2)) / (along_below * along_below);
    [(across * across).min(T::ONE), (along * along).min(T::ONE)]
}

fn mean<T: Real>([across, along]: [T; 2]) -> T {
    T::of(0.5) * (across + along)
}

/// Scales in layers: Yan et al. 2017. Each polarisation meets both faces of a scale, and passes or returns
/// any number of times: `2 R / (1 + R)`. The mean of both, `r`, is a scale's reflectance, and `l` of them,
/// any real number, reflect `l r / (1 + (l - 1) r)`.
fn layered<T: Real>(layers: T, reflectances: [T; 2]) -> T {
    let scale = mean(reflectances.map(|r| T::TWO * r / (T::ONE + r)));
    let reflected = layers * scale;
    reflected / (reflected + (T::ONE - scale))
}

/// Film over fibre, in each polarisation: what the film reflects, and what comes back through it after any
/// number of reflections between its faces. It absorbs nothing: the rest enters.
fn under_film<T: Real>(film: [T; 2], fibre: [T; 2]) -> [T; 2] {
    let both = |film: T, fibre: T| {
        let through = T::ONE - film;
        // 1 - film fibre, as two parts of which neither is negative.
        let back = through + film * (T::ONE - fibre);
        if back > T::ZERO { film + through * through * fibre / back } else { T::ONE }
    };
    [both(film[0], fibre[0]).min(T::ONE), both(film[1], fibre[1]).min(T::ONE)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::hair::parameters::WaterFilm;

    const COSINES: [f64; 7] = [1.0, 0.9, 0.5, 0.2, 0.01, 1e-4, 0.0];

    fn surface(change: impl Fn(&mut HairParameters)) -> Surface<f64> {
        let mut parameters = HairParameters::default();
        change(&mut parameters);
        Surface::new(&parameters)
    }

    fn water(eta: f32) -> Option<WaterFilm> {
        Some(WaterFilm { eta, ..WaterFilm::default() })
    }

    #[test]
    fn polarisations_average_to_fresnel() {
        for cos in COSINES {
            let both = mean(polarised(0.0, 1.55 * 1.55 - 1.0, cos));
            assert!((both - fresnel(1.55 * 1.55 - 1.0, cos)).abs() < 1e-14, "{cos}: {both}");
        }
    }

    /// Worked by hand for light along the normal, where both polarisations are `((a - b) / (a + b))^2`.
    #[test]
    fn along_the_normal_the_formulas_are_those_of_the_papers() {
        let bare: f64 = (0.55_f64 / 2.55).powi(2);
        let scale = 2.0 * bare / (1.0 + bare);
        // Half a layer of 2017 is the bare surface, there where polarisations do not differ.
        for (layers, expected) in
            [(0.5, bare), (1.0, scale), (2.45, 2.45 * scale / (1.0 + 1.45 * scale)), (100.0, 0.904_6)]
        {
            let found = surface(|p| p.cuticle_layers = Some(layers)).reflectance(1.0);
            let near = if layers == 100.0 { 5e-3 } else { 1e-6 };
            assert!((found - expected).abs() < near, "{layers}: {found} {expected}");
        }
        let (film, fibre) = ((0.33_f64 / 2.33).powi(2), (0.22_f64 / 2.88).powi(2));
        let wet = film + (1.0 - film).powi(2) * fibre / (1.0 - film * fibre);
        let found = surface(|p| p.film = water(1.33)).reflectance(1.0);
        assert!((found - wet).abs() < 1e-6, "{found} {wet}");
        assert!(found < 0.6 * bare, "water hides part of the step to the fibre");
    }

    /// A film of the fibre's own index is fibre; one of nearly no index is not there.
    #[test]
    fn a_film_that_is_fibre_or_air_changes_nothing() {
        let dry = surface(|_| ());
        let same = surface(|p| p.film = water(1.55));
        let none = surface(|p| p.film = water(1.0001));
        for cos in COSINES {
            assert!((same.reflectance(cos) - dry.reflectance(cos)).abs() < 1e-12);
            if cos > 0.1 {
                assert!((none.reflectance(cos) - dry.reflectance(cos)).abs() < 1e-3);
            }
        }
    }

    #[test]
    fn every_surface_reflects_a_share_and_all_of_grazing_light() {
        for layers in [None, Some(0.01), Some(0.5), Some(2.45), Some(100.0)] {
            for film in [None, water(1.0001), water(1.33), water(3.0)] {
                for eta in [1.0001, 1.33, 1.55, 3.0] {
                    let parameters =
                        HairParameters { eta, cuticle_layers: layers, film, ..HairParameters::default() };
                    let (double, single) =
                        (Surface::<f64>::new(&parameters), Surface::<f32>::new(&parameters));
                    for cos in COSINES {
                        let exact = double.reflectance(cos);
                        let found = single.reflectance(cos as f32);
                        assert!((0.0..=1.0).contains(&exact) && (0.0..=1.0).contains(&found));
                        assert!((f64::from(found) - exact).abs() < 2e-5, "{found} {exact} {parameters:?}");
                    }
                    assert!(double.reflectance(0.0) > 1.0 - 1e-12, "{parameters:?}");
                }
            }
        }
        assert_eq!(surface(|_| ()).reflectance_of_leaving(-0.1), 1.0);
    }
}
