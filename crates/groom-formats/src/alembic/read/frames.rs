//! Curves that move, frame by frame.

use ogawa::Archive;

use super::scene::Scene;
use super::{fault, load};
use crate::polylines::Polylines;
use crate::{FormatError, Frame, Loaded, ReadOptions};

/// The groom at its first time, and its frames.
pub(crate) fn read(
    bytes: Vec<u8>,
    name: &str,
    options: &ReadOptions,
) -> Result<(Loaded, Frames), FormatError> {
    let (loaded, cuts) = load(&bytes, name, options, options.time)?;
    let times = loaded.times.clone().into_iter();
    let (name, options) = (name.to_owned(), options.clone());
    Ok((loaded, Frames { bytes, name, options, cuts, times }))
}

/// The frames, one in memory at a time.
pub(crate) struct Frames {
    bytes: Vec<u8>,
    name: String,
    options: ReadOptions,
    cuts: Vec<Polylines>,
    times: std::vec::IntoIter<f64>,
}

impl Iterator for Frames {
    type Item = Result<Frame, FormatError>;

    fn next(&mut self) -> Option<Self::Item> {
        let time = self.times.next()?;
        let frame = self.frame(time);
        if frame.is_err() {
            // After an error there is no other frame.
            self.times = Vec::new().into_iter();
        }
        Some(frame)
    }
}

impl Frames {
    /// Opens the archive anew: that looks at its tree and at no array but this frame's.
    fn frame(&self, time: f64) -> Result<Frame, FormatError> {
        let archive = Archive::new(&self.bytes).map_err(|error| fault(&self.name, "", error))?;
        let scene = Scene::new(&archive, &self.name, self.bytes.len(), Some(time))?;
        scene.frame(time, &self.options, &self.cuts)
    }
}
