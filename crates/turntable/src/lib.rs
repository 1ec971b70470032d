//! Scripted turntables: a YAML pipeline becomes converted grooms, frames, a contact sheet and an
//! error report.
//!
//! The way: groom -> attributes -> converted files; groom + mesh + lights -> scene -> frames (EXR) ->
//! contact sheet (PNG), report (JSON, HTML). A [`Plan`] is read from a file, checked against the
//! schema (unknown keys are refused by name, line and column) and compared with what is on disk;
//! [`Plan::run`] makes what is missing or stale and nothing else.
//!
//! Stale means: the digest of everything an output depends on (bytes of inputs, settings that matter
//! to it, version and sources of the program) differs from the one it was made with, or its bytes are
//! not those that were written. Frames carry their digest in the EXR header; `manifest.jsonl` holds
//! that of every output, a digest of its bytes, its size and its times. Every file is written whole or not at all.
//!
//! ```
//! use turntable::{Options, Plan, State};
//!
//! # let folder = tempfile::tempdir()?;
//! let file = folder.path().join("turn.yaml");
//! std::fs::write(&file, "version: 1\ngroom: {sample: {}}\nlights: {environment: {studio: true}}\n")?;
//! let output = Some(folder.path().join("out"));
//! let plan = Plan::new(&file, Options { output, ..Options::default() })?;
//! assert_eq!(plan.steps().len(), 12);
//! assert!(plan.steps().iter().all(|step| step.state == State::Missing));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod check;
mod digest;
mod error;
mod expand;
mod explain;
mod frames;
mod journal;
mod left_out;
mod manifest;
mod only;
mod options;
mod outputs;
mod plan;
mod report;
mod reporter;
mod run;
pub mod schema;
mod stage;
mod stamp;
mod step;
mod summary;
mod there;

pub use error::TurntableError;
pub use expand::{Checked, Variant, check_pipeline};
pub use explain::Remark;
pub use frames::{FrameRange, FrameRangeError};
pub use hair_render::CheckpointEvery;
pub use options::{Options, Phase};
pub use plan::Plan;
pub use reporter::{Event, Picture, Reporter, Silent};
pub use step::{State, Step, StepKind};
pub use strict_yaml::Fault;
pub use summary::{Failure, FrameLine, Summary};
