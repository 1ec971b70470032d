//! What the options do to a groom.

use groom::{Groom, GroomError};

use crate::args::Args;

/// Does what the options ask for, in the order of the help.
pub(crate) fn edit(mut groom: Groom, args: &Args) -> Result<Groom, GroomError> {
    if let Some(stride) = args.strands.stride.filter(|&stride| stride > 1) {
        groom = groom.subsample_by_stride(stride as usize)?;
    }
    if let Some(most) =
        args.strands.max_strands.map(|most| most as usize).filter(|&most| most < groom.strand_count())
    {
        groom = groom.subsample_to(most);
    }
    if let Some(points) = args.strands.resample {
        groom = groom.resample_by_count(points as usize)?;
    }
    if let Some(factor) = args.strands.scale {
        groom.scale(factor)?;
    }
    if let Some(up) = args.strands.up {
        groom.turn_to(up.into());
    }
    if let Some(color) = args.look.color {
        groom.set_color(color)?;
    }
    if let (Some(root), Some(tip)) = (args.look.root_color, args.look.tip_color) {
        groom.ramp_color(root, tip)?;
    }
    if let Some(width) = args.look.width {
        groom.set_width(width)?;
    }
    if let (Some(root), Some(tip)) = (args.look.root_width, args.look.tip_width) {
        groom.ramp_width(root, tip)?;
    }
    Ok(groom)
}
