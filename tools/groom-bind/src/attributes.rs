//! What strands learn from the mesh.

use anyhow::{Context, Result};
use groom::Groom;
use groom_binding::{Binding, GroupBy, set_groups, set_root_colors, set_root_normals, set_root_uvs};

use crate::args::Attributes;
use crate::character::Character;

/// Sets the attributes that were asked for; returns the names of the groups, by number, if strands were grouped.
pub(crate) fn give(
    groom: &mut Groom,
    binding: &Binding,
    character: &Character,
    args: &Attributes,
) -> Result<Option<Vec<String>>> {
    if args.root_uv {
        set_root_uvs(groom, binding, &character.surface()).context("--root-uv")?;
    }
    if args.root_normal {
        set_root_normals(groom, binding).context("--root-normal")?;
    }
    if args.color_from_mesh {
        set_root_colors(groom, binding, &character.mesh).context("--color-from-mesh")?;
    }
    let by_material = || set_groups(groom, binding, &character.mesh, GroupBy::Material);
    args.group_by_material.then(by_material).transpose().context("--group-by-material")
}
