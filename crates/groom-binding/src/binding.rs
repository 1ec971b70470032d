//! Every strand's place on a surface.

use glam::{DQuat, DVec3};
use groom::Groom;
use rayon::prelude::*;

use crate::root::place;
use crate::root_frame::rest_turn;
use crate::root_places::{self, Found, Place};
use crate::vertex_normals::{PoseNormals, VertexNormals};
use crate::{Beyond, BindOptions, BindReport, BindingError, Root, RootFrame, Surface, TopologyHash};

/// Every strand's place on a surface, found once at rest and good for every pose of that mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Binding {
    roots: Vec<Root>,
    topology: TopologyHash,
}

impl Binding {
    /// Binds every strand of `groom` to `surface` by its root, both at rest and in the same numbers.
    ///
    /// The same input gives the same bits, whatever the number of threads.
    ///
    /// # Errors
    /// [`BindingError`]: an option out of range, a surface whose triangles lack vertices, numbers that are not
    /// finite, a groom without the attribute it is to be bound by, or strands and no triangle at all.
    pub fn new(
        groom: &Groom,
        surface: &Surface<'_>,
        options: &BindOptions,
    ) -> Result<(Binding, BindReport), BindingError> {
        options.check()?;
        surface.check()?;
        check_points(groom)?;
        let firsts = root_places::roots(groom);
        let (places, normals) = rayon::join(
            || root_places::find(groom, &firsts, surface, options.by),
            || VertexNormals::of(surface),
        );
        let places = places?;
        let normals = normals.at_pose(surface.triangles, &surface.rest.positions);
        let bound: Vec<(Root, f64)> = places
            .par_iter()
            .enumerate()
            .map(|(strand, place)| bind(firsts[strand], surface, &normals, place))
            .collect();
        let distances = bound.iter().map(|(_, distance)| *distance).collect();
        let mut report = BindReport::of(surface.size(), distances, options);
        let listed = |kind| {
            let of_kind = places.iter().enumerate().filter(move |(_, place)| place.found == kind);
            of_kind.map(|(strand, _)| strand as u32).collect()
        };
        report.ambiguous = listed(Found::AmongOthers);
        report.outside = listed(Found::Nearby);
        let mut roots: Vec<Root> = bound.into_iter().map(|(root, _)| root).collect();
        apply_limit(&firsts, &mut roots, &mut report, options.beyond);
        report.without_frame = roots.iter().filter(|root| root.facing.is_none()).count();
        let topology = TopologyHash::of(surface.rest.positions.len(), surface.triangles);
        Ok((Binding { roots, topology }, report))
    }

    /// Where each strand is bound.
    #[must_use]
    pub fn roots(&self) -> &[Root] {
        &self.roots
    }

    /// How many strands are bound.
    #[must_use]
    pub fn strand_count(&self) -> usize {
        self.roots.len()
    }

    /// The mesh that strands are bound to.
    #[must_use]
    pub fn topology(&self) -> TopologyHash {
        self.topology
    }

    /// Refuses a groom or a surface that this binding is not of.
    ///
    /// # Errors
    /// [`BindingError::Invalid`]: the groom has another number of strands, or the mesh other triangles.
    pub fn check(&self, groom: &Groom, surface: &Surface<'_>) -> Result<(), BindingError> {
        self.check_groom(groom)?;
        self.check_surface(surface)
    }

    pub(crate) fn check_groom(&self, groom: &Groom) -> Result<(), BindingError> {
        let (found, expected) = (groom.strand_count(), self.strand_count());
        if found == expected {
            return Ok(());
        }
        let expected = format!("as many as are bound: {expected}");
        Err(BindingError::invalid("groom", format!("{found} strands"), expected))
    }

    pub(crate) fn check_surface(&self, surface: &Surface<'_>) -> Result<(), BindingError> {
        surface.check()?;
        let found = TopologyHash::of(surface.rest.positions.len(), surface.triangles);
        if found == self.topology {
            return Ok(());
        }
        let expected = format!("those strands were bound to, topology {}", self.topology);
        Err(BindingError::invalid("mesh", format!("triangles of topology {found}"), expected))
    }
}

fn check_points(groom: &Groom) -> Result<(), BindingError> {
    let Some(point) = groom.positions().par_iter().position_first(|p| !p.is_finite()) else {
        return Ok(());
    };
    let strand = groom.offsets().partition_point(|&first| first as usize <= point) - 1;
    let place = format!("strand {strand}, point {}", point - groom.offsets()[strand] as usize);
    Err(BindingError::invalid(place, groom.positions()[point].to_string(), "finite numbers"))
}

/// The root bound to its place, and how far it is from it.
fn bind(
    root: DVec3,
    surface: &Surface<'_>,
    normals: &PoseNormals<'_>,
    &Place { triangle, barycentrics, .. }: &Place,
) -> (Root, f64) {
    let corners = surface.corners(&surface.rest.positions, triangle);
    let at_corners = normals.at_corners(surface.triangles[triangle as usize]);
    let (rotation, facing) = match rest_turn(corners, at_corners, barycentrics) {
        Some((rotation, facing)) => (rotation, Some(facing)),
        None => (DQuat::IDENTITY, None),
    };
    let origin = place(corners, barycentrics);
    let offset = root - origin;
    let distance = offset.length();
    let height = if offset.dot(rotation * DVec3::Y) < 0.0 { -distance } else { distance };
    let rest = RootFrame { origin, rotation };
    (Root { triangle, barycentrics, height, rest, facing }, distance)
}

/// Does what is to be done with the strands beyond the limit.
fn apply_limit(firsts: &[DVec3], roots: &mut Vec<Root>, report: &mut BindReport, beyond: Beyond) {
    if report.beyond.is_empty() {
        return;
    }
    match beyond {
        Beyond::Keep => {}
        Beyond::Snap => {
            for &strand in &report.beyond {
                let snapped = &mut roots[strand as usize];
                snapped.rest.origin = firsts[strand as usize];
                snapped.height = 0.0;
            }
        }
        Beyond::Drop => {
            let mut dropped = vec![false; roots.len()];
            for &strand in &report.beyond {
                dropped[strand as usize] = true;
            }
            let kept: Vec<u32> = (0..roots.len() as u32).filter(|&s| !dropped[s as usize]).collect();
            *roots = kept.iter().map(|&strand| roots[strand as usize]).collect();
            report.kept = Some(kept);
        }
    }
}
