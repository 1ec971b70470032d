//! The columns a table may have.

/// A column of numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Column {
    /// Its heading.
    pub name: &'static str,
    /// What it holds, with its range.
    pub about: &'static str,
    /// What a row without it has; none where the parameter then is not there at all.
    pub default: Option<f64>,
}

const fn column(name: &'static str, about: &'static str, default: f64) -> Column {
    Column { name, about, default: Some(default) }
}

const fn optional(name: &'static str, about: &'static str) -> Column {
    Column { name, about, default: None }
}

/// Every column, in the order of the documentation.
pub const COLUMNS: [Column; 27] = [
    column("theta_o_deg", "inclination of the viewer's direction, -90..90", 0.0),
    column("phi_o_deg", "azimuth of the viewer's direction; counts for elliptical fibres only", 0.0),
    column("h", "offset across the fibre, -1..1", 0.0),
    column("theta_i_deg", "inclination of the light's direction, -90..90", 0.0),
    column("phi_deg", "azimuth of the light's direction less the viewer's", 0.0),
    column("beta_m", "roughness along the fibre, 0.001..1", 0.3),
    column("beta_n", "roughness around it, 0.001..1", 0.3),
    column("alpha_deg", "tilt of the scales, -90..90", 2.0),
    column("eta", "index of refraction, 1.0001..3", 1.55),
    column("sigma_r", "absorption of the cortex per fibre radius, at least 0", 0.0),
    column("sigma_g", "the same, green", 0.0),
    column("sigma_b", "the same, blue", 0.0),
    column("scale_tt", "deviation of TT over that of R, along the fibre", 0.5),
    column("scale_trt", "the same of TRT and the residual", 2.0),
    column("lobe_r", "weight of R", 1.0),
    column("lobe_tt", "weight of TT", 1.0),
    column("lobe_trt", "weight of TRT", 1.0),
    optional("cuticle_layers", "layers of the cuticle; without it the bare surface"),
    optional("film_eta", "index of a film of water; without it a dry fibre"),
    optional("film_roughness", "roughness of the film's surface; 0.1 where there is a film"),
    column("aspect", "smaller over larger axis of the cross-section", 1.0),
    column("kappa", "radius of the medulla over that of the fibre, 0..0.99", 0.0),
    column("medulla_sigma_s", "scattering of the medulla per fibre radius, 0..100", 0.0),
    column("medulla_sigma_r", "absorption of the medulla per fibre radius, at least 0", 0.0),
    column("medulla_sigma_g", "the same, green", 0.0),
    column("medulla_sigma_b", "the same, blue", 0.0),
    column("g", "mean cosine of the medulla's scattering, -0.99..0.99", 0.0),
];

/// Answers of another renderer.
pub(crate) const REFERENCES: [&str; 7] = ["f_r", "f_g", "f_b", "pdf", "exact_r", "exact_g", "exact_b"];
