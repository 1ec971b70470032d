//! USD layers to the byte: `.usda`, `.usdc` and `.usdz`, read and written, without OpenUSD.
//!
//! ```
//! use usd_layer::Layer;
//!
//! let text = "#usda 1.0\ndef BasisCurves \"Hair\"\n{\n    point3f[] points = [(0, 0, 0), (0, 1, 0)]\n}\n";
//! let layer = Layer::read(text.as_bytes())?;
//! let points = layer.prim("/Hair").and_then(|prim| prim.attribute("points")).and_then(|points| points.held(None));
//! assert_eq!(points.map(|points| layer.values::<f32, 3>(points)).transpose()?, Some(vec![[0.0; 3], [0.0, 1.0, 0.0]]));
//! # Ok::<(), usd_layer::ReadError>(())
//! ```

mod element;
mod layer;
pub mod read;
mod value;
pub mod write;
pub mod xform;

pub use element::{Element, Scalar, Shape};
pub use layer::{Attribute, Layer, Metadata, Prim, Relationship, Samples, Specifier, VariantSet};
pub use read::{Number, Place, ReadError};
pub use value::{Array, ListOp, Name, Reference, Tuple, Value};
