//! Layers as bytes: crates (`.usdc`) and packages (`.usdz`), written without OpenUSD.
//!
//! The layout is crate version 0.8.0, which every usd-core since 2019 opens (OpenUSD,
//! `pxr/usd/usd/crateFile.h`). Arrays are borrowed and go straight to the stream; only what names them
//! stays in memory. The same value twice is stored once.
//!
//! ```
//! use std::io::Cursor;
//! use usd_layer::write::{Attribute, Content, CrateWriter, Value};
//!
//! let mut layer = CrateWriter::new(Cursor::new(Vec::new()))?;
//! layer.metadata("defaultPrim", Value::Token("Lock"))?;
//! layer.metadata("upAxis", Value::Token("Y"))?;
//! let lock = layer.prim("/Lock", "BasisCurves")?;
//! let counts = layer.store(Value::Ints(&[2]))?;
//! let points = layer.store(Value::Float3s(&[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0]]))?;
//! layer.attribute(lock, Attribute::new("curveVertexCounts", "int[]", Content::Value(counts)))?;
//! layer.attribute(lock, Attribute::new("points", "point3f[]", Content::Value(points)))?;
//! let bytes = layer.finish()?.into_inner();
//! assert!(bytes.starts_with(b"PXR-USDC"));
//! # Ok::<(), usd_layer::write::WriteError>(())
//! ```

mod arrays;
mod compress;
mod crate_writer;
mod error;
mod heap;
mod integers;
mod package;
mod paths;
mod records;
mod sections;
mod tokens;
mod value;

pub use crate_writer::{Attribute, Content, CrateWriter, Prim};
pub use error::WriteError;
pub use package::PackageWriter;
pub use value::{Stored, Value};
