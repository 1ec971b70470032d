//! Other runs in the same folder, and which frames they are at.

use std::path::Path;

use whole_file::{WholeFile, other_writers};

use super::frames::OfOthers;
use crate::TurntableError;

/// Opens the file that a frame is to become under its temporary name, for as long as it is rendered; none where the
/// frame is put off because another run has it open.
///
/// The name says whose it is, and that is all there is to it: nobody waits for anybody, what a run puts off it renders
/// in the end if it is not there by then, and whoever errs (a machine that died, a folder that shows files late) does
/// work twice, as without it. A folder that cannot be written to is found out before the work and not after it.
pub(super) fn begun(frame: &Path, of_others: OfOthers) -> Result<Option<WholeFile>, TurntableError> {
    let puts_off = of_others == OfOthers::PutOff;
    if puts_off && !other_writers(frame).is_empty() {
        return Ok(None);
    }
    let own = WholeFile::create(frame)?;
    // Of two that began at once and see each other, the first by name goes on.
    let name = own.temporary_path().file_name();
    let is_first = || other_writers(frame).iter().all(|other| name < Some(other.as_os_str()));
    Ok((!puts_off || is_first()).then_some(own))
}
