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
