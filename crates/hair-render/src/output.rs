//! Whether a picture can be written, asked before it is made.

use std::path::Path;

use whole_file::WholeFile;

use crate::RenderError;

/// Finds out whether a picture could be written to `path`, whose ending must be `ending` (without its
/// dot, letter case aside), so that no long render is lost for want of a folder. Leaves nothing behind.
///
/// # Errors
/// [`RenderError::Argument`] for another ending, [`RenderError::Io`] for a folder that is missing or
/// cannot be written to.
pub fn check_output(path: &Path, ending: &'static str) -> Result<(), RenderError> {
    if !path.extension().is_some_and(|found| found.eq_ignore_ascii_case(ending)) {
        return Err(RenderError::argument(
            "output",
            path.display(),
            match ending {
                "exr" => "a name that ends in .exr",
                "png" => "a name that ends in .png",
                _ => "a name with the ending of its format",
            },
        ));
    }
    // Dropped at once, which removes it.
    WholeFile::create(path)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_can_be_written_passes_and_nothing_is_left() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        assert!(check_output(&at("a.exr"), "exr").is_ok() && check_output(&at("A.EXR"), "exr").is_ok());
        for name in ["a.png", "exr", "a.exr.bak"] {
            assert!(matches!(check_output(&at(name), "exr"), Err(RenderError::Argument { .. })), "{name}");
        }
        assert!(matches!(check_output(&at("no/a.exr"), "exr"), Err(RenderError::Io { .. })));
        std::fs::create_dir(at("folder.exr")).unwrap();
        assert!(matches!(check_output(&at("folder.exr"), "exr"), Err(RenderError::Io { .. })));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
    }
}
