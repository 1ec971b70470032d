//! Reading the groom and bringing it to the mesh.

use anyhow::{Result, bail};
use groom::Groom;
use groom_binding::Space;
use groom_formats::Format;

use crate::align::align;
use crate::args::Args;
use crate::character::Character;
use crate::plausible::Turned;

/// A groom in the mesh's numbers.
pub(crate) struct Aligned {
    pub(crate) groom: Groom,
    pub(crate) turned: Turned,
    pub(crate) warnings: Vec<String>,
    pub(crate) repairs: Vec<String>,
}

pub(crate) fn load(args: &Args, character: &Character) -> Result<Aligned> {
    let path = args.groom();
    let Some(named) = Format::from_path(path).filter(|format| format.can_read()) else {
        let known: Vec<_> = Format::ALL.into_iter().filter(|f| f.can_read()).map(Format::name).collect();
        bail!("{}: no groom format has this ending; expected one of {}", path.display(), known.join(", "));
    };
    let loaded = groom_formats::read(path, &args.aligning.read_options())?;
    let mut groom = loaded.groom;
    if let Some(up) = args.aligning.up {
        groom.up_axis = up.into();
    }
    let from = groom.up_axis;
    let space = Space::of(&character.mesh, args.mesh()?);
    align(&mut groom, loaded.format.unwrap_or(named), space, &args.aligning)?;
    let mut warnings: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    if loaded.times.len() > 1 {
        warnings.push(format!("{} moves by itself; its first frame is bound", path.display()));
    }
    let turned = Turned { from, to: space.up_axis };
    Ok(Aligned { groom, turned, warnings, repairs: loaded.repairs })
}
