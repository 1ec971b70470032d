//! The medulla tables a scene uses, and what they cost.

use medulla_tables::{Found, Source};
use serde::Serialize;

/// The table of one groom's fur.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct TableUse {
    /// Index into the scene's hair.
    pub object: usize,
    /// Where it came from: `memory`, `disk` or `built`.
    pub source: &'static str,
    /// Seconds it took to build; `None` where it was not built now.
    pub built_seconds: Option<f64>,
    /// Bytes it takes in memory.
    pub bytes: usize,
    /// What was wrong with the cache on disk, if anything was. The table is sound all the same.
    pub cache_fault: Option<String>,
}

impl TableUse {
    pub(crate) fn new(object: usize, found: &Found) -> TableUse {
        let (source, built_seconds) = match found.source {
            Source::Memory => ("memory", None),
            Source::Disk => ("disk", None),
            Source::Built { elapsed } => ("built", Some(elapsed.as_secs_f64())),
        };
        let bytes = found.table.size();
        let cache_fault = found.fault.as_ref().map(ToString::to_string);
        TableUse { object, source, built_seconds, bytes, cache_fault }
    }
}
