//! Where ffmpeg is.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// An ffmpeg that answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Ffmpeg {
    program: PathBuf,
    version: String,
}

impl Ffmpeg {
    /// The ffmpeg that the variable `FFMPEG` names, else the one in `PATH`; `None` where neither answers.
    #[must_use]
    pub fn find() -> Option<Ffmpeg> {
        match std::env::var_os("FFMPEG").filter(|named| !named.is_empty()) {
            Some(named) => Ffmpeg::at(Path::new(&named)),
            None => Ffmpeg::at(Path::new(OsStr::new("ffmpeg"))),
        }
    }

    /// The ffmpeg at `program`, a path or a name to be looked for in `PATH`; `None` when it does not answer.
    #[must_use]
    pub fn at(program: &Path) -> Option<Ffmpeg> {
        let output = Command::new(program).arg("-version").stdin(Stdio::null()).output().ok()?;
        let text = String::from_utf8_lossy(&output.stdout);
        let version = text.lines().next()?.strip_prefix("ffmpeg version ")?.split(' ').next()?.to_owned();
        output.status.success().then(|| Ffmpeg { program: program.to_owned(), version })
    }

    /// The program as it is started.
    #[must_use]
    pub fn program(&self) -> &Path {
        &self.program
    }

    /// Its version in its own words, such as `5.1.9-0+deb12u1`.
    #[must_use]
    pub fn version(&self) -> &str {
        &self.version
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_ffmpeg_is_none() {
        for program in ["/nowhere/ffmpeg", "true", "ls", ""] {
            assert_eq!(Ffmpeg::at(Path::new(program)), None, "{program}");
        }
    }
}
