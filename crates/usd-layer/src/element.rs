//! What one element of a value is made of.

/// What a component of an element is stored as.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Scalar {
    /// `bool`, a byte in a crate.
    Bool,
    /// `uchar`.
    UChar,
    /// `int`, 32 bits.
    Int,
    /// `uint`, 32 bits.
    UInt,
    /// `int64`.
    Int64,
    /// `uint64`.
    UInt64,
    /// `half`, 16 bits.
    Half,
    /// `float`, 32 bits.
    Float,
    /// `double` and `timecode`, 64 bits.
    Double,
    /// `string`.
    String,
    /// `token`.
    Token,
    /// `asset`.
    Asset,
}

impl Scalar {
    /// Bytes of one component in a crate; strings, tokens and asset paths are indices.
    #[must_use]
    pub fn size(self) -> usize {
        match self {
            Scalar::Bool | Scalar::UChar => 1,
            Scalar::Half => 2,
            Scalar::Int | Scalar::UInt | Scalar::Float => 4,
            Scalar::String | Scalar::Token | Scalar::Asset => 4,
            Scalar::Int64 | Scalar::UInt64 | Scalar::Double => 8,
        }
    }

    /// Whether it is text of some kind.
    #[must_use]
    pub fn is_text(self) -> bool {
        matches!(self, Scalar::String | Scalar::Token | Scalar::Asset)
    }

    /// Whether it is a whole number.
    #[must_use]
    pub fn is_integer(self) -> bool {
        !self.is_text() && !matches!(self, Scalar::Half | Scalar::Float | Scalar::Double)
    }
}

/// How the components of an element belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Shape {
    /// One component.
    Single,
    /// 2, 3 or 4 components.
    Vector,
    /// Real part first, then i, j, k.
    Quaternion,
    /// Rows, one after another.
    Matrix,
}

/// The type of a value, or of every element of an array; USD's roles (`point3f`, `color3f`) are not kept
/// apart here, the attribute's type name has them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Element {
    /// What a component is stored as.
    pub scalar: Scalar,
    /// How components belong together.
    pub shape: Shape,
    /// How many components there are: 1, 2, 3, 4, 9 or 16.
    pub components: u8,
}

impl Element {
    pub(crate) const fn single(scalar: Scalar) -> Self {
        Element { scalar, shape: Shape::Single, components: 1 }
    }

    pub(crate) const fn vector(scalar: Scalar, components: u8) -> Self {
        Element { scalar, shape: Shape::Vector, components }
    }

    pub(crate) const fn quaternion(scalar: Scalar) -> Self {
        Element { scalar, shape: Shape::Quaternion, components: 4 }
    }

    pub(crate) const fn matrix(side: u8) -> Self {
        Element { scalar: Scalar::Double, shape: Shape::Matrix, components: side * side }
    }

    /// Bytes of one element in a crate.
    #[must_use]
    pub fn size(self) -> usize {
        self.scalar.size() * usize::from(self.components)
    }

    /// The element that a type name stands for, without `[]`: `float`, `point3f`, `matrix4d`; `None` for
    /// types that are unknown here.
    #[must_use]
    pub fn from_type_name(name: &str) -> Option<Element> {
        let single = match name {
            "bool" => Some(Scalar::Bool),
            "uchar" => Some(Scalar::UChar),
            "int" => Some(Scalar::Int),
            "uint" => Some(Scalar::UInt),
            "int64" => Some(Scalar::Int64),
            "uint64" => Some(Scalar::UInt64),
            "half" => Some(Scalar::Half),
            "float" => Some(Scalar::Float),
            "double" | "timecode" => Some(Scalar::Double),
            "string" => Some(Scalar::String),
            "token" => Some(Scalar::Token),
            "asset" => Some(Scalar::Asset),
            _ => None,
        };
        single.map(Element::single).or_else(|| match name {
            "quath" => Some(Element::quaternion(Scalar::Half)),
            "quatf" => Some(Element::quaternion(Scalar::Float)),
            "quatd" => Some(Element::quaternion(Scalar::Double)),
            "matrix2d" => Some(Element::matrix(2)),
            "matrix3d" => Some(Element::matrix(3)),
            "matrix4d" | "frame4d" => Some(Element::matrix(4)),
            _ => vector_named(name),
        })
    }
}

/// `float3`, `int2`, `point3f`, `texCoord2h` and the like.
fn vector_named(name: &str) -> Option<Element> {
    let plain =
        [("int", Scalar::Int), ("half", Scalar::Half), ("float", Scalar::Float), ("double", Scalar::Double)];
    for (prefix, scalar) in plain {
        match name.strip_prefix(prefix) {
            Some("2") => return Some(Element::vector(scalar, 2)),
            Some("3") => return Some(Element::vector(scalar, 3)),
            Some("4") => return Some(Element::vector(scalar, 4)),
            _ => {}
        }
    }
    let roles = [
        ("point3", 3),
        ("vector3", 3),
        ("normal3", 3),
        ("color3", 3),
        ("color4", 4),
        ("texCoord2", 2),
        ("texCoord3", 3),
    ];
    let (rest, components) =
        roles.iter().find_map(|&(role, components)| Some((name.strip_prefix(role)?, components)))?;
    let scalar = match rest {
        "h" => Scalar::Half,
        "f" => Scalar::Float,
        "d" => Scalar::Double,
        _ => return None,
    };
    Some(Element::vector(scalar, components))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn type_names_are_understood() {
        let check = |name, scalar, components| {
            let element = Element::from_type_name(name).unwrap();
            assert_eq!((element.scalar, element.components), (scalar, components), "{name}");
        };
        check("point3f", Scalar::Float, 3);
        check("texCoord2h", Scalar::Half, 2);
        check("int3", Scalar::Int, 3);
        check("matrix4d", Scalar::Double, 16);
        check("quatf", Scalar::Float, 4);
        check("timecode", Scalar::Double, 1);
        for unknown in ["", "point3", "point3i", "float5", "opaque", "Float", "pathExpression"] {
            assert_eq!(Element::from_type_name(unknown), None, "{unknown}");
        }
    }
}
