//! A material's parameters, as the page lists them.

use fibre_scattering::FurParameters;
use glam::Vec3;

/// Name and value of every parameter, angles in degrees; what is not there is left out.
pub(super) fn listed(parameters: &FurParameters) -> Vec<(String, String)> {
    let FurParameters { hair, medulla } = parameters;
    let rgb = |v: Vec3| format!("{}, {}, {}", v.x, v.y, v.z);
    let mut list = vec![
        ("beta_m (roughness along)", hair.beta_m.to_string()),
        ("beta_n (roughness around)", hair.beta_n.to_string()),
        ("alpha (tilt)", format!("{}°", crate::scatterer::round(f64::from(hair.alpha).to_degrees(), 1e4))),
        ("eta (index)", hair.eta.to_string()),
        ("sigma_a (absorption per radius)", rgb(hair.sigma_a)),
    ];
    let scales = hair.roughness_scales;
    list.push(("roughness of TT, TRT over R", format!("{}, {}", scales.tt, scales.trt)));
    if hair.lobe_weights != [1.0; 5] {
        list.push(("lobe weights", hair.lobe_weights.map(|w| w.to_string()).join(", ")));
    }
    if let Some(layers) = hair.cuticle_layers {
        list.push(("cuticle layers", layers.to_string()));
    }
    if let Some(film) = hair.film {
        list.push(("film of water", format!("index {}, roughness {}", film.eta, film.roughness)));
    }
    if hair.aspect < 1.0 {
        list.push(("aspect of the cross-section", hair.aspect.to_string()));
    }
    if medulla.kappa > 0.0 {
        list.push(("kappa (medulla's radius)", medulla.kappa.to_string()));
        list.push(("medulla sigma_s", medulla.sigma_s.to_string()));
        list.push(("medulla sigma_a", rgb(medulla.sigma_a)));
        list.push(("g", medulla.g.to_string()));
    }
    list.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
}
