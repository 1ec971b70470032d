//! Where the strands go, and in which way.

use std::path::{Path, PathBuf};

use anyhow::{Result, bail};
use groom_formats::Format;

use crate::args::{Args, is_stream};
use crate::numbered::Numbered;

/// What is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Target {
    /// One file that holds every frame.
    Animated(PathBuf, Format),
    /// One file with the strands at rest and the joints' motion.
    Skinned(PathBuf, Format),
    /// A file a frame.
    Files(Numbered, Format),
    /// One frame.
    Still(PathBuf, Format),
}

impl Target {
    /// What the options ask for; `None` when only a report is wanted. Refuses what cannot go together.
    pub(crate) fn of(args: &Args) -> Result<Option<Target>> {
        let Some(output) = args.output.as_deref() else {
            if args.writing.as_skinned || args.writing.check {
                bail!("--as-skinned and --check are of an output, and none was given: -o FILE");
            }
            return Ok(None);
        };
        let target = Target::choose(output, args)?;
        target.refuse_misfits(args)?;
        Ok(Some(target))
    }

    fn choose(output: &Path, args: &Args) -> Result<Target> {
        if is_stream(output) {
            bail!("a groom that moves cannot go to standard output; name a file");
        }
        let Some(format) = Format::from_path(output).filter(|format| format.can_write()) else {
            let known: Vec<_> = Format::ALL.into_iter().filter(|f| f.can_write()).map(Format::name).collect();
            bail!(
                "{}: no groom format that is written has this ending; expected one of {}",
                output.display(),
                known.join(", ")
            );
        };
        if let Some(numbered) = Numbered::of(output) {
            return Ok(Target::Files(numbered, format));
        }
        let path = output.to_owned();
        Ok(match format {
            _ if args.writing.as_skinned => Target::Skinned(path, format),
            format if holds_motion(format) => Target::Animated(path, format),
            format => Target::Still(path, format),
        })
    }

    fn refuse_misfits(&self, args: &Args) -> Result<()> {
        let (format, output) = (self.format(), self.display());
        let shutter = &args.shutter;
        if args.writing.as_skinned
            && (matches!(self, Target::Files(..))
                || matches!(format, Format::Alembic)
                || !holds_motion(format))
        {
            bail!("--as-skinned is for .usda, .usdc, .usdz, .gltf and .glb, and the output is {output}");
        }
        if matches!(self, Target::Still(..) | Target::Files(..)) && shutter.shutter_samples.is_some() {
            bail!(
                "--shutter-samples needs a file that moves (.usda .usdc .usdz .abc .gltf .glb), not {output}"
            );
        }
        if shutter.accelerations && !is_usd(format) {
            bail!("--accelerations are held by .usda, .usdc and .usdz, not by {output}");
        }
        if shutter.velocities_asked() && !holds_velocities(format) {
            bail!("--velocity: {format} holds no velocities; .usda, .usdc, .usdz and .abc do");
        }
        if args.writing.check && (!is_usd(format) || matches!(self, Target::Files(..))) {
            bail!("--check is for one USD file, and the output is {output}");
        }
        Ok(())
    }

    pub(crate) fn format(&self) -> Format {
        match self {
            Target::Animated(_, format)
            | Target::Skinned(_, format)
            | Target::Files(_, format)
            | Target::Still(_, format) => *format,
        }
    }

    /// Whether velocities of the points can be written.
    pub(crate) fn holds_velocities(&self) -> bool {
        holds_velocities(self.format()) && !matches!(self, Target::Skinned(..))
    }

    /// The output as it was named.
    pub(crate) fn display(&self) -> String {
        match self {
            Target::Animated(path, _) | Target::Skinned(path, _) | Target::Still(path, _) => {
                path.display().to_string()
            }
            Target::Files(numbered, _) => numbered.pattern().display().to_string(),
        }
    }

    /// Every file that will be written for these frames.
    pub(crate) fn files<'a>(
        &'a self,
        frames: impl Iterator<Item = f64> + 'a,
    ) -> Box<dyn Iterator<Item = PathBuf> + 'a> {
        match self {
            Target::Animated(path, format) | Target::Skinned(path, format) | Target::Still(path, format) => {
                Box::new(with_second(path.clone(), *format))
            }
            Target::Files(numbered, format) => {
                Box::new(frames.flat_map(move |frame| with_second(numbered.at(frame as i64), *format)))
            }
        }
    }
}

/// A file, and the one beside it of formats that come in two.
fn with_second(path: PathBuf, format: Format) -> impl Iterator<Item = PathBuf> {
    let second = (format == Format::Gltf).then(|| path.with_extension("bin"));
    std::iter::once(path).chain(second)
}

fn is_usd(format: Format) -> bool {
    matches!(format, Format::Usda | Format::Usdc | Format::Usdz)
}

fn holds_velocities(format: Format) -> bool {
    is_usd(format) || format == Format::Alembic
}

fn holds_motion(format: Format) -> bool {
    holds_velocities(format) || matches!(format, Format::Gltf | Format::Glb)
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;

    fn target(line: &str) -> Result<Option<Target>> {
        let line = format!("groom-bind a.hair --mesh b.glb {line}");
        Target::of(&Args::try_parse_from(line.split_whitespace()).unwrap())
    }

    #[test]
    fn the_ending_says_how() {
        assert_eq!(target("--report r.json").unwrap(), None);
        let kind = |line| target(line).unwrap().unwrap();
        assert!(matches!(kind("-o a.usdc"), Target::Animated(_, Format::Usdc)));
        assert!(matches!(kind("-o a.abc"), Target::Animated(_, Format::Alembic)));
        assert!(matches!(kind("-o a.glb --as-skinned"), Target::Skinned(_, Format::Glb)));
        assert!(matches!(kind("-o a.##.hair"), Target::Files(_, Format::Hair)));
        assert!(matches!(kind("-o a.##.usdc"), Target::Files(_, Format::Usdc)));
        assert!(matches!(kind("-o a.hair"), Target::Still(_, Format::Hair)));
        let gltf = kind("-o d/a.gltf");
        let files: Vec<_> = gltf.files(std::iter::empty()).collect();
        assert_eq!(files, [Path::new("d/a.gltf"), Path::new("d/a.bin")]);
    }

    #[test]
    fn what_cannot_be_is_refused() {
        for (line, word) in [
            ("-o a.fbx", "expected one of"),
            ("-o a.tfx", "expected one of"),
            ("-o -", "standard output"),
            ("-o a.hair --as-skinned", "--as-skinned"),
            ("-o a.abc --as-skinned", "--as-skinned"),
            ("-o a.#.usda --as-skinned", "--as-skinned"),
            ("-o a.##.hair --shutter-samples 3", "--shutter-samples"),
            ("-o a.abc --accelerations", "--accelerations"),
            ("-o a.glb --velocity", "holds no velocities"),
            ("-o a.abc --check", "--check"),
            ("--report r.json --check", "none was given"),
        ] {
            let told = target(line).unwrap_err().to_string();
            assert!(told.contains(word), "{line}: {told}");
        }
    }
}
