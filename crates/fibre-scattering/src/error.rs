//! What can be wrong with a fibre's description.

/// Why a fibre was refused. Every variant names the parameter and what was found.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ScatteringError {
    /// A parameter is outside its range, or NaN.
    #[error("{name} must lie in {range}, found {found}")]
    OutOfRange {
        /// The parameter.
        name: &'static str,
        /// The value found.
        found: f32,
        /// Where it must lie.
        range: &'static str,
    },
    /// Two settings exclude each other and both were given.
    #[error("give {one} or {other}, not both")]
    Conflict {
        /// One of them.
        one: &'static str,
        /// The other.
        other: &'static str,
    },
    /// A medulla that scatters came without its table, or with that of another material.
    #[error("the medulla's table is missing or was made for other parameters")]
    Table,
    /// A roughness is outside (0, 1].
    #[error("{name} must lie in (0, 1], found {found}")]
    Roughness {
        /// `beta_m` or `beta_n`.
        name: &'static str,
        /// The value found.
        found: f32,
    },
    /// The tilt of the cuticle's scales is outside (-pi/2, pi/2).
    #[error("alpha must lie in (-pi/2, pi/2) radians, found {found}")]
    Tilt {
        /// The value found, in radians.
        found: f32,
    },
    /// The index of refraction is outside [1.0001, 3].
    #[error("eta must lie in [1.0001, 3], found {found}")]
    IndexOfRefraction {
        /// The value found.
        found: f32,
    },
    /// An absorption coefficient is negative or not finite.
    #[error("sigma_a[{channel}] must be finite and at least 0, found {found}")]
    Absorption {
        /// 0 red, 1 green, 2 blue.
        channel: usize,
        /// The value found.
        found: f32,
    },
    /// A lobe weight is negative or not finite.
    #[error("lobe_weights[{lobe}] must be finite and at least 0, found {found}")]
    LobeWeight {
        /// Position in [`Lobe::ALL`](crate::Lobe::ALL).
        lobe: usize,
        /// The value found.
        found: f32,
    },
}
