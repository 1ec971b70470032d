//! The strands' points in one array.
//!
//! A segment's number is the index of its first point, so its data is the 32 bytes from there on, its
//! neighbours along the strand lie beside it, and the tree's leaves need no table of indices.

use glam::{DVec3, Vec3, Vec4};

use crate::inside::Departure;
use crate::keys;
use crate::meshes::Meshes;
use crate::pose::{Pose, Still};
use crate::tracks::Tracks;
use crate::{Primitive, Radii, Strands, TracingError};

/// All strands of all objects.
#[derive(Clone, Debug, Default)]
pub(crate) struct Fibres {
    /// Position and radius. The radius of a strand's last point has its sign bit set: no segment starts
    /// there.
    points: Vec<Vec4>,
    /// First point of every strand, object after object, then the number of points.
    firsts: Vec<u32>,
    /// First strand of every object, then the number of strands.
    objects: Vec<u32>,
    /// Directions of segments without length, sorted by number.
    borrowed: Vec<(u32, DVec3)>,
    /// Positions of the points at further keys.
    tracks: Tracks<Vec3>,
}

impl Fibres {
    pub(crate) fn gather(strands: &[Strands]) -> Result<Self, TracingError> {
        let mut fibres = Self::default();
        for (object, strands) in strands.iter().enumerate() {
            keys::check_points(object, strands)?;
        }
        if strands.iter().all(|s| s.positions.is_empty()) {
            return Ok(fibres);
        }
        let total: usize = strands.iter().map(|s| s.positions.len()).sum();
        fibres.points.reserve_exact(total);
        fibres.firsts.reserve_exact(strands.iter().map(|s| s.offsets.len()).sum::<usize>() + 1);
        for (object, strands) in strands.iter().enumerate() {
            fibres.objects.push(fibres.firsts.len() as u32);
            fibres.append(object, strands)?;
        }
        fibres.objects.push(fibres.firsts.len() as u32);
        fibres.firsts.push(fibres.points.len() as u32);
        fibres.borrow_directions();
        Ok(fibres)
    }

    fn append(&mut self, object: usize, strands: &Strands) -> Result<(), TracingError> {
        check_offsets(object, strands)?;
        check_radii(object, strands)?;
        let base = self.points.len() as u32;
        for (point, &position) in strands.positions.iter().enumerate() {
            if !position.is_finite() {
                return Err(TracingError::Position { object, point, found: position });
            }
            let radius = match strands.radii {
                Radii::Constant(radius) => radius,
                Radii::PerVertex(radii) => radii[point],
            };
            self.points.push(position.extend(radius.abs()));
        }
        if keys::any_moves(strands.positions, strands.moved) {
            self.tracks.push(base, strands.moved.iter().map(|key| key.to_vec()).collect());
        }
        for pair in strands.offsets.windows(2) {
            self.firsts.push(base + pair[0]);
            if pair[1] > pair[0] {
                let last = &mut self.points[(base + pair[1] - 1) as usize];
                last.w = -last.w.abs();
            }
        }
        Ok(())
    }

    /// Gives every segment without length a direction.
    fn borrow_directions(&mut self) {
        let pose = Still { fibres: self, meshes: &Meshes::default() };
        let without = self.numbers().filter(|&n| pose.cone(n).is_some_and(|c| c.ab == DVec3::ZERO));
        self.borrowed = without.map(|number| (number, self.nearest_direction(number, &pose))).collect();
    }

    /// The direction of the nearest segment of a strand that has one.
    pub(crate) fn nearest_direction(&self, number: u32, pose: &impl Pose) -> DVec3 {
        (1..=self.points.len() as u32)
            .map_while(|step| {
                let back = number.checked_sub(step).filter(|&n| self.joined(n, number));
                let forth = number.checked_add(step).filter(|&n| self.joined(number, n));
                (back.is_some() || forth.is_some()).then_some([back, forth])
            })
            .flatten()
            .flatten()
            .filter_map(|n| pose.cone(n))
            .find(|c| c.ab != DVec3::ZERO)
            .map_or(DVec3::Y, |c| c.ab.normalize_or(DVec3::Y))
    }

    /// Whether two numbers are segments of one strand, from the table of strands.
    fn joined(&self, low: u32, high: u32) -> bool {
        self.ends(low).is_some() && self.ends(high).is_some() && self.strand_of(low) == self.strand_of(high)
    }

    fn strand_of(&self, number: u32) -> usize {
        self.firsts.partition_point(|&first| first <= number).saturating_sub(1)
    }

    pub(crate) fn bytes(&self) -> usize {
        self.points.capacity() * size_of::<Vec4>()
            + (self.firsts.capacity() + self.objects.capacity()) * size_of::<u32>()
            + self.borrowed.capacity() * size_of::<(u32, DVec3)>()
            + self.tracks.bytes()
    }

    /// Numbers of all segments, those without radius included.
    fn numbers(&self) -> impl Iterator<Item = u32> {
        (0..self.points.len() as u32).filter(|&n| self.ends(n).is_some())
    }

    /// Numbers of the segments that can be hit.
    pub(crate) fn solid(&self) -> impl Iterator<Item = u32> {
        self.numbers().filter(|&n| self.ends(n).is_some_and(|(a, b)| a.w != 0.0 || b.w != 0.0))
    }

    /// The points of a segment; none where no segment starts.
    #[inline]
    pub(crate) fn ends(&self, number: u32) -> Option<(Vec4, Vec4)> {
        match self.points.get(number as usize..number as usize + 2) {
            Some(&[a, b]) if a.w.is_sign_positive() => Some((a, b)),
            _ => None,
        }
    }

    pub(crate) fn tracks(&self) -> &Tracks<Vec3> {
        &self.tracks
    }

    pub(crate) fn primitive(&self, number: u32) -> Primitive {
        let strand = self.strand_of(number);
        let object = self.objects.partition_point(|&first| first as usize <= strand).saturating_sub(1);
        let segment = number - self.firsts.get(strand).copied().unwrap_or(number);
        let first = self.objects.get(object).copied().unwrap_or(0);
        Primitive::Segment { object: object as u32, strand: strand as u32 - first, segment }
    }

    /// What a segment without length was given.
    pub(crate) fn borrowed(&self, number: u32) -> DVec3 {
        match self.borrowed.binary_search_by_key(&number, |&(n, _)| n) {
            Ok(place) => self.borrowed[place].1,
            Err(_) => DVec3::Y,
        }
    }

    /// The segment a ray leaves; none if there is no such segment.
    pub(crate) fn departure(&self, object: u32, strand: u32, segment: u32) -> Option<Departure> {
        let object = object as usize;
        let strand = self.objects.get(object)?.checked_add(strand)?;
        if strand >= *self.objects.get(object + 1)? {
            return None;
        }
        let first = *self.firsts.get(strand as usize)?;
        let end = *self.firsts.get(strand as usize + 1)?;
        let segment = first.checked_add(segment)?;
        (segment < end).then(|| Departure::new(first..end, segment))
    }
}

fn check_offsets(object: usize, strands: &Strands) -> Result<(), TracingError> {
    let wrong = |index: usize, found: u32, expected: String| TracingError::Offsets {
        object,
        index,
        found: u64::from(found),
        expected,
    };
    let count = strands.positions.len();
    match (strands.offsets.first(), strands.offsets.last()) {
        (None, _) if count == 0 => return Ok(()),
        (Some(&first), _) if first != 0 => return Err(wrong(0, first, "0".into())),
        (Some(_), Some(&last)) if last as usize == count => {}
        (_, last) => {
            let index = strands.offsets.len().saturating_sub(1);
            let expected = format!("{count}, the number of points");
            return Err(wrong(index, last.copied().unwrap_or(0), expected));
        }
    }
    match strands.offsets.windows(2).position(|pair| pair[1] < pair[0]) {
        Some(before) => {
            let [low, found] = [strands.offsets[before], strands.offsets[before + 1]];
            Err(wrong(before + 1, found, format!("{low} or more")))
        }
        None => Ok(()),
    }
}

fn check_radii(object: usize, strands: &Strands) -> Result<(), TracingError> {
    let expected = strands.positions.len();
    let radii = match &strands.radii {
        Radii::Constant(radius) => std::slice::from_ref(radius),
        Radii::PerVertex(radii) if radii.len() == expected => *radii,
        Radii::PerVertex(radii) => {
            return Err(TracingError::RadiusCount { object, found: radii.len(), expected });
        }
    };
    match radii.iter().position(|r| !(0.0..=f32::MAX).contains(r)) {
        Some(point) => Err(TracingError::Radius { object, point, found: radii[point] }),
        None => Ok(()),
    }
}
