//! Alembic as a groom.

use crate::{Format, FormatError, Loaded, ReadOptions};

pub(crate) fn read(bytes: &[u8], name: &str, options: &ReadOptions) -> Result<Loaded, FormatError> {
    let _ = (bytes, options);
    Err(FormatError::Unsupported {
        file: name.to_owned(),
        format: Format::Alembic,
        what: "cannot be read yet",
    })
}
