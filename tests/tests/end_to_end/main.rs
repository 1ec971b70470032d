//! The programs as a user runs them, and their files as other programs see them: one test program, because every one
//! is linked on its own.

#![allow(clippy::unwrap_used, clippy::panic)] // tests fail by panicking

mod blender_alembic;
mod blender_usd;
mod chaos;
mod convert_cli;
mod convert_edits;
mod convert_motion;
mod convert_report;
mod convert_validators;
mod every_format;
mod farm_files;
mod farm_openjd;
mod gltf_files;
mod groom_bind;
#[cfg(target_os = "linux")]
mod killed_writers;
mod layering;
mod mitsuba_text;
mod motion_files;
mod pipelines;
mod turntable_bench;
mod turntable_files;
mod turntable_outputs;
mod turntable_schema;
mod turntable_staleness;
mod turntable_stops;
mod usd_core;
mod usd_files;
mod usd_reading;
