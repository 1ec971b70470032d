//! Groom files: one module and one feature per format, bytes to [`Groom`](groom::Groom) and back.
//!
//! | format | feature | read | write |
//! |---|---|---|---|
//! | HAIR (cyHair), `.hair` | `hair` | yes | yes |
//! | [`text`], `.txt` | `text` | yes | yes |
//! | USD, `.usda`, `.usdc`, `.usdz` | `usda`, `usdc`, `usdz` | yes, BasisCurves | yes, as BasisCurves |
//! | Alembic, `.abc` | `alembic` | yes, Curves | yes, in Unreal's groom schema |
//! | glTF, `.gltf` and `.glb` | `gltf` | yes, its lines | yes, as lines, tubes or ribbons |
//! | PLY strands, `.ply` | `ply` | yes | yes, as hairutil's |
//! | USC hair, `.data` | `data` | yes | yes |
//! | Wavefront lines, `.obj` | `obj` | yes | yes |
//! | pbrt curves, `.pbrt` | `pbrt` | | yes |
//! | TressFX 3 and 4, `.tfx` | `tfx` | yes | |
//! | MonoHair, `.hair` without HAIR's magic | `monohair` | yes | |
//! | CT2Hair, `.bin` | `ct2hair` | yes | |
//!
//! A reader keeps the file's numbers and says in the groom what they mean; a writer whose format
//! fixes an axis or a unit converts them. What a format cannot hold comes back as a [`Warning`].
//!
//! ```
//! use groom_formats::{ReadOptions, WriteOptions};
//! # let folder = tempfile::tempdir()?;
//! # let (text, usd) = (folder.path().join("lock.txt"), folder.path().join("lock.usda"));
//! # std::fs::write(&text, "0 0 0 0.05\n0 0 1 0.03\n")?;
//! let loaded = groom_formats::read(&text, &ReadOptions::default())?;
//! assert_eq!((loaded.groom.strand_count(), loaded.groom.point_count()), (1, 2));
//! let warnings = groom_formats::write(&loaded.groom, &usd, &WriteOptions::default())?;
//! assert!(warnings.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

// Formats share helpers; one format alone does not use them all.
#![cfg_attr(
    not(all(
        feature = "hair",
        feature = "text",
        feature = "gltf",
        feature = "usda",
        feature = "usdc",
        feature = "usdz",
        feature = "alembic",
        feature = "ply",
        feature = "data",
        feature = "obj",
        feature = "pbrt",
        feature = "tfx",
        feature = "monohair",
        feature = "ct2hair"
    )),
    allow(dead_code, unreachable_code, unused_imports, unused_mut, unused_variables)
)]

#[cfg(feature = "alembic")]
mod alembic;
mod animation;
#[cfg(any(
    feature = "data",
    feature = "ct2hair",
    feature = "tfx",
    feature = "monohair",
    feature = "ply",
    feature = "obj",
    feature = "gltf"
))]
mod assemble;
#[cfg(any(feature = "text", feature = "usda", feature = "usdc", feature = "obj", feature = "pbrt"))]
mod blocks;
#[cfg(any(feature = "data", feature = "ct2hair", feature = "tfx", feature = "monohair", feature = "ply"))]
mod bytes;
#[cfg(any(feature = "ply", feature = "obj"))]
mod chains;
mod check;
#[cfg(any(feature = "data", feature = "ct2hair"))]
mod counted_strands;
#[cfg(feature = "ct2hair")]
mod ct2hair;
#[cfg(any(feature = "alembic", feature = "usda", feature = "usdc", feature = "usdz"))]
mod cubic;
#[cfg(feature = "data")]
mod data;
mod drawable;
mod error;
mod format;
mod frame_check;
mod frames;
#[cfg(feature = "gltf")]
mod gltf;
#[cfg(feature = "hair")]
mod hair;
#[cfg(any(feature = "alembic", feature = "usda", feature = "usdc", feature = "usdz"))]
mod join;
mod look_alike;
#[cfg(feature = "monohair")]
mod monohair;
#[cfg(any(feature = "text", feature = "usda", feature = "usdc", feature = "obj", feature = "pbrt"))]
mod numbers;
#[cfg(feature = "obj")]
mod obj;
mod options;
mod output;
#[cfg(any(feature = "text", feature = "obj"))]
mod parse_number;
#[cfg(feature = "pbrt")]
mod pbrt;
#[cfg(feature = "ply")]
mod ply;
#[cfg(any(feature = "alembic", feature = "usda", feature = "usdc", feature = "usdz"))]
mod polylines;
mod read;
mod rig;
#[cfg(any(feature = "usda", feature = "usdc", feature = "usdz"))]
mod room;
#[cfg(feature = "hair")]
mod stream;
#[cfg(feature = "text")]
pub mod text;
#[cfg(feature = "tfx")]
mod tfx;
mod unstored;
#[cfg(any(feature = "usda", feature = "usdc", feature = "usdz"))]
mod usd;
mod warning;
mod write;

pub use animation::{Frame, MotionOptions, write_animation};
pub use error::FormatError;
pub use format::Format;
pub use frames::{Frames, MovingGroom, read_frames, read_moving};
pub use options::{Dialect, HairExtras, Loaded, Look, Mesh, ReadOptions, WriteOptions};
pub use output::Output;
pub use read::{read, read_from};
pub use rig::{Influences, Rig, RigFrame, RigJoint, write_rigged};
#[cfg(feature = "hair")]
pub use stream::{Streamed, convert_streaming, convert_streaming_with};
pub use warning::Warning;
pub use write::{write, write_seekable, write_to};
