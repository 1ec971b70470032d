//! From geometry to a tree.

use glam::Vec3;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use crate::fibres::Fibres;
use crate::meshes::Meshes;
use crate::pack::Packs;
use crate::pieces::{self, Piece};
use crate::wide_tree::WideTree;
use crate::{BuildOptions, BuildQuality, Strands, TracingError, Triangles, bounds};

/// Marks a leaf that is a triangle; its other bits are the triangle's number.
pub(crate) const TRIANGLE: u32 = 1 << 30;

/// Refuses what could not be numbered, before anything is allocated for it.
pub(crate) fn check_counts(strands: &[Strands], triangles: &[Triangles]) -> Result<(), TracingError> {
    let most = u64::from(TRIANGLE) - 2;
    let sum = |counts: &mut dyn Iterator<Item = usize>| counts.map(|n| n as u64).sum::<u64>();
    let counts = [
        ("points", sum(&mut strands.iter().map(|s| s.positions.len()))),
        ("strands", sum(&mut strands.iter().map(|s| s.offsets.len()))),
        ("triangles", sum(&mut triangles.iter().map(|t| t.indices.len()))),
    ];
    match counts.into_iter().find(|&(_, found)| found > most) {
        Some((what, found)) => Err(TracingError::TooMany { what, found, most }),
        None => Ok(()),
    }
}

/// What rays walk through.
#[derive(Clone, Debug, Default)]
pub(crate) struct Built {
    pub(crate) tree: WideTree,
    /// The leaves that hold segments.
    pub(crate) packs: Packs,
    /// Round everything.
    pub(crate) bounds: (Vec3, Vec3),
}

impl Built {
    pub(crate) fn is_empty(&self) -> bool {
        self.tree.node_count() == 0
    }

    pub(crate) fn bytes(&self) -> usize {
        self.tree.bytes() + self.packs.bytes()
    }
}

/// The tree over everything that can be hit and stands still, and the box around it all.
pub(crate) fn tree(fibres: &Fibres, meshes: &Meshes, options: &BuildOptions) -> Built {
    let whole = segments(fibres);
    let triangles = triangles(meshes);
    let corners = |&number: &u32| bounds::of_triangle(&meshes.all()[number as usize]);
    let segments = whole.iter().map(|piece| bounds::of_segment(piece.a, piece.b));
    let bounds = around(segments.chain(triangles.iter().map(corners)));
    let pieces = pieces::cut(whole);
    let boxes: Vec<Aabb> = pieces
        .iter()
        .map(|piece| bounds::of_segment(piece.a, piece.b))
        .chain(triangles.iter().map(corners))
        .collect();
    let binary = binary(&boxes, options.quality);
    let mut packs = Packs::default();
    let packed = |place: u32| (place as usize) < pieces.len();
    let tree = WideTree::from_binary(&binary, packed, |places| match places {
        &[place] if !packed(place) => TRIANGLE | triangles[place as usize - pieces.len()],
        places => packs.push(places.iter().filter_map(|&place| pieces.get(place as usize))),
    });
    packs.finish();
    Built { tree, packs, bounds }
}

/// The box round everything; two zeros where there is nothing.
pub(crate) fn around(boxes: impl Iterator<Item = Aabb>) -> (Vec3, Vec3) {
    boxes.reduce(|a, b| a.union(&b)).map_or((Vec3::ZERO, Vec3::ZERO), |b| (b.min.into(), b.max.into()))
}

/// All segments that can be hit and stand still.
fn segments(fibres: &Fibres) -> Vec<Piece> {
    let mine = fibres.solid().filter(|&number| fibres.tracks().of(number).is_none());
    mine.filter_map(|number| fibres.ends(number).map(|(a, b)| Piece { number, a, b })).collect()
}

/// All triangles that stand still.
fn triangles(meshes: &Meshes) -> Vec<u32> {
    let all = 0..meshes.all().len() as u32;
    all.filter(|&number| meshes.tracks().of(number).is_none()).collect()
}

/// `obvhs`'s own helper would do, but it checks every tree it makes in debug builds, which takes longer
/// than the rest of a test.
pub(crate) fn binary(boxes: &[Aabb], quality: BuildQuality) -> Bvh2 {
    let (distance, plain_rounds, reinserted) = match quality {
        BuildQuality::Draft => (PlocSearchDistance::Minimum, 0, 0.0),
        BuildQuality::Standard => (PlocSearchDistance::Medium, 3, 0.05),
        BuildQuality::Best => (PlocSearchDistance::Medium, 1, 1.0),
    };
    let indices = (0..boxes.len() as u32).collect();
    let mut bvh = PlocBuilder::with_capacity(boxes.len()).build(
        distance,
        boxes,
        indices,
        SortPrecision::U64,
        plain_rounds,
    );
    ReinsertionOptimizer::default().run(&mut bvh, reinserted, None);
    bvh
}
