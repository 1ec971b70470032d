//! Speed and memory, printed as figures.

use anyhow::Result;

use crate::shell::{cargo, step};

/// Every bench program of the workspace, low to high.
const BENCHES: [(&str, &str); 0] = [];

/// Runs all of them in a release build.
pub fn all() -> Result<()> {
    BENCHES.iter().try_for_each(|(package, bench)| {
        step(
            &format!("{package}: {bench}"),
            cargo().args(["bench", "--quiet", "--package", package, "--bench", bench]),
        )
    })
}
