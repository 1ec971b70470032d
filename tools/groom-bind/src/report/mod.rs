//! `--report`: how far roots are from the mesh, and what happened in each frame.

mod csv;
mod histogram;
mod json;

use std::path::Path;

use anyhow::{Result, bail};
use groom::Groom;
use groom_binding::{BindReport, Binding};
use serde_json::Value;

pub(crate) use json::summary;

use crate::args::is_stream;
use crate::events::FrameEvents;

/// Where every strand was bound, before any was moved or left out.
pub(crate) struct Distances {
    pub(crate) ids: Vec<u32>,
    pub(crate) binding: Binding,
    pub(crate) report: BindReport,
    pub(crate) limit: Option<f64>,
}

impl Distances {
    pub(crate) fn new(groom: &Groom, binding: Binding, report: BindReport, limit: Option<f64>) -> Distances {
        let ids = (0..groom.strand_count()).map(|strand| groom.strand_id(strand)).collect();
        Distances { ids, binding, report, limit }
    }
}

/// Refuses a file whose ending says nothing, before anything is done.
pub(crate) fn refuse_unknown(path: &Path) -> Result<()> {
    if is_stream(path) || has_ending(path, "json") || has_ending(path, "csv") {
        return Ok(());
    }
    bail!("--report {}: expected a name that ends in .json or .csv, or `-`", path.display());
}

/// Writes the report where it was asked for.
pub(crate) fn store(path: &Path, distances: &Distances, frames: &[FrameEvents], about: Value) -> Result<()> {
    if has_ending(path, "csv") && !is_stream(path) {
        return Ok(whole_file::write_whole(path, &csv::strands(distances)?)?);
    }
    let mut text = serde_json::to_vec_pretty(&json::report(distances, frames, about))?;
    text.push(b'\n');
    if is_stream(path) {
        std::io::Write::write_all(&mut std::io::stdout().lock(), &text)?;
        return Ok(());
    }
    Ok(whole_file::write_whole(path, &text)?)
}

fn has_ending(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending))
}
