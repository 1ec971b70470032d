//! Where things are at further keys, and in between.

use glam::Vec3;

/// A value for each key of the shutter of whatever moves; the first key lies with what stands still.
#[derive(Clone, Debug)]
pub(crate) struct Tracks<T> {
    /// In order of `first`, which no two share.
    tracks: Vec<Track<T>>,
}

/// One object that moves.
#[derive(Clone, Debug)]
pub(crate) struct Track<T> {
    /// Number of the object's first point or triangle.
    first: u32,
    /// What it has at the second key, at the third...
    keys: Vec<Vec<T>>,
}

/// Between which two keys a time lies: key `before` and the one after, `share` of the way.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Between {
    pub(crate) before: usize,
    pub(crate) share: f64,
}

impl Between {
    /// Of `intervals` (at least 1) that fill the shutter; `time` is 0 to 1.
    #[inline]
    pub(crate) fn of(time: f64, intervals: usize) -> Self {
        let place = time * intervals as f64;
        let before = (place as usize).min(intervals.saturating_sub(1));
        Self { before, share: place - before as f64 }
    }

    /// Rounded once, so a point is where a key or a still scene of this time would have it. Exact at both
    /// ends and where they are the same.
    #[inline]
    pub(crate) fn mix(self, before: Vec3, after: Vec3) -> Vec3 {
        (before.as_dvec3() * (1.0 - self.share) + after.as_dvec3() * self.share).as_vec3()
    }
}

impl<T> Default for Tracks<T> {
    fn default() -> Self {
        Self { tracks: Vec::new() }
    }
}

impl<T: Copy> Tracks<T> {
    /// Adds the keys, all of one length, of an object whose first number is above all before.
    pub(crate) fn push(&mut self, first: u32, keys: Vec<Vec<T>>) {
        self.tracks.push(Track { first, keys });
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.tracks.is_empty()
    }

    /// The track of a point or triangle; none where it stands still.
    #[inline]
    pub(crate) fn of(&self, number: u32) -> Option<&Track<T>> {
        let after = self.tracks.partition_point(|track| track.first <= number);
        let track = self.tracks.get(after.checked_sub(1)?)?;
        let count = track.keys.first().map_or(0, Vec::len);
        ((number - track.first) < count as u32).then_some(track)
    }

    /// Of how many intervals every track is.
    pub(crate) fn intervals(&self) -> impl Iterator<Item = usize> + Clone {
        self.tracks.iter().map(Track::intervals)
    }

    pub(crate) fn bytes(&self) -> usize {
        let keys = self.tracks.iter().flat_map(|track| &track.keys);
        self.tracks.capacity() * size_of::<Track<T>>()
            + keys.map(|key| size_of::<Vec<T>>() + key.capacity() * size_of::<T>()).sum::<usize>()
    }
}

impl<T: Copy> Track<T> {
    #[inline]
    pub(crate) fn intervals(&self) -> usize {
        self.keys.len()
    }

    /// The value of a number of this track at a key; `first` is the one at key 0.
    #[inline]
    pub(crate) fn at(&self, number: u32, key: usize, first: T) -> T {
        match key.checked_sub(1).and_then(|key| self.keys.get(key)) {
            Some(values) => values.get((number - self.first) as usize).copied().unwrap_or(first),
            None => first,
        }
    }

    /// The values of a number and of the next, `key` counting from the second one.
    #[inline]
    pub(crate) fn pair(&self, number: u32, key: usize) -> Option<[T; 2]> {
        let place = (number - self.first) as usize;
        match self.keys.get(key)?.get(place..place + 2) {
            Some(&[here, next]) => Some([here, next]),
            _ => None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_fall_between_keys() {
        let at = |time, intervals| {
            let Between { before, share } = Between::of(time, intervals);
            (before, share)
        };
        assert_eq!([at(0.0, 1), at(0.25, 1), at(1.0, 1)], [(0, 0.0), (0, 0.25), (0, 1.0)]);
        assert_eq!(
            [at(0.0, 4), at(0.375, 4), at(0.5, 4), at(1.0, 4)],
            [(0, 0.0), (1, 0.5), (2, 0.0), (3, 1.0)]
        );
    }

    #[test]
    fn ends_are_exact_and_equal_ends_stay() {
        let (a, b) = (Vec3::new(1e-30, 1e30, -3.3), Vec3::new(1e30, 1e-30, 7.7));
        assert_eq!(Between { before: 0, share: 0.0 }.mix(a, b), a);
        assert_eq!(Between { before: 0, share: 1.0 }.mix(a, b), b);
        for step in 0..100 {
            assert_eq!(Between { before: 0, share: f64::from(step) / 99.0 }.mix(a, a), a);
        }
    }

    #[test]
    fn numbers_find_their_track() {
        let mut tracks = Tracks::default();
        tracks.push(3, vec![vec![10, 11], vec![20, 21]]);
        tracks.push(7, vec![vec![30]]);
        let found = |number, key| tracks.of(number).map(|track| track.at(number, key, -1));
        assert_eq!([found(2, 0), found(5, 1), found(6, 1), found(8, 1)], [None; 4]);
        assert_eq!(
            [found(3, 0), found(3, 1), found(4, 2), found(7, 1)].map(Option::unwrap_or_default),
            [-1, 10, 21, 30]
        );
    }
}
