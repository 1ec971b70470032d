//! Arrays of a stage: values of the groom, and how they become one a curve or one a point.

use std::borrow::Cow;
use std::ops::Range;

use groom::{Domain, Values};

use crate::usd::write::curves::Curves;

/// Counts on one line of text.
const COUNTS_A_LINE: usize = 32;
/// Values a strand on one line of text.
const STRANDS_A_LINE: usize = 8;

/// An array: nothing is computed or copied before it is written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Array<'a> {
    pub curves: &'a Curves<'a>,
    pub rows: Rows<'a>,
    pub shape: Shape,
}

/// Values as the groom has them.
#[derive(Clone, Copy, Debug)]
pub(super) enum Rows<'a> {
    Floats(&'a [f32]),
    Float2s(&'a [[f32; 2]]),
    Float3s(&'a [[f32; 3]]),
    Ints(&'a [i32]),
}

impl Rows<'_> {
    pub fn len(&self) -> usize {
        match self {
            Rows::Floats(values) => values.len(),
            Rows::Float2s(values) => values.len(),
            Rows::Float3s(values) => values.len(),
            Rows::Ints(values) => values.len(),
        }
    }
}

impl<'a> From<&'a Values> for Rows<'a> {
    fn from(values: &'a Values) -> Self {
        match values {
            Values::Float(values) => Rows::Floats(values),
            Values::Vec2(values) => Rows::Float2s(bytemuck::cast_slice(values)),
            Values::Vec3(values) => Rows::Float3s(bytemuck::cast_slice(values)),
            Values::Int(values) => Rows::Ints(values),
        }
    }
}

/// How values become the array's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Shape {
    /// What one value belongs to in the groom.
    pub from: Domain,
    pub to: Spread,
    pub change: Change,
    pub ends: Ends,
}

/// What one value of an array belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Spread {
    /// Nothing of the curves: the values are the array.
    Fixed,
    Curve,
    Point,
}

/// What happens to each number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Change {
    Nothing,
    /// Radii become diameters.
    Double,
    /// Transparency becomes opacity.
    Complement,
}

/// The value of a phantom point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ends {
    /// That of its neighbour.
    Repeat,
    /// As far beyond its neighbour as the next one is before it: 2 P0 - P1.
    Extend,
}

impl Shape {
    /// Values that are the array as they are.
    pub const FIXED: Shape =
        Shape { from: Domain::Groom, to: Spread::Fixed, change: Change::Nothing, ends: Ends::Repeat };

    /// Values of the domain `from` for the same members of the curves.
    pub fn same(from: Domain) -> Self {
        let to = match from {
            Domain::Groom => Spread::Fixed,
            Domain::Strand => Spread::Curve,
            Domain::Vertex => Spread::Point,
        };
        Shape { from, to, ..Shape::FIXED }
    }

    /// Positions or velocities, one a point of the groom.
    pub fn points() -> Self {
        Shape { ends: Ends::Extend, ..Shape::same(Domain::Vertex) }
    }
}

/// One value of an array.
pub(super) trait Row: Copy + Sync {
    fn changed(self, change: Change) -> Self;

    /// The value of a phantom point next to `self`, whose other neighbour is `next`.
    fn beyond(self, next: Self) -> Self;
}

fn change(value: f32, change: Change) -> f32 {
    match change {
        Change::Nothing => value,
        Change::Double => 2.0 * value,
        Change::Complement => 1.0 - value,
    }
}

impl Row for f32 {
    fn changed(self, how: Change) -> Self {
        change(self, how)
    }

    fn beyond(self, next: Self) -> Self {
        2.0 * self - next
    }
}

impl Row for i32 {
    fn changed(self, _: Change) -> Self {
        self
    }

    fn beyond(self, _: Self) -> Self {
        self
    }
}

impl<const N: usize> Row for [f32; N] {
    fn changed(self, how: Change) -> Self {
        self.map(|value| change(value, how))
    }

    fn beyond(self, next: Self) -> Self {
        std::array::from_fn(|i| 2.0 * self[i] - next[i])
    }
}

/// What stands before a value in a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    First,
    /// First on a line of its own.
    Line,
    Next,
}

impl Array<'_> {
    /// The interpolation that says what one value belongs to.
    pub fn interpolation(&self) -> &'static str {
        match self.shape.to {
            Spread::Fixed => "constant",
            Spread::Curve => "uniform",
            Spread::Point => "vertex",
        }
    }

    /// How many values the array has.
    pub fn len(&self) -> usize {
        match self.shape.to {
            Spread::Fixed => self.rows.len(),
            Spread::Curve => self.curves.len(),
            Spread::Point => self.curves.points,
        }
    }

    /// Into how many parts [`Array::each`] can cut the array; the last may be empty.
    pub fn items(&self) -> usize {
        match self.shape.to {
            Spread::Point => self.curves.groom.point_count(),
            _ => self.len(),
        }
    }

    /// Hands on the values of some items, in order. `values` are `self.rows`.
    pub fn each<T: Row>(&self, values: &[T], items: Range<usize>, mut push: impl FnMut(Place, T)) {
        let Shape { from, to, change, ends } = self.shape;
        let value = |strand: usize, vertex: usize| {
            let value = match from {
                Domain::Groom => values[0],
                Domain::Strand => values[strand],
                Domain::Vertex => values[vertex],
            };
            value.changed(change)
        };
        match to {
            Spread::Fixed => {
                for item in items {
                    push(place(item, COUNTS_A_LINE), values[item].changed(change));
                }
            }
            Spread::Curve => {
                for curve in items {
                    push(place(curve, STRANDS_A_LINE), value(self.curves.strand(curve), 0));
                }
            }
            Spread::Point => {
                let beyond = |strand, vertex, next| match ends {
                    Ends::Repeat => value(strand, vertex),
                    Ends::Extend => value(strand, vertex).beyond(value(strand, next)),
                };
                let (first, phantoms) = (self.curves.strand(0), self.curves.phantoms);
                for (strand, all, some) in self.curves.strands_among(items) {
                    let start = if strand == first { Place::First } else { Place::Line };
                    if phantoms && some.start == all.start {
                        push(start, beyond(strand, all.start, all.start + 1));
                    }
                    for vertex in some.clone() {
                        let starts = vertex == all.start && !phantoms;
                        push(if starts { start } else { Place::Next }, value(strand, vertex));
                    }
                    if phantoms && some.end == all.end {
                        push(Place::Next, beyond(strand, all.end - 1, all.end - 2));
                    }
                }
            }
        }
    }

    /// The whole array in memory; borrowed when it is the groom's own.
    pub fn whole<'v, T: Row>(&self, values: &'v [T]) -> Cow<'v, [T]> {
        let Shape { from, to, change, .. } = self.shape;
        let as_it_is = match (to, from) {
            (Spread::Fixed, _) => true,
            (Spread::Curve, Domain::Strand) => self.curves.has_all_strands(),
            (Spread::Point, Domain::Vertex) => self.curves.has_same_points(),
            _ => false,
        };
        if as_it_is && change == Change::Nothing {
            return Cow::Borrowed(values);
        }
        let mut whole = Vec::with_capacity(self.len());
        self.each(values, 0..self.items(), |_, value| whole.push(value));
        Cow::Owned(whole)
    }
}

fn place(item: usize, a_line: usize) -> Place {
    match item {
        0 => Place::First,
        _ if item.is_multiple_of(a_line) => Place::Line,
        _ => Place::Next,
    }
}
