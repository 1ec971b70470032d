//! Where on the surface every root belongs.

use glam::{DVec3, Vec2};
use groom::{Attribute, Domain, Groom, Values, names};
use rayon::prelude::*;

use crate::root::place;
use crate::space_curve::along_a_curve;
use crate::surface_tree::{Nearest, Search, SurfaceTree};
use crate::{BindBy, BindingError, ROOT_TRIANGLE, Surface, closest_point};

/// A place in a triangle.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) triangle: u32,
    pub(crate) barycentrics: DVec3,
    pub(crate) found: Found,
}

/// How sure a place is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Found {
    Surely,
    /// Others would have done as well.
    AmongOthers,
    /// It is the nearest there is, and not what was asked for.
    Nearby,
}

/// Strands that look for their place in one go.
const BLOCK: usize = 256;

/// How far apart two places of one texture coordinate are before they are two, in sizes of the mesh; and how far
/// outside a triangle a coordinate may be and still be in it, in sizes of the texture.
const APART: f64 = 1e-6;

/// A place for every strand, whose first points are `roots`. There must be a triangle when there is a strand.
pub(crate) fn find(
    groom: &Groom,
    roots: &[DVec3],
    surface: &Surface<'_>,
    by: BindBy,
) -> Result<Vec<Place>, BindingError> {
    if groom.strand_count() == 0 {
        return Ok(Vec::new());
    }
    let positions = &surface.rest.positions;
    let corners = |triangle: u32| surface.corners(positions, triangle);
    match by {
        BindBy::Nearest => {
            let tree = SurfaceTree::of_sound(surface.triangles.len(), corners, corners);
            in_blocks(roots, |strand, search| {
                let nearest = tree.nearest(roots[strand], search);
                nearest.map(|n| from_nearest(n, Found::Surely)).ok_or_else(no_triangle)
            })
        }
        BindBy::RootUv => by_uv(groom, roots, surface),
        BindBy::RootTriangle => {
            let given = given_triangles(groom, surface.triangles.len())?;
            in_blocks(roots, |strand, _| {
                let (triangle, root) = (given[strand], roots[strand]);
                let on = closest_point::to_origin(corners(triangle).map(|p| p - root));
                Ok(Place { triangle, barycentrics: on.barycentrics, found: Found::Surely })
            })
        }
    }
}

fn from_nearest(nearest: Nearest, found: Found) -> Place {
    Place { triangle: nearest.triangle, barycentrics: nearest.barycentrics, found }
}

fn no_triangle() -> BindingError {
    BindingError::invalid("mesh", "no triangle", "one or more, to bind strands to")
}

/// The first point of every strand: once, as they lie far apart in memory.
pub(crate) fn roots(groom: &Groom) -> Vec<DVec3> {
    let firsts = groom.offsets().iter().take(groom.strand_count());
    firsts.map(|&first| groom.positions()[first as usize].as_dvec3()).collect()
}

/// Asks for the place of every strand, in parallel.
///
/// Strands are taken in the order of a curve through space: the last answer is then near the next, wherever in the
/// groom a strand is.
fn in_blocks(
    roots: &[DVec3],
    find: impl Fn(usize, &mut Search) -> Result<Place, BindingError> + Sync,
) -> Result<Vec<Place>, BindingError> {
    let order = along_a_curve(roots);
    let found: Result<Vec<Vec<(u32, Place)>>, BindingError> = order
        .par_chunks(BLOCK)
        .map(|strands| {
            let mut search = Search::default();
            let of = |&strand: &u32| Ok((strand, find(strand as usize, &mut search)?));
            strands.iter().map(of).collect()
        })
        .collect();
    let nowhere = Place { triangle: 0, barycentrics: DVec3::X, found: Found::Surely };
    let mut places = vec![nowhere; roots.len()];
    for (strand, place) in found?.into_iter().flatten() {
        places[strand as usize] = place;
    }
    Ok(places)
}

fn by_uv(groom: &Groom, roots: &[DVec3], surface: &Surface<'_>) -> Result<Vec<Place>, BindingError> {
    let expected = "one a vertex, to bind by";
    let uvs = surface.uvs.ok_or_else(|| BindingError::invalid("mesh", "no texture coordinates", expected))?;
    if let Some(vertex) = uvs.iter().position(|uv| !uv.is_finite()) {
        let place = format!("texture coordinate {vertex}");
        return Err(BindingError::invalid(place, uvs[vertex].to_string(), "finite numbers"));
    }
    let given = given_uvs(groom)?;
    let flat = |uv: Vec2| uv.as_dvec2().extend(0.0);
    let in_texture = |triangle: u32| surface.triangles[triangle as usize].map(|v| flat(uvs[v as usize]));
    let positions = &surface.rest.positions;
    let in_rest = |triangle: u32| surface.corners(positions, triangle);
    let tree = SurfaceTree::of_sound(surface.triangles.len(), in_rest, in_texture);
    let (in_texture, in_space) = (APART * tree.size(), APART * surface.size());
    in_blocks(roots, |strand, search| {
        let (uv, root) = (flat(given[strand]), roots[strand]);
        let nearest = tree.nearest(uv, search).ok_or_else(no_triangle)?;
        let distance = nearest.distance_squared.sqrt();
        let mut found: Vec<(f64, u32, DVec3, Nearest)> = tree
            .within(uv, distance + in_texture, search)
            .into_iter()
            .map(|n| {
                let at = place(surface.corners(positions, n.triangle), n.barycentrics);
                (at.distance_squared(root), n.triangle, at, n)
            })
            .collect();
        found.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let Some(&(_, _, at, best)) = found.first() else { return Ok(from_nearest(nearest, Found::Nearby)) };
        let others = found.iter().any(|other| other.2.distance(at) > in_space);
        Ok(match (distance > in_texture, others) {
            (true, _) => from_nearest(best, Found::Nearby),
            (false, true) => from_nearest(best, Found::AmongOthers),
            (false, false) => from_nearest(best, Found::Surely),
        })
    })
}

/// The `root_uv` of every strand.
fn given_uvs(groom: &Groom) -> Result<Vec<Vec2>, BindingError> {
    let expected = "one vec2 a strand, to bind by";
    let given = match groom.attribute(names::ROOT_UV) {
        Some(Attribute { domain: Domain::Strand, values: Values::Vec2(uvs) }) => uvs.clone(),
        Some(Attribute { domain: Domain::Vertex, values: Values::Vec2(uvs) }) => {
            groom.offsets()[..groom.strand_count()].iter().map(|&first| uvs[first as usize]).collect()
        }
        other => return Err(missing(names::ROOT_UV, other, expected)),
    };
    match given.iter().position(|uv| !uv.is_finite()) {
        Some(strand) => {
            let found = format!("{} {}", names::ROOT_UV, given[strand]);
            Err(BindingError::invalid(format!("strand {strand}"), found, "finite numbers"))
        }
        None => Ok(given),
    }
}

/// The triangle that every strand names.
fn given_triangles(groom: &Groom, count: usize) -> Result<Vec<u32>, BindingError> {
    let given = match groom.attribute(ROOT_TRIANGLE) {
        Some(Attribute { domain: Domain::Strand, values: Values::Int(given) }) => given,
        other => return Err(missing(ROOT_TRIANGLE, other, "one int a strand, to bind by")),
    };
    let checked = given.iter().enumerate().map(|(strand, &triangle)| match u32::try_from(triangle) {
        Ok(known) if (known as usize) < count => Ok(known),
        _ => {
            let found = format!("{ROOT_TRIANGLE} {triangle}");
            Err(BindingError::invalid(
                format!("strand {strand}"),
                found,
                format!("0 or more, less than {count}"),
            ))
        }
    });
    checked.collect()
}

fn missing(name: &str, found: Option<&Attribute>, expected: &str) -> BindingError {
    let found = match found {
        None => "not there".to_owned(),
        Some(other) => format!("{} per {:?}", other.values.type_name(), other.domain).to_lowercase(),
    };
    BindingError::invalid(format!("attribute `{name}`"), found, expected)
}
