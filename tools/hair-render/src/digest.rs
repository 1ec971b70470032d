//! One word for everything a picture depends on.

use std::fmt::{self, Debug, Write};
use std::fs::File;

use anyhow::{Context, Result};
use hair_render::{RenderSettings, SceneDescription};

use crate::args::Args;

/// The digest of the picture that `args` and what was read for them describe, in 32 letters.
///
/// What was read counts, not the files: a layer or a buffer that a groom's file refers to is in it, a file's name
/// and time are not. So do the settings, but for those that change no bit, and the program's own bytes.
pub fn of(args: &Args, description: &SceneDescription, settings: &RenderSettings) -> Result<String> {
    let mut words = Words { hasher: blake3::Hasher::new(), waiting: Vec::with_capacity(ROOM) };
    let program = std::env::current_exe().and_then(File::open).context("reading this program")?;
    words.hasher.update_reader(program).context("reading this program")?;
    let settings = RenderSettings { threads: None, ..settings.clone() };
    words.add(description).add(&settings).add(&args.view).add(&args.motion);
    words.add(&(args.quality.half, args.fibre.match_color));
    words.flush();
    Ok(words.hasher.finalize().to_hex()[..32].to_owned())
}

const ROOM: usize = 1 << 16;

/// Hashes values as they are written for people: `Debug` tells all of a plain value, floats to the last bit, and
/// forgets no field that is added to it later.
struct Words {
    hasher: blake3::Hasher,
    waiting: Vec<u8>,
}

impl Words {
    fn add(&mut self, value: &dyn Debug) -> &mut Self {
        // Cannot fail: this writer takes everything.
        let _ = writeln!(self, "{value:?}");
        self
    }

    fn flush(&mut self) {
        self.hasher.update(&self.waiting);
        self.waiting.clear();
    }
}

impl Write for Words {
    fn write_str(&mut self, words: &str) -> fmt::Result {
        self.waiting.extend_from_slice(words.as_bytes());
        if self.waiting.len() >= ROOM {
            self.flush();
        }
        Ok(())
    }
}
