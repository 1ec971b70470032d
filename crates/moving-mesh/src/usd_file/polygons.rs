//! Polygons as triangles.

use crate::error::Fault;

/// Triangles of corners, whose numbers are places in `faceVertexIndices`, and the face of each.
#[derive(Debug, Default, PartialEq)]
pub(super) struct Fans {
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) faces: Vec<u32>,
    /// The face of each corner.
    pub(super) corner_faces: Vec<u32>,
}

impl Fans {
    /// Cuts each face into a fan from its first corner; `clockwise` faces are turned round, holes left out.
    pub(super) fn cut(counts: &[i32], corners: usize, holes: &[i32], clockwise: bool) -> Result<Fans, Fault> {
        if u32::try_from(corners).is_err() {
            return Err(Fault::invalid(
                "faceVertexIndices",
                format!("{corners} indices, expected below 2^32"),
            ));
        }
        let holes: std::collections::BTreeSet<i32> = holes.iter().copied().collect();
        let mut fans = Fans::default();
        let mut start = 0_u32;
        for (face, &count) in (0..).zip(counts) {
            let end = u32::try_from(count).ok().and_then(|count| start.checked_add(count));
            let end = end.filter(|&end| end as usize <= corners).ok_or_else(|| {
                let fault =
                    format!("face {face} has {count} corners from {start}, but there are {corners} indices");
                Fault::invalid("faceVertexCounts", fault)
            })?;
            fans.corner_faces.resize(end as usize, face);
            if !i32::try_from(face).is_ok_and(|face| holes.contains(&face)) {
                for corner in start.saturating_add(2)..end {
                    let [a, b] = if clockwise { [corner, corner - 1] } else { [corner - 1, corner] };
                    fans.triangles.push([start, a, b]);
                    fans.faces.push(face);
                }
            }
            start = end;
        }
        if start as usize != corners {
            let fault = format!("{start} corners in all, expected the {corners} of faceVertexIndices");
            return Err(Fault::invalid("faceVertexCounts", fault));
        }
        Ok(fans)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_become_fans() {
        let fans = Fans::cut(&[3, 5, 4], 12, &[2], false).unwrap();
        assert_eq!(fans.triangles, [[0, 1, 2], [3, 4, 5], [3, 5, 6], [3, 6, 7]]);
        assert_eq!(fans.faces, [0, 1, 1, 1]);
        assert_eq!(fans.corner_faces, [0, 0, 0, 1, 1, 1, 1, 1, 2, 2, 2, 2]);
        assert_eq!(Fans::cut(&[4], 4, &[], true).unwrap().triangles, [[0, 2, 1], [0, 3, 2]]);
        assert!(Fans::cut(&[2, 0, 1], 3, &[], false).unwrap().triangles.is_empty());
    }

    #[test]
    fn counts_that_do_not_fit_are_told() {
        for counts in [&[3, 3][..], &[3], &[4, -1], &[i32::MIN, 4], &[i32::MAX, i32::MAX, i32::MAX]] {
            assert!(Fans::cut(counts, 4, &[], false).is_err(), "{counts:?}");
        }
    }
}
