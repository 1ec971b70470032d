//! A ray's way through a tree: the nearest of all hits, or any.

use crate::build::{Built, TRIANGLE};
use crate::moving::Moving;
use crate::pack::{NOTHING, Sight};
use crate::pose::Pose;
use crate::query::Query;
use crate::shares::Shares;
use crate::slabs::reach;
use crate::walk::walk;
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
    pub(crate) fn search<P: Pose>(&mut self, tree: &impl Candidates, query: &Query<P>, ray: &Ray) {
        let Self { best, within, far } = self;
        tree.candidates::<true>(ray, far, |leaf, far| {
            if let Some(t) = query.hit(leaf, *within)
                && best.is_none_or(|(nearest, first)| t < nearest || leaf < first)
            {
                *best = Some((t, leaf));
                *within = t;
                *far = reach(t);
            }
            false
        });
    }

    #[inline]
    pub(crate) fn describe<P: Pose>(&self, query: &Query<P>, ray: &Ray) -> Option<Hit> {
        self.best.and_then(|(t, leaf)| query.describe(leaf, t, ray.t_max))
    }
}

/// Whether the ray hits anything.
#[inline]
pub(crate) fn any<P: Pose>(tree: &impl Candidates, query: &Query<P>, ray: &Ray) -> bool {
    let mut found = false;
    let within = f64::from(ray.t_max);
    tree.candidates::<false>(ray, &mut reach(within), |leaf, _| {
        found = query.hit(leaf, within).is_some();
        found
    });
    found
}

/// A tree that knows what a ray may hit.
pub(crate) trait Candidates {
    /// Calls `visit(number, far)` for every segment and triangle that may be hit at `far` or before; see
    /// [`walk`] for the order.
    fn candidates<const ORDERED: bool>(
        &self,
        ray: &Ray,
        far: &mut f32,
        visit: impl FnMut(u32, &mut f32) -> bool,
    );
}

impl Candidates for Built {
    #[inline(always)]
    fn candidates<const ORDERED: bool>(
        &self,
        ray: &Ray,
        far: &mut f32,
        mut visit: impl FnMut(u32, &mut f32) -> bool,
    ) {
        let sight = Sight::new(ray, self.packs.bounds());
        walk::<ORDERED>(&self.tree, ray, far, |leaf, far| {
            if leaf & TRIANGLE != 0 {
                return visit(leaf, far);
            }
            let Some(pack) = self.packs.get(leaf) else { return false };
            lanes(sight.near(pack)).any(|lane| {
                let number = pack.number(lane);
                number != NOTHING && visit(number, far)
            })
        });
    }
}

impl Candidates for Moving {
    #[inline(always)]
    fn candidates<const ORDERED: bool>(
        &self,
        ray: &Ray,
        far: &mut f32,
        mut visit: impl FnMut(u32, &mut f32) -> bool,
    ) {
        let shares = Shares::of(f64::from(ray.time), self.intervals);
        let sight = self.packs.sight(ray);
        walk::<ORDERED>(&self.tree.at(&shares), ray, far, |leaf, far| {
            if leaf & TRIANGLE != 0 {
                return visit(leaf, far);
            }
            lanes(self.packs.near(&sight, &shares, leaf)).any(|lane| {
                let number = self.packs.number(leaf, lane);
                number != NOTHING && visit(number, far)
            })
        });
    }
}

/// The lanes whose bits are set.
#[inline(always)]
fn lanes(mut mask: u32) -> impl Iterator<Item = usize> {
    std::iter::from_fn(move || {
        let lane = mask.trailing_zeros() as usize;
        let some = mask != 0;
        mask &= mask.wrapping_sub(1);
        some.then_some(lane)
    })
}
