//! Faces of a mesh that have a material of their own (UsdGeomSubset).

use std::ops::Range;

use usd_layer::{Layer, Prim, Specifier};

use super::polygons::Fans;
use super::stage::fault_of;
use crate::error::Fault;

/// Triangles in a row: the subset that they are, if they are one.
pub(super) type Run = (Option<String>, Range<usize>);

/// Puts triangles of one material in a row: first those of the mesh's own, then subset after subset. Gives the name
/// of the subset, if it is one, and its triangles.
pub(super) fn part<B: AsRef<[u8]>>(
    layer: &Layer<B>,
    mesh: &Prim,
    fans: &mut Fans,
) -> Result<Vec<Run>, Fault> {
    let faces = fans.corner_faces.last().map_or(0, |&last| last as usize + 1);
    let mut names = vec![None];
    let mut part_of = vec![0_usize; faces];
    for subset in mesh.children.iter().filter(|child| binds_material(child)) {
        let Some(value) = subset.attribute("indices").and_then(|indices| indices.held(None)) else {
            continue;
        };
        let name = format!("{}.indices", subset.name);
        for face in layer.numbers::<i32>(value).map_err(|error| fault_of(&name, error))? {
            let place =
                usize::try_from(face).ok().and_then(|face| part_of.get_mut(face)).ok_or_else(|| {
                    Fault::invalid(&name, format!("face {face}, expected 0 to below the {faces} faces"))
                })?;
            // A face has one material: the first that claims it.
            if *place == 0 {
                *place = names.len();
            }
        }
        names.push(Some(subset.name.to_string()));
    }
    let mut order: Vec<(usize, [u32; 3], u32)> = fans
        .triangles
        .iter()
        .zip(&fans.faces)
        .map(|(&triangle, &face)| (part_of[face as usize], triangle, face))
        .collect();
    order.sort_by_key(|&(part, ..)| part);
    fans.triangles = order.iter().map(|&(_, triangle, _)| triangle).collect();
    fans.faces = order.iter().map(|&(.., face)| face).collect();
    let mut start = 0;
    let ranges = names.into_iter().enumerate().map(|(part, name)| {
        let end = start + order[start..].partition_point(|&(of, ..)| of == part);
        let range = start..end;
        start = end;
        (name, range)
    });
    let parts: Vec<_> = ranges.filter(|(name, range)| name.is_none() || !range.is_empty()).collect();
    let only_subsets = parts.len() > 1 && parts.first().is_some_and(|(_, range)| range.is_empty());
    Ok(parts.into_iter().skip(usize::from(only_subsets)).collect())
}

fn binds_material(prim: &Prim) -> bool {
    let text = |name: &str| prim.attribute(name).and_then(|attribute| attribute.held(None)?.text());
    &*prim.type_name == "GeomSubset"
        && prim.specifier == Specifier::Def
        && prim.is_active()
        && text("familyName") == Some("materialBind")
        && matches!(text("elementType"), None | Some("face"))
}
