//! The laws, one to a file. Each takes a model it knows nothing of.

mod accuracy;
mod draws;
mod energy;
mod far_field;
mod five_lobe;
mod goodness;
mod mis;
mod reciprocity;
mod weights;

pub use accuracy::{Accuracy, accuracy};
pub use draws::{Draws, draw};
pub use energy::{Energy, energy};
pub use far_field::{FarField, far_field};
pub use five_lobe::{FiveLobe, five_lobe};
pub use goodness::{Goodness, goodness};
pub use mis::{Estimates, Sky, estimates};
pub use reciprocity::{Reciprocity, mirror_symmetry, reciprocity};
pub use weights::{Weights, weights};
