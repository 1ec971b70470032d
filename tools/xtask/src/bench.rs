//! Speed and memory, printed as figures.

use anyhow::Result;

use crate::shell::{cargo, step};

/// Every bench program of the workspace, low to high.
const BENCHES: [(&str, &str); 16] = [
    ("whole-file", "small_files"),
    ("cyhair", "read"),
    ("usd-layer", "read"),
    ("groom-formats", "convert"),
    ("groom-formats", "usd"),
    ("groom-formats", "alembic"),
    ("groom-formats", "gltf"),
    ("moving-mesh", "pose"),
    ("fibre-scattering", "scattering"),
    ("strand-tracing", "rays"),
    ("strand-tracing", "motion"),
    ("groom-binding", "carry"),
    ("groom-binding", "motion"),
    ("hair-render-cli", "straight_hair"),
    ("hair-render-cli", "motion_samples"),
    ("turntable-cli", "overhead"),
];

/// Runs all of them in a release build.
pub fn all() -> Result<()> {
    BENCHES.iter().try_for_each(|(package, bench)| {
        step(
            &format!("{package}: {bench}"),
            cargo().args(["bench", "--quiet", "--package", package, "--bench", bench]),
        )
    })
}
