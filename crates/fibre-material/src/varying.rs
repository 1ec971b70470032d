//! Values that may differ from strand to strand or from point to point.

use groom::Domain;

/// A value of a groom: one for all, or one a strand, or one a vertex.
#[derive(Clone, Debug, PartialEq)]
pub enum Varying<T> {
    /// One for all.
    Constant(T),
    /// One for each strand.
    Strand(Vec<T>),
    /// One for each vertex, strand after strand.
    Vertex(Vec<T>),
}

impl<T: Copy> Varying<T> {
    /// From an attribute's values; `None` where a groom's value is missing.
    #[must_use]
    pub fn new(domain: Domain, values: Vec<T>) -> Option<Varying<T>> {
        Some(match domain {
            Domain::Groom => Varying::Constant(*values.first()?),
            Domain::Strand => Varying::Strand(values),
            Domain::Vertex => Varying::Vertex(values),
        })
    }
}

impl<T: Copy + PartialEq> Varying<T> {
    /// The same values held as seldom as they differ; `offsets` are the groom's.
    pub(crate) fn collapsed(self, offsets: &[u32]) -> Varying<T> {
        let values = match &self {
            Varying::Constant(_) => return self,
            Varying::Strand(values) | Varying::Vertex(values) => values,
        };
        if let Some((&first, rest)) = values.split_first()
            && rest.iter().all(|value| *value == first)
        {
            return Varying::Constant(first);
        }
        let Varying::Vertex(values) = &self else { return self };
        let strands = offsets.windows(2).map(|pair| values.get(pair[0] as usize..pair[1] as usize));
        let one = |strand: Option<&[T]>| {
            let (&first, rest) = strand?.split_first()?;
            rest.iter().all(|value| *value == first).then_some(first)
        };
        match strands.map(one).collect() {
            Some(strands) => Varying::Strand(strands),
            None => self,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_does_not_differ_is_held_once() {
        let offsets = [0, 2, 5];
        let collapsed = |values: [i32; 5]| Varying::Vertex(values.to_vec()).collapsed(&offsets);
        assert_eq!(collapsed([3; 5]), Varying::Constant(3));
        assert_eq!(collapsed([1, 1, 2, 2, 2]), Varying::Strand(vec![1, 2]));
        assert_eq!(collapsed([1, 1, 2, 2, 1]), Varying::Vertex(vec![1, 1, 2, 2, 1]));
        assert_eq!(Varying::Strand(vec![4, 4]).collapsed(&offsets), Varying::Constant(4));
        assert_eq!(Varying::<i32>::Strand(vec![]).collapsed(&[0]), Varying::Strand(vec![]));
    }
}
