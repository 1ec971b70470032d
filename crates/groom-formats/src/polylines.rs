//! Curves of a file as the polylines a groom is made of: which points make which strand, and where on a curve
//! the points of a strand lie.

use crate::cubic::{self, Basis, Point, RELATIVE_ERROR, Tolerance};

/// Points of polylines a control point, at most, unless an error is asked for.
const MOST_GROWTH: u64 = 4;

/// Points that are always within the bound: a megabyte of positions and radii.
const FREE_POINTS: u64 = 1 << 16;

/// How often the error is doubled before every span becomes one line.
const MOST_DOUBLINGS: i32 = 40;

/// How a curve goes on beyond its ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wrap {
    Nonperiodic,
    Periodic,
    Pinned,
}

/// How curves go through their points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Shape {
    /// `None` for lines.
    pub(crate) basis: Option<Basis>,
    pub(crate) wrap: Wrap,
}

impl Shape {
    /// How many spans a curve of so many points has; `None` if there is no such curve.
    pub(crate) fn spans(self, points: u32) -> Option<u32> {
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

    /// The numbers of points, checked: none is too short, and they add up; else what was found and expected.
    pub(crate) fn check(self, counts: &[i32], points: usize) -> Result<Vec<u32>, (String, String)> {
        let mut sum = 0_u64;
        let mut checked = Vec::with_capacity(counts.len());
        for (curve, &count) in counts.iter().enumerate() {
            let found = || format!("{count} points of curve {curve}");
            let count = u32::try_from(count).map_err(|_| (found(), "0 or more".to_owned()))?;
            if count > 0 && self.spans(count).is_none() {
                return Err((found(), self.expected().to_owned()));
            }
            sum += u64::from(count);
            checked.push(count);
        }
        if sum == points as u64 {
            return Ok(checked);
        }
        Err((format!("counts that add up to {sum}"), format!("{points}, the points there are")))
    }

    /// How many values a curve has that are given at the ends of its spans.
    fn span_ends(self, points: u32) -> u32 {
        let spans = self.spans(points).unwrap_or_default();
        if self.wrap == Wrap::Periodic || points == 0 { spans } else { spans + 1 }
    }
}

/// Curves and how they are cut: their control points, and how many parts every span has. Spans of lines are one
/// part.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Polylines {
    pub(crate) shape: Shape,
    /// Control points of every curve.
    pub(crate) counts: Vec<u32>,
    /// One number a span of a cubic curve, curves one after another.
    parts: Vec<u16>,
    /// The error in lengths of a curve, where it had to be more than is usual.
    pub(crate) coarser: Option<f64>,
}

impl Polylines {
    /// Cuts curves; every count fits the shape and together they are the points.
    ///
    /// An error that is asked for is kept. The usual one is doubled until the polylines are not too many times
    /// longer than the control points.
    pub(crate) fn cut<P: Point>(shape: Shape, counts: Vec<u32>, points: &[P], error: Option<f32>) -> Self {
        let mut polylines = Polylines { shape, counts, parts: Vec::new(), coarser: None };
        if let Some(error) = error {
            polylines.cut_within(points, Tolerance::Absolute(error.into()));
            return polylines;
        }
        let most = (points.len() as u64).saturating_mul(MOST_GROWTH).max(FREE_POINTS);
        let errors = (0..=MOST_DOUBLINGS).map(|doublings| RELATIVE_ERROR * 2.0_f64.powi(doublings));
        for error in errors.chain([f64::INFINITY]) {
            polylines.cut_within(points, Tolerance::Relative(error));
            polylines.coarser = (error > RELATIVE_ERROR).then_some(error);
            if polylines.points() <= most {
                break;
            }
        }
        polylines
    }

    fn cut_within<P: Point>(&mut self, points: &[P], tolerance: Tolerance) {
        self.parts.clear();
        let Some(basis) = self.shape.basis else { return };
        for curve in each(points, &self.counts) {
            cubic::cut(curve, basis, self.shape, tolerance, &mut self.parts);
        }
    }

    /// Points of all strands.
    pub(crate) fn points(&self) -> u64 {
        let strands = self.counts.iter().filter(|&&count| count > 0).count() as u64;
        match self.shape.basis {
            Some(_) => self.parts.iter().map(|&part| u64::from(part)).sum::<u64>() + strands,
            None => self.strand_lens().map(u64::from).sum(),
        }
    }

    /// Points of every strand; curves without a point are no strands.
    pub(crate) fn strand_lens(&self) -> impl Iterator<Item = u32> + '_ {
        let mut parts = self.parts.iter();
        self.counts.iter().filter(|&&count| count > 0).map(move |&count| {
            let spans = self.shape.spans(count).unwrap_or_default();
            match self.shape.basis {
                Some(_) => parts
                    .by_ref()
                    .take(spans as usize)
                    .fold(1, |len: u32, &part| len.saturating_add(part.into())),
                None => spans + 1,
            }
        })
    }

    /// Whether the strands' points are the control points.
    pub(crate) fn are_plain(&self) -> bool {
        self.shape.basis.is_none() && self.shape.wrap != Wrap::Periodic
    }

    /// Values given one a control point, at the points of the strands.
    pub(crate) fn per_point<P: Point>(&self, values: Vec<P>) -> Vec<P> {
        let Some(basis) = self.shape.basis else { return self.closed(values) };
        let mut out = Vec::with_capacity(self.points() as usize);
        for (curve, parts) in each(&values, &self.counts).zip(self.parts()) {
            cubic::sample(curve, basis, self.shape.wrap, parts, &mut out);
        }
        out
    }

    /// Values given one an end of a span, at the points of the strands; `None` if there are not as many.
    pub(crate) fn per_span_end<P: Point>(&self, values: Vec<P>) -> Option<Vec<P>> {
        let counts: Vec<u32> = self.counts.iter().map(|&count| self.shape.span_ends(count)).collect();
        if counts.iter().map(|&count| u64::from(count)).sum::<u64>() != values.len() as u64 {
            return None;
        }
        if self.shape.basis.is_none() {
            return Some(self.closed(values));
        }
        let mut out = Vec::with_capacity(self.points() as usize);
        for (curve, parts) in each(&values, &counts).zip(self.parts()) {
            cubic::sample_varying(curve, self.shape.wrap, parts, &mut out);
        }
        Some(out)
    }

    /// Of periodic lines, every one with its first value again at its end.
    fn closed<P: Copy>(&self, values: Vec<P>) -> Vec<P> {
        if self.shape.wrap != Wrap::Periodic {
            return values;
        }
        let curves = each(&values, &self.counts);
        curves.flat_map(|curve| curve.iter().chain(curve.first()).copied()).collect()
    }

    /// The parts of the spans of every curve.
    fn parts(&self) -> impl Iterator<Item = &[u16]> {
        let mut rest = &self.parts[..];
        self.counts.iter().map(move |&count| {
            let spans = self.shape.spans(count).unwrap_or_default() as usize;
            let (parts, after) = rest.split_at_checked(spans).unwrap_or_default();
            rest = after;
            parts
        })
    }
}

/// The values of every curve.
fn each<'v, P>(values: &'v [P], counts: &'v [u32]) -> impl Iterator<Item = &'v [P]> {
    let mut rest = values;
    counts.iter().map(move |&count| {
        let (curve, after) = rest.split_at_checked(count as usize).unwrap_or_default();
        rest = after;
        curve
    })
}
