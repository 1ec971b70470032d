//! From geometry to a tree.

use glam::Vec3;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};

use crate::fibres::Fibres;
use crate::meshes::Meshes;
use crate::wide_tree::WideTree;
use crate::{BuildOptions, BuildQuality, Strands, TracingError, Triangles, bounds};

/// Marks a leaf that is a triangle; its other bits are the triangle's number.
pub(crate) const TRIANGLE: u32 = 1 << 30;

/// One box of the tree and what is in it.
struct Boxes {
    boxes: Vec<Aabb>,
    leaves: Vec<u32>,
}

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

/// The tree over everything that can be hit, and the box around it all.
pub(crate) fn tree(fibres: &Fibres, meshes: &Meshes, options: &BuildOptions) -> (WideTree, (Vec3, Vec3)) {
    let Boxes { boxes, leaves } = boxes(fibres, meshes);
    let all = boxes.iter().copied().reduce(|a, b| a.union(&b));
    let bounds = all.map_or((Vec3::ZERO, Vec3::ZERO), |b| (b.min.into(), b.max.into()));
    let binary = binary(&boxes, options.quality);
    (WideTree::from_binary(&binary, |place| leaves[place]), bounds)
}

fn boxes(fibres: &Fibres, meshes: &Meshes) -> Boxes {
    let mut boxes = Vec::new();
    let mut leaves = Vec::new();
    for number in fibres.solid() {
        if let Some((a, b)) = fibres.ends(number) {
            boxes.push(bounds::of_segment(a, b));
            leaves.push(number);
        }
    }
    for (number, triangle) in meshes.all().iter().enumerate() {
        boxes.push(bounds::of_triangle(triangle));
        leaves.push(TRIANGLE | number as u32);
    }
    Boxes { boxes, leaves }
}

/// `obvhs`'s own helper would do, but it checks every tree it makes in debug builds, which takes longer
/// than the rest of a test.
fn binary(boxes: &[Aabb], quality: BuildQuality) -> Bvh2 {
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
