//! Figures about a groom.

use glam::{DVec3, Vec3};

use crate::Groom;

/// Figures about a groom, in its own units; sums are taken in double precision.
///
/// Points that are not finite count as such and take part in nothing else.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Strands.
    pub strands: usize,
    /// Points.
    pub points: usize,
    /// Segments.
    pub segments: usize,
    /// Fewest and most points of a strand; `None` without strands.
    pub strand_points: Option<(usize, usize)>,
    /// Lengths of the strands.
    pub strand_length: Option<Range>,
    /// Lengths of the segments.
    pub segment_length: Option<Range>,
    /// Smallest and largest coordinates of the points.
    pub bounds: Option<(Vec3, Vec3)>,
    /// Radii at the points.
    pub radius: Option<Range>,
    /// Segments whose ends coincide.
    pub zero_length_segments: usize,
    /// Strands with a single point.
    pub one_point_strands: usize,
    /// Places where a strand turns by more than 90 degrees from one segment to the next. Segments
    /// without length are looked past.
    pub sharp_bends: usize,
    /// Points with a coordinate that is not finite.
    pub non_finite_points: usize,
}

/// Smallest, mean and largest of some numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// The smallest.
    pub min: f64,
    /// The mean.
    pub mean: f64,
    /// The largest.
    pub max: f64,
}

/// Numbers going into a [`Range`].
#[derive(Clone, Copy)]
struct Gather {
    count: u64,
    sum: f64,
    min: f64,
    max: f64,
}

impl Gather {
    const EMPTY: Gather = Gather { count: 0, sum: 0.0, min: f64::INFINITY, max: f64::NEG_INFINITY };

    fn add(&mut self, value: f64) {
        if value.is_finite() {
            self.count += 1;
            self.sum += value;
            self.min = self.min.min(value);
            self.max = self.max.max(value);
        }
    }

    fn range(self) -> Option<Range> {
        (self.count > 0).then(|| Range { min: self.min, mean: self.sum / self.count as f64, max: self.max })
    }
}

impl Statistics {
    /// Looks through `groom` once.
    #[must_use]
    pub fn of(groom: &Groom) -> Self {
        let mut figures = Statistics {
            strands: groom.strand_count(),
            points: groom.point_count(),
            segments: groom.segment_count(),
            ..Statistics::default()
        };
        let (mut lengths, mut segments, mut radii) = (Gather::EMPTY, Gather::EMPTY, Gather::EMPTY);
        let view = groom.radii();
        for (index, strand) in groom.strands().enumerate() {
            let (fewest, most) = figures.strand_points.unwrap_or((strand.len(), strand.len()));
            figures.strand_points = Some((fewest.min(strand.len()), most.max(strand.len())));
            figures.one_point_strands += usize::from(strand.len() == 1);
            lengths.add(figures.walk(strand, &mut segments));
            for vertex in groom.strand_range(index) {
                radii.add(view.get(index, vertex).into());
            }
        }
        figures.bounds = bounds(groom.positions());
        figures.non_finite_points = groom.positions().iter().filter(|p| !p.is_finite()).count();
        figures.strand_length = lengths.range();
        figures.segment_length = segments.range();
        figures.radius = radii.range();
        figures
    }

    /// Goes along one strand and gives its length.
    fn walk(&mut self, strand: &[Vec3], segments: &mut Gather) -> f64 {
        let (mut length, mut before) = (0.0, DVec3::ZERO);
        for pair in strand.windows(2) {
            let step = pair[1].as_dvec3() - pair[0].as_dvec3();
            let step_length = step.length();
            segments.add(step_length);
            length += step_length;
            if step_length == 0.0 {
                self.zero_length_segments += 1;
                continue;
            }
            self.sharp_bends += usize::from(before.dot(step) < 0.0);
            before = step;
        }
        length
    }
}

fn bounds(points: &[Vec3]) -> Option<(Vec3, Vec3)> {
    let finite = points.iter().copied().filter(|p| p.is_finite());
    finite.fold(None, |bounds, p| match bounds {
        None => Some((p, p)),
        Some((low, high)) => Some((low.min(p), high.max(p))),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_of_a_known_groom() {
        let points =
            [[0., 0., 0.], [3., 4., 0.], [3., 4., 0.], [0., 0., 0.], [9., 9., 9.], [f32::NAN, 0., 0.]];
        let groom = Groom::new(vec![0, 4, 6], points.map(Vec3::from).to_vec()).unwrap();
        let figures = Statistics::of(&groom);
        assert_eq!(figures.strand_points, Some((2, 4)));
        assert_eq!(figures.strand_length, Some(Range { min: 10.0, mean: 10.0, max: 10.0 }));
        assert_eq!(figures.segment_length.unwrap().min, 0.0);
        assert_eq!((figures.zero_length_segments, figures.sharp_bends), (1, 1));
        assert_eq!((figures.non_finite_points, figures.one_point_strands), (1, 0));
        assert_eq!(figures.bounds, Some((Vec3::ZERO, Vec3::splat(9.0))));
        assert_eq!(figures.radius.unwrap().mean, 0.5);
    }

    #[test]
    fn nothing_has_no_figures() {
        let figures = Statistics::of(&Groom::new(vec![0], vec![]).unwrap());
        assert_eq!(figures, Statistics::default());
    }
}
