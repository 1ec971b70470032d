//! One variant's document as a pipeline.

use std::collections::BTreeSet;
use std::path::Path;

use strict_yaml::{Document, Reading};

use crate::schema::Pipeline;
use crate::{Fault, check};

/// The keys of paths that are read; they count from the file they are written in.
const INPUTS: [&str; 7] = [
    "camera.file.path",
    "comp.plate",
    "groom.file",
    "lights.environment.file",
    "material.file",
    "material.texture.file",
    "mesh.file",
];

/// More of what only checking finds is not told of one variant.
const MOST_FAULTS: usize = 200;

/// What reading a variant came to.
pub(super) struct Read {
    /// The pipeline, if there is nothing wrong with it.
    pub pipeline: Option<Pipeline>,
    /// Everything wrong with it.
    pub faults: Vec<Fault>,
    /// The variables it uses.
    pub used: BTreeSet<String>,
}

/// Reads and checks a document that is a pipeline and nothing else but `variables`.
pub(super) fn read(document: Document, file: &Path) -> Result<Read, Vec<Fault>> {
    let (mut document, used) = document.with_variables()?;
    document.join_folders(&INPUTS);
    let mut faults: Vec<Fault> = simulation(&mut document).into_iter().collect();
    let Reading { value, faults: found, left_out } = document.read::<Pipeline>();
    faults.extend(found);
    if let Some(pipeline) = &value {
        let base = file.parent().unwrap_or(Path::new(""));
        let found = check::faults(pipeline, base).into_iter();
        // What was left out, or is lacking for that, is told already.
        let new = found.filter(|(key, _)| !left_out.iter().any(|out| within(out, key) || within(key, out)));
        faults.extend(new.take(MOST_FAULTS).map(|(key, message)| document.fault(&key, message)));
    }
    let pipeline = value.filter(|_| faults.is_empty());
    Ok(Read { pipeline, faults, used })
}

fn within(inner: &str, outer: &str) -> bool {
    inner.strip_prefix(outer).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
}

/// Strands are not simulated here.
fn simulation(document: &mut Document) -> Option<Fault> {
    let node = document.take("simulate")?;
    let words = "strands cannot be simulated here; simulate them in another program, give the animated groom it \
        writes (Alembic or USD) as `groom.file`, and say `motion`";
    Some(document.fault_at_key(&node, "simulate", words.to_owned()))
}
