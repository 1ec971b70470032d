//! What leaves the crate, as `sh`, YAML and format strings read it.

#![allow(clippy::unwrap_used, clippy::panic)] // tests fail by panicking

mod refusals;
mod shapes;
#[cfg(unix)]
mod words;

use farm_export::{FarmJob, JobVariant, When};

/// A job with everything in it.
fn full_job() -> FarmJob {
    let axes = [("groom", "smooth"), ("light", "sky"), ("groom", "smooth"), ("light", "studio")];
    let variant = |axes: &[(&str, &str)]| JobVariant {
        id: axes.iter().map(|(_, name)| *name).collect::<Vec<_>>().join("/"),
        axes: axes.iter().map(|(axis, name)| ((*axis).to_owned(), (*name).to_owned())).collect(),
    };
    FarmJob {
        settings: vec!["--set".into(), "render.spp=4".into()],
        variants: axes.chunks(2).map(variant).collect(),
        inputs: vec!["/show/hair.usd".into()],
        input_folders: vec!["/show/obj".into()],
        prepare: Some(vec!["--prepare".into()]),
        seconds_a_frame: Some(12.5),
        ..FarmJob::new("two lights", "/show/turn.yaml", "/show/out", 1..=7)
    }
    .with_chunk(3)
    .with_after("ContactSheet", &[], When::AllDone)
    .with_after("Report", &["--json"], When::Ended)
}
