//! Into how many intervals of the shutter a tree divides the motion of its objects.
//!
//! A key costs a tree as much memory as all of a still one's boxes and packs, and with it caches. Where an
//! object's path between two keys of the tree is nearly straight, more keys only cost: what moves strays
//! from that line by little beside its own thickness, and is taken to be that much thicker.

use crate::fibres::Fibres;
use crate::meshes::Meshes;
use crate::moving_pieces::MovingPieces;
use crate::moving_triangles::MovingTriangles;

/// Most intervals that a tree has boxes for.
const MOST: usize = 16;
/// How far things may stray, as a share of their size. A quarter of the radius makes rays test about a quarter
/// more fibres, which costs less than another key.
const BEARABLE: f64 = 1.0 / 4.0;
/// Segments and triangles looked at to tell.
const SAMPLES: usize = 4096;

/// For a tree over all that moves, at least 1.
pub(crate) fn of(fibres: &Fibres, meshes: &Meshes) -> usize {
    let objects = fibres.tracks().intervals().chain(meshes.tracks().intervals());
    let most = objects.max().unwrap_or(1).clamp(1, MOST);
    (1..=most).find(|&count| follows(fibres, meshes, count)).unwrap_or_else(|| shared(fibres, meshes, most))
}

/// Whether what moves stays near enough to straight lines between so many keys.
fn follows(fibres: &Fibres, meshes: &Meshes, count: usize) -> bool {
    let bearable = |samples: &mut dyn Iterator<Item = (f64, f64)>| {
        let (stray, size) = samples.fold((0.0, 0.0), |sum, next| (sum.0 + next.0, sum.1 + next.1));
        stray <= BEARABLE * size
    };
    bearable(&mut MovingPieces::strays(fibres, count, SAMPLES))
        && bearable(&mut MovingTriangles::strays(meshes, count, SAMPLES))
}

/// Where nothing less will do: every object's keys are among the tree's, unless those are too many.
fn shared(fibres: &Fibres, meshes: &Meshes, most: usize) -> usize {
    let objects = fibres.tracks().intervals().chain(meshes.tracks().intervals());
    let multiple = |count: usize| objects.clone().all(|intervals| count.is_multiple_of(intervals.max(1)));
    (most..=MOST).find(|&count| multiple(count)).unwrap_or(most)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used)]

    use glam::{Vec3, vec3};

    use super::*;
    use crate::{Radii, Strands, Triangles};

    /// A strand that turns, and a triangle that goes to and fro.
    fn of_keys(degrees: f32, radius: f32, strand: usize, triangle: usize) -> usize {
        let turned = |key: usize| {
            let angle = degrees.to_radians() * key as f32 / strand.max(2) as f32;
            [vec3(angle.cos(), angle.sin(), 0.0), vec3(angle.cos(), angle.sin(), 0.1)]
        };
        let there = |key: usize| [Vec3::ZERO, Vec3::X, Vec3::Y].map(|p| p + Vec3::Z * (key % 2) as f32);
        let turns: Vec<_> = (0..strand).map(turned).collect();
        let goes: Vec<_> = (0..triangle).map(there).collect();
        let moved: Vec<&[Vec3]> = turns[1..].iter().map(|key| key.as_slice()).collect();
        let radii = Radii::Constant(radius);
        let strands = Strands { offsets: &[0, 2], positions: &turns[0], radii, moved: &moved };
        let moved: Vec<&[Vec3]> = goes[1..].iter().map(|key| key.as_slice()).collect();
        let triangles = Triangles { positions: &goes[0], indices: &[[0, 1, 2]], moved: &moved };
        of(&Fibres::gather(&[strands]).unwrap(), &Meshes::gather(&[triangles]).unwrap())
    }

    #[test]
    fn straight_paths_need_two_keys_and_corners_need_their_own() {
        assert_eq!([of_keys(0.0, 0.1, 9, 1), of_keys(5.0, 0.1, 9, 1), of_keys(90.0, 0.1, 2, 1)], [1; 3]);
        assert_eq!(of_keys(90.0, 0.1, 9, 1), 4);
        assert_eq!(of_keys(90.0, 1e-3, 9, 1), 8);
        assert_eq!(of_keys(90.0, 1e-3, 64, 1), 16);
        assert_eq!(of_keys(0.0, 0.1, 2, 6), 5);
        assert_eq!(of_keys(90.0, 1e-4, 3, 4), 6);
        assert_eq!(of_keys(0.0, 0.1, 2, 64), 16);
    }
}
