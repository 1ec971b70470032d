//! The bytes behind a glTF document: containers, buffers and accessors, every number checked.
//!
//! The crate `gltf` reads the JSON; its iterators over accessors trust offsets and counts, its validation
//! looks up `POSITION` accessors before their index is checked and refuses files that require
//! `KHR_mesh_quantization`. This crate stands between: what [`Asset::open`] returns can be walked through `gltf`'s
//! own types without a panic, and [`Elements`] reads accessors of every type after checking every range.
//!
//! ```
//! use gltf_bytes::{Asset, Elements};
//!
//! let json = br#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"data:;base64,AAEC/w=="}],
//!     "bufferViews":[{"buffer":0,"byteLength":4}],
//!     "accessors":[{"bufferView":0,"componentType":5121,"normalized":true,"count":2,"type":"VEC2"}]}"#;
//! let asset = Asset::open(json, None)?;
//! let accessor = asset.document.accessors().next().ok_or("no accessor")?;
//! let elements = Elements::open(&accessor, &asset.buffers)?;
//! assert_eq!(elements.floats()?[3], 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Knows neither meshes nor grooms: which accessors to read, and what they mean, is the caller's.

mod asset;
mod buffers;
mod component;
mod container;
mod document;
mod elements;
mod error;
mod files;
mod image;
mod placement;
mod sparse;

pub use asset::Asset;
pub use buffers::Buffers;
pub use container::split;
pub use elements::Elements;
pub use error::GltfError;
pub use files::files;
pub use image::ImageBytes;
pub use placement::{Local, parents_first, placements};
