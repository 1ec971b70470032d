//! What can be wrong with a fibre's description.

/// Why a fibre was refused. Every refusal names the parameter, what was found and what is allowed.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ScatteringError {
    /// A parameter is outside its range, or NaN.
    #[error("{name} must lie in {range}, found {found}")]
    OutOfRange {
        /// The parameter, as a path of fields: `beta_m`, `sigma_a.r`, `film.eta`.
        name: &'static str,
        /// The value found.
        found: f32,
        /// Where it must lie, as an interval.
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
}
