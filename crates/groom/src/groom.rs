//! The groom itself.

use std::collections::BTreeMap;
use std::ops::Range;

use glam::Vec3;

use crate::{Attribute, Domain, FloatView, GroomError, UpAxis, Values, Vec3View, names};

/// Radius of a strand when no attribute says otherwise, in the groom's units.
pub const DEFAULT_RADIUS: f32 = 0.5;

/// A set of strands with attributes, a unit and an up axis.
///
/// Invariants, kept by every method: at least one point a strand; offsets start at 0, rise
/// strictly and end at the point count; every attribute has as many values as its domain has
/// members; the standard names in [`names`] hold their standard types.
#[derive(Clone, Debug, PartialEq)]
pub struct Groom {
    offsets: Vec<u32>,
    positions: Vec<Vec3>,
    attributes: BTreeMap<String, Attribute>,
    /// Which way is up in `positions`.
    pub up_axis: UpAxis,
    /// Metres in one unit of `positions` and radii; 1 when nobody said.
    pub meters_per_unit: f64,
}

impl Groom {
    /// A groom from offsets and positions: strand `i` owns `positions[offsets[i]..offsets[i + 1]]`.
    ///
    /// # Errors
    /// [`GroomError::Offsets`] unless `0 = offsets[0] < ... < offsets[n] = positions.len()`.
    pub fn new(offsets: Vec<u32>, positions: Vec<Vec3>) -> Result<Self, GroomError> {
        let fault = |index, found: u64, expected: String| Err(GroomError::Offsets { index, found, expected });
        match offsets.first() {
            Some(0) => {}
            Some(&first) => return fault(0, first.into(), "0".into()),
            None => return fault(0, 0, "at least one entry, the leading 0".into()),
        }
        for (i, pair) in offsets.windows(2).enumerate() {
            if pair[1] <= pair[0] {
                return fault(i + 1, pair[1].into(), format!("more than {}", pair[0]));
            }
        }
        let last = offsets[offsets.len() - 1];
        if last as usize != positions.len() {
            return fault(offsets.len() - 1, last.into(), format!("the point count {}", positions.len()));
        }
        Ok(Groom {
            offsets,
            positions,
            attributes: BTreeMap::new(),
            up_axis: UpAxis::Y,
            meters_per_unit: 1.0,
        })
    }

    /// A groom like this one with other strands; the caller keeps the type's invariants.
    pub(crate) fn with_strands(
        &self,
        offsets: Vec<u32>,
        positions: Vec<Vec3>,
        attributes: BTreeMap<String, Attribute>,
    ) -> Self {
        let (up_axis, meters_per_unit) = (self.up_axis, self.meters_per_unit);
        Groom { offsets, positions, attributes, up_axis, meters_per_unit }
    }

    /// How many strands there are.
    #[must_use]
    pub fn strand_count(&self) -> usize {
        self.offsets.len() - 1
    }

    /// How many points all strands have together.
    #[must_use]
    pub fn point_count(&self) -> usize {
        self.positions.len()
    }

    /// How many segments all strands have together.
    #[must_use]
    pub fn segment_count(&self) -> usize {
        self.point_count() - self.strand_count()
    }

    /// Where each strand starts in the flat arrays, and the point count at the end.
    #[must_use]
    pub fn offsets(&self) -> &[u32] {
        &self.offsets
    }

    /// All points, strand after strand, root to tip.
    #[must_use]
    pub fn positions(&self) -> &[Vec3] {
        &self.positions
    }

    /// All points, to be moved in place.
    pub fn positions_mut(&mut self) -> &mut [Vec3] {
        &mut self.positions
    }

    /// The indices of strand `strand` in the flat arrays.
    ///
    /// # Panics
    /// When there is no such strand.
    #[must_use]
    pub fn strand_range(&self, strand: usize) -> Range<usize> {
        self.offsets[strand] as usize..self.offsets[strand + 1] as usize
    }

    /// The points of strand `strand`, root to tip.
    ///
    /// # Panics
    /// When there is no such strand.
    #[must_use]
    pub fn strand(&self, strand: usize) -> &[Vec3] {
        &self.positions[self.strand_range(strand)]
    }

    /// The strands in order, each as its points.
    pub fn strands(&self) -> impl ExactSizeIterator<Item = &[Vec3]> + '_ {
        (0..self.strand_count()).map(|i| self.strand(i))
    }

    /// How many values an attribute of `domain` has.
    #[must_use]
    pub fn domain_len(&self, domain: Domain) -> usize {
        match domain {
            Domain::Groom => 1,
            Domain::Strand => self.strand_count(),
            Domain::Vertex => self.point_count(),
        }
    }

    /// All attributes by name, in the order of their names.
    pub fn attributes(&self) -> impl Iterator<Item = (&str, &Attribute)> + '_ {
        self.attributes.iter().map(|(name, attribute)| (name.as_str(), attribute))
    }

    /// The attribute called `name`, if there is one.
    #[must_use]
    pub fn attribute(&self, name: &str) -> Option<&Attribute> {
        self.attributes.get(name)
    }

    /// Adds or replaces an attribute.
    ///
    /// # Errors
    /// [`GroomError::AttributeLength`] or [`GroomError::AttributeType`]; the groom is then unchanged.
    pub fn set_attribute(&mut self, name: impl Into<String>, attribute: Attribute) -> Result<(), GroomError> {
        let name = name.into();
        let expected = self.domain_len(attribute.domain);
        if attribute.values.len() != expected {
            let (domain, found) = (attribute.domain, attribute.values.len());
            return Err(GroomError::AttributeLength { name, domain, found, expected });
        }
        let standard_type = match name.as_str() {
            names::RADIUS | names::TRANSPARENCY | names::MELANIN | names::REDNESS => Some("float"),
            names::COLOR | names::VELOCITY => Some("vec3"),
            names::ROOT_UV => Some("vec2"),
            names::ID | names::GROUP | names::GUIDE | names::CLOSEST_GUIDE => Some("int"),
            _ => None,
        };
        let found = attribute.values.type_name();
        if let Some(expected) = standard_type.filter(|&expected| expected != found) {
            return Err(GroomError::AttributeType { name, found, expected });
        }
        self.attributes.insert(name, attribute);
        Ok(())
    }

    /// Takes the attribute called `name` out of the groom.
    pub fn remove_attribute(&mut self, name: &str) -> Option<Attribute> {
        self.attributes.remove(name)
    }

    /// The values of the attributes, to be changed in place; the caller keeps their types and numbers.
    pub(crate) fn attributes_mut(&mut self) -> impl Iterator<Item = &mut Attribute> + '_ {
        self.attributes.values_mut()
    }

    /// The values of one attribute, to be changed in place; the caller keeps their type and number.
    pub(crate) fn values_mut(&mut self, name: &str) -> Option<&mut Values> {
        self.attributes.get_mut(name).map(|attribute| &mut attribute.values)
    }

    /// Radii of the strands; [`DEFAULT_RADIUS`] where nothing is set.
    #[must_use]
    pub fn radii(&self) -> FloatView<'_> {
        self.attribute(names::RADIUS)
            .and_then(Attribute::float_view)
            .unwrap_or(FloatView::Constant(DEFAULT_RADIUS))
    }

    /// Colours of the strands, if any are set.
    #[must_use]
    pub fn colors(&self) -> Option<Vec3View<'_>> {
        self.attribute(names::COLOR).and_then(Attribute::vec3_view)
    }

    /// The identity of strand `strand`: its `id` attribute, or its index.
    ///
    /// # Panics
    /// When there is no such strand.
    #[must_use]
    pub fn strand_id(&self, strand: usize) -> u32 {
        match self.attribute(names::ID) {
            Some(Attribute { domain: Domain::Strand, values: Values::Int(ids) }) => ids[strand] as u32,
            _ => strand as u32,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two_strands() -> Groom {
        Groom::new(vec![0, 2, 5], (0..5).map(|i| Vec3::splat(i as f32)).collect()).unwrap()
    }

    #[test]
    fn offsets_that_lie_are_refused() {
        let points = vec![Vec3::ZERO; 3];
        for offsets in [vec![], vec![1, 3], vec![0, 2], vec![0, 4], vec![0, 2, 2, 3], vec![0, 2, 1, 3]] {
            assert!(matches!(Groom::new(offsets, points.clone()), Err(GroomError::Offsets { .. })));
        }
        assert!(Groom::new(vec![0], vec![]).is_ok());
    }

    #[test]
    fn attributes_fit_their_domain_and_type() {
        let mut groom = two_strands();
        for (domain, len) in [(Domain::Groom, 1), (Domain::Strand, 2), (Domain::Vertex, 5)] {
            let attribute = |n| Attribute { domain, values: Values::Float(vec![0.25; n]) };
            groom.set_attribute(names::RADIUS, attribute(len)).unwrap();
            assert_eq!(groom.radii().get(1, 4), 0.25);
            assert!(matches!(
                groom.set_attribute("x", attribute(len + 1)),
                Err(GroomError::AttributeLength { .. })
            ));
            assert!(matches!(
                groom.set_attribute(names::COLOR, attribute(len)),
                Err(GroomError::AttributeType { .. })
            ));
        }
        assert!(groom.attribute("x").is_none() && groom.colors().is_none());
    }

    #[test]
    fn strands_partition_the_points() {
        let groom = two_strands();
        assert_eq!(groom.strands().map(<[Vec3]>::len).collect::<Vec<_>>(), [2, 3]);
        assert_eq!(groom.segment_count(), 3);
        assert_eq!(groom.strand_id(1), 1);
    }
}
