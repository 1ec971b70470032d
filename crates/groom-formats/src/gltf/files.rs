//! A plan into the files it is for.

use std::io::{BufWriter, Write};
use std::path::Path;

use super::{Plan, glb};
use crate::{Format, FormatError, Output, Warning};

/// Bytes gathered before the system is asked to write them.
const BUFFER: usize = 1 << 20;

/// Writes a `.glb`, or a `.gltf` and its bytes beside it. Both of those are finished before the first takes its
/// place, the bytes first.
pub(crate) fn write(
    plan: Plan<'_>,
    format: Format,
    path: &Path,
    file: &str,
) -> Result<Vec<Warning>, FormatError> {
    if format == Format::Glb {
        let output = filled(path, file, |stream| glb::write(&plan, stream))?;
        output.commit()?;
        return Ok(plan.into_warnings());
    }
    let bytes_path = path.with_extension("bin");
    let bytes_name = bytes_path.file_name().unwrap_or_default().as_encoded_bytes();
    let bytes = filled(&bytes_path, &bytes_path.display().to_string(), |stream| plan.write_bytes(stream))?;
    let document = filled(path, file, |stream| stream.write_all(&plan.json(Some(bytes_name))?))?;
    bytes.commit()?;
    document.commit()?;
    Ok(plan.into_warnings())
}

/// Runs `body` on a buffered output; what comes back is written but not yet in its place.
fn filled(
    path: &Path,
    name: &str,
    body: impl FnOnce(&mut BufWriter<Output>) -> std::io::Result<()>,
) -> Result<Output, FormatError> {
    let mut stream = BufWriter::with_capacity(BUFFER, Output::create(path)?);
    body(&mut stream).map_err(|e| FormatError::io(name, e))?;
    stream.into_inner().map_err(|e| FormatError::io(name, e.into_error()))
}
