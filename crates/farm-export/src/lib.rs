//! Render jobs as other people's farms take them.
//!
//! A [`FarmJob`] says what is to be rendered; it leaves as
//! - an Open Job Description bundle ([`openjd`], specification 2023-09 with `TASK_CHUNKING`), which AWS Deadline Cloud
//!   and whatever else imports such bundles runs, and `openjd-cli` on one machine;
//! - a Slurm script that submits itself ([`slurm`]);
//! - a list of commands, one line a task ([`command_list`]), for GNU parallel, HyperQueue, OpenCue, `xargs` or `sh`.
//!
//! There is no scheduler here, no retry loop and no lock: engines have them. What they need of a renderer is that a
//! task may be run again, run twice at once, or be killed, and nothing is lost or done twice. That is the renderer's
//! part; here is only text. Nothing is read, written or started.
//!
//! The words a task is made of are `COMMAND.. PIPELINE --out OUTPUT SETTINGS.. RENDER.. --only AXIS=NAME.. --frames RANGE`,
//! with `--threads` where the farm says how many it lent, and `--progress openjd` where it listens. Names may hold
//! spaces, quotes, `$` and `{{`; what a format cannot say is refused with its name.
//!
//! ```
//! use farm_export::{FarmJob, When};
//!
//! let job = FarmJob::new("quickstart", "/show/hair/quickstart.yaml", "/show/out/quickstart", 1..=8)
//!     .with_chunk(4)
//!     .with_after("ContactSheet", &[], When::AllDone);
//! let list = farm_export::command_list(&job)?;
//! assert!(list.ends_with(
//!     "turntable /show/hair/quickstart.yaml --out /show/out/quickstart --frames 1-4\n\
//!      turntable /show/hair/quickstart.yaml --out /show/out/quickstart --frames 5-8\n"
//! ));
//! # Ok::<(), farm_export::FarmError>(())
//! ```

mod commands;
mod error;
mod job;
mod openjd;
mod ranges;
mod shell;
mod slurm;
mod yaml;

pub use commands::command_list;
pub use error::FarmError;
pub use job::{AfterStep, FarmJob, JobVariant, MOST_FRAMES_A_TASK, When, frames_a_task};
pub use openjd::{BUNDLE_FILES, openjd};
pub use ranges::range_text;
pub use shell::sh_quoted;
pub use slurm::slurm;
