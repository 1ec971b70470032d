//! Frames that a file does not have.

use std::path::Path;

/// What there is to say of a frame before the first or after the last that a file has.
#[must_use]
pub fn outside(path: &Path, frame: f64, (first, last): (f64, f64)) -> Option<String> {
    /// Frames that rounding of seconds may be off.
    const NEAR: f64 = 1e-3;
    let beyond = frame < first - NEAR || frame > last + NEAR;
    let name = path.display();
    beyond.then(|| format!("{name}: frame {frame} is outside {first} to {last}; it stands as at the nearest"))
}
