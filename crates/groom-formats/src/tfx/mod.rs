//! AMD's TressFX strands, `.tfx`, versions 3 and 4, read.
//!
//! All strands have as many vertices. The header names its arrays by their byte offsets, 0 for those that are not
//! there (`TressFXFileObject` and `TressFXTFXFileHeader` in TressFX's `TressFXFileFormat.h`); what is in them:
//!
//! | array | becomes |
//! |---|---|
//! | positions: three floats in version 3; four in version 4, the fourth an inverse mass, 0 for a vertex that does not move | positions, and in version 4 the vertex attribute `pinned` (1 where the inverse mass is 0); `inverse_mass` too where there are other values than 0 and 1 |
//! | texture coordinate a strand | `root_uv` |
//! | texture coordinate a vertex | `uv`, vec2 |
//! | thickness a strand | `thickness`, a float a strand: no reader of AMD's uses it, so its unit is not known |
//! | colour a vertex, four floats | `color`, and `transparency` as 1 minus the fourth |
//! | guide of a strand (version 3) | `guide_index`, an int a strand |
//!
//! In version 3 the first two vertices do not move, nor the last when `bothEndsImmovable` is set (kept as
//! `both_ends_immovable` = 1 of the groom). The number of strands that follow each guide is kept as
//! `follow_strands`; they are made at run time and are not in the file. No radius, no unit and no axis are
//! in it; y is taken for up, as in AMD's own scenes.

mod header;
mod read;

pub(crate) use read::read;
