//! Holds a fibre's scattering against the laws it must obey, and says what it found.
//!
//! A [`Model`] is anything that can be evaluated and sampled; [`Subject`] is one of this project's. [`Report::new`]
//! makes every check of one material; [`Stability::new`] takes the figures of a table of extreme cases; [`eval`]
//! answers a table of parameters and directions; [`compare_with_mitsuba`] explains every difference to another
//! renderer's answers. Nothing here prints, and nothing depends on the number of threads.
//!
//! ```
//! use fibre_scattering::HairParameters;
//! use fibre_verification::{Report, Settings, Subject};
//!
//! let white = Subject::new(&HairParameters::default().into(), None)?;
//! let settings = Settings { samples: 5000, quick: true, ..Settings::default() };
//! let report = Report::new(&white, "white hair", settings, &|_done, _of| {})?;
//! assert!(report.passes());
//! assert!(report.to_html().contains("<svg"));
//! # Ok::<(), fibre_verification::VerificationError>(())
//! ```
//!
//! # How it is measured
//!
//! | law | how |
//! |---|---|
//! | white furnace, density, energy of each lobe | Gauss's rule of eight on panels that are dense where lobes are: where the formulas say, and where a few thousand samples go ([`Landmarks`]) |
//! | samples follow the density | Pearson's chi-square over those panels, each cut in four, and over their sums along and around the fibre; cells that expect fewer than ten samples are pooled |
//! | weights | mean value over density against the albedo by quadrature; the largest against 1 |
//! | one light four ways | a sky of soft lights ([`Sky`]) by quadrature, by the light's samples, the fibre's, and both (balance, power); light samples that a few lucky ones carry are left out |
//! | reciprocity | random pairs of directions exchanged, averaged over the offset or not |
//! | accuracy | single precision against double at directions that samples take |
//!
//! A check that is a test of significance allows one false alarm in a thousand, shared by its views. Models
//! broken on purpose hold that each check can fail (`tests/mutants.rs`).

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
mod stability;
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
pub use stability::{Case, Effort, Stability, StabilityRow, cases};
pub use statistics::{Moments, SIGNIFICANCE, chi_square_p, normal_p, uniform_p};
pub use subject::Subject;
pub use verdict::{Check, Verdict, worst};
