//! A ray's way through a tree: the nearest of all hits, or any.

use crate::build::{Built, TRIANGLE};
use crate::pack::{NOTHING, Sight};
use crate::pose::Pose;
use crate::query::Query;
use crate::wide_tree::reach;
use crate::{Hit, Ray};

/// The nearest hit so far.
pub(crate) struct Nearest {
    best: Option<(f64, u32)>,
    within: f64,
    far: f32,
}

impl Nearest {
    #[inline]
    pub(crate) fn new(ray: &Ray) -> Self {
        let within = f64::from(ray.t_max);
        Self { best: None, within, far: reach(within) }
    }

    #[inline]
    pub(crate) fn search<P: Pose>(&mut self, built: &Built, query: &Query<P>, ray: &Ray) {
        let sight = Sight::new(ray, built.packs.bounds());
        let Self { best, within, far } = self;
        built.tree.walk::<true>(ray, far, |leaf, far| {
            each(built, &sight, leaf, |leaf| {
                if let Some(t) = query.hit(leaf, *within)
                    && best.is_none_or(|(nearest, first)| t < nearest || leaf < first)
                {
                    *best = Some((t, leaf));
                    *within = t;
                    *far = reach(t);
                }
                false
            })
        });
    }

    #[inline]
    pub(crate) fn describe<P: Pose>(&self, query: &Query<P>, ray: &Ray) -> Option<Hit> {
        self.best.and_then(|(t, leaf)| query.describe(leaf, t, ray.t_max))
    }
}

/// Whether the ray hits anything.
#[inline]
pub(crate) fn any<P: Pose>(built: &Built, query: &Query<P>, ray: &Ray) -> bool {
    let sight = Sight::new(ray, built.packs.bounds());
    let mut found = false;
    let within = f64::from(ray.t_max);
    built.tree.walk::<false>(ray, &mut reach(within), |leaf, _| {
        each(built, &sight, leaf, |leaf| {
            found = query.hit(leaf, within).is_some();
            found
        })
    });
    found
}

/// Calls `visit` for what a leaf of the tree holds and the ray may hit, until it returns true.
#[inline(always)]
fn each(built: &Built, sight: &Sight, leaf: u32, mut visit: impl FnMut(u32) -> bool) -> bool {
    if leaf & TRIANGLE != 0 {
        return visit(leaf);
    }
    let Some(pack) = built.packs.get(leaf) else { return false };
    let mut near = sight.near(pack);
    while near != 0 {
        let number = pack.number(near.trailing_zeros() as usize);
        near &= near - 1;
        if number != NOTHING && visit(number) {
            return true;
        }
    }
    false
}
