//! Strands that lie one after the other and are all written.

use std::ops::Range;

use crate::drawable::Drawable;

/// A run of drawable strands without a gap; its points have no gap either.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Run {
    pub(super) strands: Range<usize>,
    pub(super) vertices: Range<usize>,
}

/// The runs of a groom in order: one, unless strands of one point are left out between.
pub(super) fn runs(drawable: Drawable<'_>) -> impl Iterator<Item = Run> {
    let groom = drawable.groom;
    let count = groom.strand_count();
    let is_drawn = move |strand: usize| groom.strand_range(strand).len() >= 2;
    let mut next = 0;
    std::iter::from_fn(move || {
        let start = (next..count).find(|&strand| is_drawn(strand))?;
        let end = (start..count).find(|&strand| !is_drawn(strand)).unwrap_or(count);
        next = end;
        let vertices = groom.strand_range(start).start..groom.strand_range(end - 1).end;
        Some(Run { strands: start..end, vertices })
    })
}

#[cfg(test)]
mod tests {
    use glam::Vec3;
    use groom::Groom;

    use super::*;
    use crate::Format;

    #[test]
    fn strands_of_one_point_part_the_runs() {
        let groom = Groom::new(vec![0, 1, 3, 5, 6, 7, 9], vec![Vec3::ZERO; 9]).unwrap();
        let drawable = Drawable::new(&groom, Format::Glb, "", &mut Vec::new()).unwrap();
        let run = |strands, vertices| Run { strands, vertices };
        assert_eq!(runs(drawable).collect::<Vec<_>>(), [run(1..3, 1..5), run(5..6, 7..9)]);
    }
}
