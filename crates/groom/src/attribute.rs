//! Named values on a groom: constant, per strand or per vertex.

use glam::{Vec2, Vec3};

/// The names groomkit gives a meaning to; any other name is carried along as it is.
pub mod names {
    /// Radius of the strand (not the diameter), in the groom's units: float.
    pub const RADIUS: &str = "radius";
    /// Linear Rec. 709 colour, 0..1: vec3.
    pub const COLOR: &str = "color";
    /// Transparency, 0 opaque .. 1 clear: float.
    pub const TRANSPARENCY: &str = "transparency";
    /// A strand's identity, which survives subsampling and reordering: int per strand.
    pub const ID: &str = "id";
    /// Texture coordinate of the root on its mesh: vec2 per strand.
    pub const ROOT_UV: &str = "root_uv";
    /// Which group of strands (brows, lashes, scalp) a strand belongs to: int per strand.
    pub const GROUP: &str = "group";
    /// Whether a strand is a guide that others follow, 1 or 0: int per strand.
    pub const GUIDE: &str = "guide";
    /// The `id` of the guide a strand follows most closely: int per strand.
    pub const CLOSEST_GUIDE: &str = "closest_guide";
    /// How much melanin the hair has, 0 white .. 1 black: float.
    pub const MELANIN: &str = "melanin";
    /// How much of the melanin is red, 0 .. 1: float.
    pub const REDNESS: &str = "redness";
    /// Velocity of a point, in the groom's units per second: vec3 per vertex.
    pub const VELOCITY: &str = "velocity";
}

/// What one value of an attribute belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Domain {
    /// One value for the whole groom.
    Groom,
    /// One value a strand.
    Strand,
    /// One value a vertex.
    Vertex,
}

/// The values of an attribute, one flat array.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Scalars.
    Float(Vec<f32>),
    /// Pairs.
    Vec2(Vec<Vec2>),
    /// Triples: colours, directions.
    Vec3(Vec<Vec3>),
    /// Integers: ids, groups.
    Int(Vec<i32>),
}

impl Values {
    /// How many values there are.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Values::Float(v) => v.len(),
            Values::Vec2(v) => v.len(),
            Values::Vec3(v) => v.len(),
            Values::Int(v) => v.len(),
        }
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The type in words, for messages: `float`, `vec2`, `vec3`, `int`.
    #[must_use]
    pub fn type_name(&self) -> &'static str {
        match self {
            Values::Float(_) => "float",
            Values::Vec2(_) => "vec2",
            Values::Vec3(_) => "vec3",
            Values::Int(_) => "int",
        }
    }
}

/// One named array of a groom: values and what each belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Attribute {
    /// What one value belongs to.
    pub domain: Domain,
    /// The values, as many as the domain has members.
    pub values: Values,
}

impl Attribute {
    /// One scalar for the whole groom.
    #[must_use]
    pub fn constant_float(value: f32) -> Self {
        Attribute { domain: Domain::Groom, values: Values::Float(vec![value]) }
    }

    /// One triple for the whole groom.
    #[must_use]
    pub fn constant_vec3(value: Vec3) -> Self {
        Attribute { domain: Domain::Groom, values: Values::Vec3(vec![value]) }
    }
}

macro_rules! view {
    ($(#[$doc:meta])* $name:ident, $value:ty) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub enum $name<'a> {
            /// The same value everywhere.
            Constant($value),
            /// One value a strand.
            Strand(&'a [$value]),
            /// One value a vertex.
            Vertex(&'a [$value]),
        }

        impl $name<'_> {
            /// The value at global vertex index `vertex` of strand `strand`.
            ///
            /// # Panics
            /// When the indices do not belong to the groom the view was taken from.
            #[inline]
            #[must_use]
            pub fn get(&self, strand: usize, vertex: usize) -> $value {
                match self {
                    Self::Constant(value) => *value,
                    Self::Strand(values) => values[strand],
                    Self::Vertex(values) => values[vertex],
                }
            }
        }
    };
}

view!(
    /// A float attribute, looked up without caring for its domain.
    FloatView,
    f32
);
view!(
    /// A vec3 attribute, looked up without caring for its domain.
    Vec3View,
    Vec3
);

impl Attribute {
    /// This attribute as scalars; `None` when its values are of another type.
    #[must_use]
    pub fn float_view(&self) -> Option<FloatView<'_>> {
        let Values::Float(values) = &self.values else { return None };
        Some(match self.domain {
            Domain::Groom => FloatView::Constant(*values.first()?),
            Domain::Strand => FloatView::Strand(values),
            Domain::Vertex => FloatView::Vertex(values),
        })
    }

    /// This attribute as triples; `None` when its values are of another type.
    #[must_use]
    pub fn vec3_view(&self) -> Option<Vec3View<'_>> {
        let Values::Vec3(values) = &self.values else { return None };
        Some(match self.domain {
            Domain::Groom => Vec3View::Constant(*values.first()?),
            Domain::Strand => Vec3View::Strand(values),
            Domain::Vertex => Vec3View::Vertex(values),
        })
    }
}
