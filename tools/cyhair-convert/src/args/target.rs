//! Which formats the input and the output have, and what cannot go together.

use std::path::Path;

use anyhow::{Result, bail};
use groom_formats::Format;

use super::{Args, Up};

impl Args {
    /// What to read; only `--formats` goes without.
    pub(crate) fn input(&self) -> &Path {
        self.input.as_deref().unwrap_or(Path::new(""))
    }

    /// The input's format, by option or ending.
    pub(crate) fn input_format(&self) -> Result<Format> {
        let readable = |format: Format| format.can_read();
        let format = choose(self.from, self.input(), "--from", "standard input", &endings(readable))?;
        if format.is_built() && !format.can_read() {
            bail!("{}: {format} can be written and not read", self.input().display());
        }
        Ok(format)
    }

    /// Where to write, and in which format; refuses what cannot go together.
    pub(crate) fn target(&self) -> Result<(&Path, Format)> {
        let Some(output) = self.output.as_deref() else { bail!("no output was given") };
        let format = choose(self.to, output, "--to", "standard output", &endings(Format::can_write))?;
        if let Some(other) = Format::from_path(output).filter(|&other| other != format) {
            bail!("--to {format} and the ending .{other} of {} contradict each other", output.display());
        }
        if is_stream(output) {
            if !format.streams() {
                bail!("--to {format} is two files and cannot go to standard output; use --to glb");
            }
            if self.json {
                bail!("--json and the output `-` both need standard output");
            }
        }
        if format == Format::Gltf {
            self.refuse_odd_pair(output)?;
        }
        if matches!(format, Format::Gltf | Format::Glb) && self.strands.up == Some(Up::Z) {
            bail!("--up z cannot be used with .{format}: glTF is always y-up");
        }
        Ok((output, format))
    }

    /// `.gltf` names its second file itself, which must be possible and must not be the input.
    fn refuse_odd_pair(&self, output: &Path) -> Result<()> {
        if Format::from_path(output).is_none() {
            bail!("{}: --to gltf needs an output that ends with .gltf", output.display());
        }
        let bytes = output.with_extension("bin");
        let same = |input: &Path| Some(input.canonicalize().ok()? == bytes.canonicalize().ok()?);
        if same(self.input()) == Some(true) {
            bail!("{} would be written over the input; use --to glb or another name", bytes.display());
        }
        Ok(())
    }
}

/// Whether a path is the `-` that stands for a standard stream.
pub(crate) fn is_stream(path: &Path) -> bool {
    path.as_os_str() == "-"
}

fn choose(asked: Option<Format>, path: &Path, option: &str, stream: &str, expected: &str) -> Result<Format> {
    match asked.or_else(|| Format::from_path(path)) {
        Some(format) => Ok(format),
        None if is_stream(path) => bail!("{stream} needs {option} FORMAT; expected one of {expected}"),
        None => bail!(
            "{}: no groom format has this ending; expected one of {expected}, or {option} FORMAT",
            path.display()
        ),
    }
}

fn endings(which: fn(Format) -> bool) -> String {
    let names: Vec<_> = Format::ALL.into_iter().filter(|&f| which(f)).map(Format::name).collect();
    names.join(", ")
}
