//! Numbers that change from root to tip.

use std::str::FromStr;

use crate::{Attribute, Domain, Groom, GroomError, Values, names};

/// What a ramp's text must be.
const TEXT: &str =
    "points `along:value`, as 0:1,0.5:0.8,1:0.2, along rising from 0 to 1 and values 0 or more";

/// A number that runs along a strand from point to point: straight between them, level before the first
/// and after the last.
///
/// ```
/// let ramp: groom::Ramp = "0:1,0.5:1,1:0.2".parse()?;
/// assert_eq!((ramp.at(0.25), ramp.at(0.75), ramp.at(2.0)), (1.0, 0.6, 0.2));
/// # Ok::<(), groom::GroomError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Ramp {
    points: Vec<(f32, f32)>,
}

impl Ramp {
    /// The ramp through `points`: how far along the strand (0 root, 1 tip) and the value there.
    ///
    /// # Errors
    /// [`GroomError::Argument`] unless there is a point, the first numbers lie in 0..=1 and rise, and the
    /// values are finite and not negative.
    pub fn new(points: Vec<(f32, f32)>) -> Result<Ramp, GroomError> {
        let rises = points.windows(2).all(|pair| pair[0].0 < pair[1].0);
        let in_range = points.iter().all(|(t, v)| (0.0..=1.0).contains(t) && (0.0..=f32::MAX).contains(v));
        if points.is_empty() || !rises || !in_range {
            let found = points.iter().map(|(t, v)| format!("{t}:{v}")).collect::<Vec<_>>().join(",");
            return Err(GroomError::argument("ramp", format!("`{found}`"), TEXT));
        }
        Ok(Ramp { points })
    }

    /// The value at `t`.
    #[must_use]
    pub fn at(&self, t: f32) -> f32 {
        let after = self.points.partition_point(|point| point.0 <= t);
        match (after.checked_sub(1).and_then(|i| self.points.get(i)), self.points.get(after)) {
            (Some(&(from, low)), Some(&(to, high))) => {
                let part = (t - from) / (to - from);
                low * (1.0 - part) + high * part
            }
            (Some(&(_, value)), None) | (None, Some(&(_, value))) => value,
            (None, None) => 0.0, // no ramp is empty
        }
    }
}

impl FromStr for Ramp {
    type Err = GroomError;

    fn from_str(text: &str) -> Result<Ramp, GroomError> {
        let point = |word: &str| {
            let (along, value) = word.split_once(':')?;
            Some((along.trim().parse().ok()?, value.trim().parse().ok()?))
        };
        match text.split(',').map(point).collect::<Option<Vec<_>>>() {
            Some(points) => Ramp::new(points),
            None => Err(GroomError::argument("ramp", format!("`{text}`"), TEXT)),
        }
    }
}

impl Groom {
    /// Multiplies the strands' widths by `ramp`, along each strand's length; the radius is then per vertex.
    /// After [`Groom::set_width`] of 1, the ramp is the width.
    ///
    /// # Errors
    /// None that a groom can cause: radii fit by construction.
    pub fn multiply_width(&mut self, ramp: &Ramp) -> Result<(), GroomError> {
        let mut radii = self.along_strands();
        let old = self.radii();
        for strand in 0..self.strand_count() {
            for vertex in self.strand_range(strand) {
                radii[vertex] = ramp.at(radii[vertex]) * old.get(strand, vertex);
            }
        }
        let values = Values::Float(radii);
        self.set_attribute(names::RADIUS, Attribute { domain: Domain::Vertex, values })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ramps_run_straight_between_their_points() {
        let ramp: Ramp = " 0.25:2 , 0.75:4".parse().unwrap();
        for (t, value) in [(0.0, 2.0), (0.25, 2.0), (0.5, 3.0), (0.75, 4.0), (1.0, 4.0)] {
            assert_eq!(ramp.at(t), value);
        }
    }

    #[test]
    fn what_is_no_ramp_is_refused() {
        for text in ["", "1", "0:1,", "0:1,0:2", "1:1,0:1", "0:-1", "2:1", "0:nan", "nan:0", "0:inf", "0:1:2"]
        {
            let told = text.parse::<Ramp>().unwrap_err().to_string();
            assert!(told.contains("0:1,0.5:0.8,1:0.2"), "{text}: {told}");
        }
    }
}
