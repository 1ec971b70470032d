//! What moves, made ready for rays of any time.

use glam::{Vec3, Vec4, Vec4Swizzles};
use obvhs::aabb::Aabb;

use crate::build::{self, TRIANGLE};
use crate::fibres::Fibres;
use crate::meshes::Meshes;
use crate::moving_packs::MovingPacks;
use crate::moving_pieces::MovingPieces;
use crate::moving_tree::MovingTree;
use crate::moving_triangles::MovingTriangles;
use crate::pose::Moment;
use crate::{BuildOptions, bounds, intervals};

/// A tree over what moves.
#[derive(Clone, Debug)]
pub(crate) struct Moving {
    pub(crate) tree: MovingTree,
    /// The leaves that hold segments.
    pub(crate) packs: MovingPacks,
    pub(crate) intervals: usize,
    /// Round everything that moves, at all times.
    pub(crate) bounds: (Vec3, Vec3),
}

impl Moving {
    /// None where nothing moves that can be hit.
    pub(crate) fn build(fibres: &Fibres, meshes: &Meshes, options: &BuildOptions) -> Option<Self> {
        if fibres.tracks().is_empty() && meshes.tracks().is_empty() {
            return None;
        }
        let intervals = intervals::of(fibres, meshes);
        let pieces = MovingPieces::cut(&Moment { fibres, meshes, time: 0.5 }, intervals);
        let triangles = MovingTriangles::gather(meshes, intervals);
        if pieces.all.is_empty() && triangles.all.is_empty() {
            return None;
        }
        let around = |key: usize| -> Vec<Aabb> {
            let segments = pieces.all.iter().map(|piece| {
                let (a, b) = pieces.ends(piece, key);
                bounds::of_segment(a, b)
            });
            segments.chain(triangles.all.iter().map(|triangle| triangles.around(triangle, key))).collect()
        };
        let binary = build::binary(&mean(intervals + 1, around), options.quality);
        let mut packs = MovingPacks::new(intervals + 1);
        let packed = |place: u32| (place as usize) < pieces.all.len();
        let leaf = |places: &[u32]| match places {
            &[place] if !packed(place) => TRIANGLE | triangles.all[place as usize - pieces.all.len()].0,
            places => packs.push(&pieces, places.iter().filter_map(|&place| pieces.all.get(place as usize))),
        };
        let tree = MovingTree::from_binary(&binary, intervals + 1, around, packed, leaf);
        packs.finish();
        Some(Self { tree, packs, intervals, bounds: everywhere(fibres, meshes) })
    }

    pub(crate) fn bytes(&self) -> usize {
        self.tree.bytes() + self.packs.bytes()
    }
}

/// Boxes of the mean low and high planes at all keys: what is near on average is near in the tree.
fn mean(keys: usize, around: impl Fn(usize) -> Vec<Aabb>) -> Vec<Aabb> {
    let share = 1.0 / keys as f32;
    let mut sum: Vec<Aabb> = Vec::new();
    for key in 0..keys {
        let boxes = around(key);
        sum.resize(boxes.len(), Aabb { min: Vec3::ZERO.into(), max: Vec3::ZERO.into() });
        for (sum, around) in sum.iter_mut().zip(boxes) {
            sum.min += around.min * share;
            sum.max += around.max * share;
        }
    }
    sum
}

/// Round everything at every key, so at all times.
fn everywhere(fibres: &Fibres, meshes: &Meshes) -> (Vec3, Vec3) {
    let segments = fibres.solid().filter_map(|number| {
        let track = fibres.tracks().of(number)?;
        let (a, b) = fibres.ends(number)?;
        let at = |number, key, end: Vec4| track.at(number, key, end.xyz()).extend(end.w);
        let keys = 0..=track.intervals();
        keys.map(|key| bounds::of_segment(at(number, key, a), at(number + 1, key, b)))
            .reduce(|a, b| a.union(&b))
    });
    let triangles = (0..).zip(meshes.all()).filter_map(|(number, first)| {
        let track = meshes.tracks().of(number)?;
        let keys = 0..=track.intervals();
        keys.map(|key| bounds::of_triangle(&track.at(number, key, *first))).reduce(|a, b| a.union(&b))
    });
    build::around(segments.chain(triangles))
}
