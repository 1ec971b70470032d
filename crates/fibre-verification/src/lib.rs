//! Holds a fibre's scattering against the laws it must obey, and says what it found.
mod checks;
mod compare;
mod error;
mod eval;
mod landmarks;
mod page;
mod quadrature;
mod random;
mod report;
mod scatterer;
mod sphere;
mod statistics;
mod subject;
mod verdict;

pub use checks::*;
pub use compare::*;
pub use error::VerificationError;
pub use eval::{Answer, Answers, Both, COLUMNS, Column, Reference, Row, Tilt, eval, rows};
pub use landmarks::Landmarks;
pub use quadrature::Peak;
pub use random::Random;
pub use report::{AlbedoRow, Curves, GoodnessRow, LightRow, LobeCurve, LobeRow, Report, Settings, WeightRow};
pub use scatterer::{DoubleScatterer, Model, Scatterer, View};
pub use sphere::{Integrals, Sphere};
pub use statistics::{Moments, SIGNIFICANCE, chi_square_p, normal_p};
pub use subject::Subject;
pub use verdict::{Check, Verdict, worst};
