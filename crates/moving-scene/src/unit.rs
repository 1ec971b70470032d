//! Which files say how large their unit is.

use groom::Groom;
use groom_formats::Format;

/// Whether a file of this format says how large its unit is.
#[must_use]
pub fn says_unit(format: Format, groom: &Groom) -> bool {
    match format {
        Format::Usda | Format::Usdc | Format::Usdz | Format::Gltf | Format::Glb => true,
        // Only Alembic files of ours say it; 1 is what a reader takes where nothing is said.
        Format::Alembic => groom.meters_per_unit != 1.0,
        _ => false,
    }
}
