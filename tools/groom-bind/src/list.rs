//! `--list-animations`.

use std::io::{self, Write};

use anyhow::Result;
use serde_json::json;

use crate::args::Args;
use crate::character;

/// Prints the animations of the mesh with their times and frames.
pub(crate) fn run(args: &Args) -> Result<()> {
    let character = character::open(args)?;
    let rate = character.timeline.rate;
    let animations = character.mesh.animations();
    let mut stdout = io::stdout().lock();
    if args.json {
        let row = |(number, animation): (usize, &moving_mesh::Animation)| json!({"number": number, "name": animation.name, "start": animation.start, "end": animation.end});
        let rows: Vec<_> = animations.iter().enumerate().map(row).collect();
        let all = json!({"mesh": character.name, "frame_rate": rate, "animations": rows});
        writeln!(stdout, "{}", serde_json::to_string_pretty(&all)?)?;
        return Ok(());
    }
    for (number, animation) in animations.iter().enumerate() {
        let (start, end) = (animation.start, animation.end);
        let frames = format!("frames {:.4} to {:.4} at {rate}", start * rate, end * rate);
        writeln!(stdout, "{number:>3}  {:<24} {start:.4} to {end:.4} s, {frames}", animation.name)?;
    }
    if animations.is_empty() {
        writeln!(io::stderr(), "{}: no animation", character.name)?;
    }
    Ok(())
}
