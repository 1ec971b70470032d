//! Which points make which strand, and where on a curve the points of a strand lie.

use super::cubic::Basis;
use super::values::Fault;

/// How a curve goes on beyond its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wrap {
    Nonperiodic,
    Periodic,
    Pinned,
}

/// How curves go through their points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shape {
    /// `None` for lines.
    pub(super) basis: Option<Basis>,
    pub(super) wrap: Wrap,
}

/// How many parts every span of every curve is cut into; spans of lines are one part.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Sampling {
    pub(super) counts: Vec<u32>,
    /// One number a span of a cubic curve, curves one after another.
    pub(super) parts: Vec<u16>,
}

impl Shape {
    /// How many spans a curve of so many points has; `None` if there is no such curve.
    pub(super) fn spans(self, points: u32) -> Option<u32> {
        let enough = |least: u32| points.checked_sub(least);
        match (self.basis, self.wrap) {
            (None, Wrap::Periodic) => enough(1).map(|_| points),
            (None, _) => enough(1),
            // Points behind the last whole span belong to none, as renderers have it.
            (Some(Basis::Bezier), Wrap::Periodic) => enough(3).map(|more| more / 3 + 1),
            (Some(Basis::Bezier), _) => enough(4).map(|more| more / 3 + 1),
            (Some(_), Wrap::Periodic) => enough(3).map(|_| points),
            (Some(_), Wrap::Nonperiodic) => enough(4).map(|more| more + 1),
            (Some(_), Wrap::Pinned) => enough(2).map(|more| more + 1),
        }
    }

    /// What [`spans`](Self::spans) asks for, in words.
    fn expected(self) -> &'static str {
        match (self.basis, self.wrap) {
            (None, _) => "1 or more",
            (Some(Basis::Bezier), Wrap::Periodic) => "3 or more for periodic bezier curves",
            (Some(Basis::Bezier), _) => "4 or more for bezier curves",
            (Some(_), Wrap::Periodic) => "3 or more for periodic curves",
            (Some(_), Wrap::Nonperiodic) => "4 or more for curves that are not pinned",
            (Some(_), Wrap::Pinned) => "2 or more for pinned curves",
        }
    }

    /// The numbers of points, checked: none is empty, none too short, and they add up.
    pub(super) fn check(self, counts: &[i32], points: usize) -> Result<Vec<u32>, Fault> {
        const NAME: &str = "curveVertexCounts";
        let mut sum = 0_u64;
        let mut checked = Vec::with_capacity(counts.len());
        for (curve, &count) in counts.iter().enumerate() {
            let Ok(count) = u32::try_from(count) else {
                return Err(Fault::value(NAME, format!("{count} points of curve {curve}"), "0 or more"));
            };
            if count > 0 && self.spans(count).is_none() {
                return Err(Fault::value(NAME, format!("{count} points of curve {curve}"), self.expected()));
            }
            sum += u64::from(count);
            checked.push(count);
        }
        if sum != points as u64 {
            return Err(Fault::value(
                NAME,
                format!("counts that add up to {sum}"),
                format!("{points}, the points there are"),
            ));
        }
        Ok(checked)
    }

    /// How many values of interpolation `varying` a curve has: one at every end of a span.
    pub(super) fn varying(self, points: u32) -> u32 {
        let spans = self.spans(points).unwrap_or_default();
        if self.wrap == Wrap::Periodic || points == 0 { spans } else { spans + 1 }
    }
}
