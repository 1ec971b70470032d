//! What is kept of a render that is not finished, and where.

use std::path::{Path, PathBuf};

use anyhow::Result;
use command_line::say;
use hair_render::{Checkpoint, Frame, FrameHeader, checkpoint_path};

/// `NAME.snapshot.exr` beside the output.
pub fn snapshot_of(output: &Path) -> PathBuf {
    let mut name = output.file_stem().unwrap_or_default().to_owned();
    name.push(".snapshot.exr");
    output.with_file_name(name)
}

/// The checkpoint beside the output, if there is one of this picture. Another picture's, or a broken one, is told
/// and left out: it is written over in time.
pub fn taken_up(output: &Path, digest: &str) -> Option<Checkpoint> {
    let path = checkpoint_path(output);
    if !path.exists() {
        return None;
    }
    match Checkpoint::read(&path) {
        Ok(found) if found.digest() == digest => {
            let (spp, asked) = (found.spp(), found.spp_asked());
            say(&format!("{}: going on at {spp} of {asked} samples a pixel", path.display()));
            Some(found)
        }
        Ok(_) => {
            say(&format!("{}: of another picture, beginning anew", path.display()));
            None
        }
        Err(fault) => {
            say(&format!("warning: {fault}: beginning anew"));
            None
        }
    }
}

/// The output, if it is whole and has this digest.
pub fn existing(output: &Path, digest: &str) -> Option<Frame> {
    let header = FrameHeader::read(output).ok()?;
    if header.digest != digest {
        return None;
    }
    Frame::read_exr(output).ok().map(|(frame, _)| frame)
}

/// Keeps a checkpoint, or says why it could not: a full disk is no reason to lose what is being rendered.
pub fn keep(checkpoint: &Checkpoint, output: &Path) -> bool {
    let written = checkpoint.write(&checkpoint_path(output));
    if let Err(fault) = &written {
        say(&format!("warning: {fault}: going on without a checkpoint"));
    }
    written.is_ok()
}

/// Removes what a picture of `spp` samples a pixel that is finished needs no more: its checkpoint, and a snapshot that
/// it, or a run that was stopped, left.
pub fn clear(output: &Path, digest: &str, spp: u32) -> Result<()> {
    let snapshot = snapshot_of(output);
    let is_of_it = |header: FrameHeader| header.digest == digest && header.spp < spp;
    if FrameHeader::read(&snapshot).is_ok_and(is_of_it) {
        remove(&snapshot)?;
    }
    remove(&checkpoint_path(output))
}

fn remove(path: &Path) -> Result<()> {
    match std::fs::remove_file(path) {
        Err(fault) if fault.kind() != std::io::ErrorKind::NotFound => {
            Err(anyhow::Error::from(fault).context(path.display().to_string()))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn snapshots_lie_beside_the_output() {
        let output = Path::new("out/frame.0001.exr");
        assert_eq!(snapshot_of(output), Path::new("out/frame.0001.snapshot.exr"));
    }
}
