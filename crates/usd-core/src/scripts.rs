//! Our Python programs, as files a Python can run.

use std::fs;

use tempfile::TempDir;

use crate::UsdCoreError;

/// Name and text of each; they import one another by these names.
const SCRIPTS: [(&str, &str); 5] = [
    ("check.py", include_str!("../../../tools/usd/check.py")),
    ("curve_rules.py", include_str!("../../../tools/usd/curve_rules.py")),
    ("bake.py", include_str!("../../../tools/usd/bake.py")),
    ("package.py", include_str!("../../../tools/usd/package.py")),
    ("whole_file.py", include_str!("../../../tools/usd/whole_file.py")),
];

/// Writes them to a folder that goes away with the value.
pub(crate) fn unpack() -> Result<TempDir, UsdCoreError> {
    let folder = tempfile::tempdir().map_err(|e| UsdCoreError::io("a temporary folder for tools/usd", e))?;
    for (name, text) in SCRIPTS {
        let path = folder.path().join(name);
        fs::write(&path, text).map_err(|e| UsdCoreError::io(path.display().to_string(), e))?;
    }
    Ok(folder)
}
