//! Curves that move, at any time.

use glam::DVec3;
use ogawa::Archive;

use super::scene::Scene;
use super::{fault, load};
use crate::frames::AtTime;
use crate::polylines::Polylines;
use crate::{FormatError, Frame, Loaded, ReadOptions};

/// The groom at its first time, and its motion.
pub(crate) fn read(
    bytes: Vec<u8>,
    name: &str,
    options: &ReadOptions,
) -> Result<(Loaded, Motion), FormatError> {
    let (loaded, cuts) = load(&bytes, name, options, options.time)?;
    let (name, options, origin) = (name.to_owned(), options.clone(), loaded.origin);
    Ok((loaded, Motion { bytes, name, options, cuts, origin }))
}

/// An archive, and how its curves were cut.
pub(crate) struct Motion {
    bytes: Vec<u8>,
    name: String,
    options: ReadOptions,
    cuts: Vec<Polylines>,
    origin: DVec3,
}

impl AtTime for Motion {
    /// Opens the archive anew: that looks at its tree and at no array but this frame's.
    fn at(&self, time: f64) -> Result<Frame, FormatError> {
        let archive = Archive::new(&self.bytes).map_err(|error| fault(&self.name, "", error))?;
        let mut scene = Scene::new(&archive, &self.name, self.bytes.len(), Some(time))?;
        scene.origin = self.origin;
        scene.frame(time, &self.options, &self.cuts)
    }
}
