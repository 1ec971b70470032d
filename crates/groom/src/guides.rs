//! Strands that stand for those around them.

use crate::farthest::{DIMENSIONS, Place, farthest};
use crate::{Attribute, Domain, Groom, GroomError, Values, names, random};

/// How much a difference in shape counts beside one of the same length between the roots.
const SHAPE: f32 = 0.5;

/// Guide strands that were picked.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Guides {
    /// Indices of the guides, in the order they were picked: any first part of them is spread as well.
    pub strands: Vec<u32>,
    /// For every strand the index of the guide (a strand) closest to it; a guide's is its own.
    pub closest: Vec<u32>,
}

impl Groom {
    /// Picks `count` guides (all strands, when there are fewer), each as far as can be from those before
    /// it: by farthest-point sampling, exact and in about n log n steps.
    ///
    /// The distance of two strands is that of their roots, and half that of their middle points and of
    /// their tips as seen from the roots, as legs of one triangle. The first guide is the strand whose
    /// random number by `seed` and id is the least. Coordinates that are not finite count as 0.
    ///
    /// # Errors
    /// [`GroomError::Argument`] when `count` is 0.
    pub fn pick_guides(&self, count: usize, seed: u64) -> Result<Guides, GroomError> {
        if count == 0 {
            return Err(GroomError::argument("number of guides", count, "1 or more"));
        }
        let places: Vec<Place> = (0..self.strand_count()).map(|strand| self.place(strand)).collect();
        let number = |strand: usize| random(seed, self.strand_id(strand), "first guide");
        let first = (0..self.strand_count()).min_by(|&a, &b| number(a).total_cmp(&number(b))).unwrap_or(0);
        let choice = farthest(&places, count, first);
        let closest = choice.closest.iter().filter_map(|&rank| choice.chosen.get(rank as usize).copied());
        Ok(Guides { closest: closest.collect(), strands: choice.chosen })
    }

    /// Sets the attribute `guide` of the strands, 1 or 0.
    ///
    /// # Errors
    /// [`GroomError::Argument`] when the guides are those of another groom.
    pub fn mark_guides(&mut self, guides: &Guides) -> Result<(), GroomError> {
        let mut marks = vec![0; self.strand_count()];
        for &guide in &guides.strands {
            let Some(mark) = marks.get_mut(guide as usize) else {
                return Err(GroomError::argument("guide", guide, "a strand of the groom"));
            };
            *mark = 1;
        }
        self.set_attribute(names::GUIDE, Attribute { domain: Domain::Strand, values: Values::Int(marks) })
    }

    /// Sets the attribute `closest_guide` of the strands: the id of the closest guide.
    ///
    /// # Errors
    /// [`GroomError::Argument`] or [`GroomError::AttributeLength`] when the guides are those of another
    /// groom.
    pub fn mark_closest_guides(&mut self, guides: &Guides) -> Result<(), GroomError> {
        let mut ids = Vec::with_capacity(guides.closest.len());
        for &guide in &guides.closest {
            if guide as usize >= self.strand_count() {
                return Err(GroomError::argument("guide", guide, "a strand of the groom"));
            }
            ids.push(self.strand_id(guide as usize) as i32);
        }
        let attribute = Attribute { domain: Domain::Strand, values: Values::Int(ids) };
        self.set_attribute(names::CLOSEST_GUIDE, attribute)
    }

    /// Only the strands whose attribute `guide` is not 0, each keeping its identity in the `id` attribute.
    ///
    /// # Errors
    /// [`GroomError::AttributeMissing`] without a `guide` per strand.
    pub fn keep_guides(&self) -> Result<Groom, GroomError> {
        let Some(Attribute { domain: Domain::Strand, values: Values::Int(marks) }) =
            self.attribute(names::GUIDE)
        else {
            let (name, found, expected) = (names::GUIDE, "not there", "one int a strand, 1 for a guide");
            return Err(GroomError::AttributeMissing { name, found, expected });
        };
        Ok(self.select((0..marks.len() as u32).filter(|&strand| marks[strand as usize] != 0).collect()))
    }

    /// Where a strand is among strands.
    fn place(&self, strand: usize) -> Place {
        let points = self.strand(strand);
        let (root, middle, tip) = (points[0], points[points.len() / 2], points[points.len() - 1]);
        let shape = [(middle - root) * SHAPE, (tip - root) * SHAPE];
        let mut place = [0.0; DIMENSIONS];
        for (number, value) in
            place.iter_mut().zip([root, shape[0], shape[1]].iter().flat_map(|v| v.to_array()))
        {
            *number = if value.is_finite() { value } else { 0.0 };
        }
        place
    }
}
