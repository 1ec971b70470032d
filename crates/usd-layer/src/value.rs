//! Values as layers hold them.

use std::sync::Arc;

use crate::Element;

/// Text that many places share: names, tokens, paths.
pub type Name = Arc<str>;

/// A value of an attribute or of metadata. Arrays stay in the file until they are asked for
/// ([`Layer::values`](crate::Layer::values)).
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Value {
    /// `None`: nothing, and no weaker opinion either.
    Blocked,
    /// `bool`.
    Bool(bool),
    /// Any whole number but `uint64` above 2^63 - 1.
    Int(i64),
    /// `half`, `float`, `double` and `timecode`; a `float` is widened, so nothing is lost.
    Float(f64),
    /// `string`.
    String(Name),
    /// `token`.
    Token(Name),
    /// `asset`: the path between the `@`.
    Asset(Name),
    /// A path in the stage.
    Path(Name),
    /// A vector, quaternion (real part first) or matrix (rows one after another).
    Tuple(Arc<Tuple>),
    /// An array in the file.
    Array(Array),
    /// Named values, in the file's order.
    Dictionary(Arc<[(Name, Value)]>),
    /// A list and how it edits weaker ones: `apiSchemas`, `references`, targets.
    List(Arc<ListOp>),
    /// A reference or payload.
    Reference(Arc<Reference>),
    /// A type that is not read here; its name.
    Unsupported(Name),
}

impl Value {
    /// The text of a string, token, asset path or path.
    #[must_use]
    pub fn text(&self) -> Option<&str> {
        match self {
            Value::String(text) | Value::Token(text) | Value::Asset(text) | Value::Path(text) => Some(text),
            _ => None,
        }
    }

    /// A number, whole or not.
    #[must_use]
    pub fn number(&self) -> Option<f64> {
        match *self {
            Value::Float(value) => Some(value),
            Value::Int(value) => Some(value as f64),
            _ => None,
        }
    }

    /// A whole number.
    #[must_use]
    pub fn integer(&self) -> Option<i64> {
        match *self {
            Value::Int(value) => Some(value),
            Value::Float(value) if value == value.trunc() && value.abs() < 9e15 => Some(value as i64),
            _ => None,
        }
    }

    /// The components of a vector, quaternion or matrix, or the one number.
    #[must_use]
    pub fn components(&self) -> Option<Vec<f64>> {
        match self {
            Value::Tuple(tuple) => Some(tuple.values.clone()),
            other => other.number().map(|value| vec![value]),
        }
    }

    /// The named value of a dictionary.
    #[must_use]
    pub fn entry(&self, name: &str) -> Option<&Value> {
        match self {
            Value::Dictionary(entries) => {
                entries.iter().find(|(key, _)| &**key == name).map(|(_, value)| value)
            }
            _ => None,
        }
    }
}

/// A vector, quaternion or matrix.
#[derive(Clone, Debug, PartialEq)]
pub struct Tuple {
    /// What it is made of.
    pub element: Element,
    /// One number a component; [`Element`] says in which order.
    pub values: Vec<f64>,
}

/// Where an array is in the file, and what of.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Array {
    /// What every element is.
    pub element: Element,
    pub(crate) storage: Storage,
    /// First byte in the layer.
    pub(crate) start: u64,
    /// Elements of a crate's array; one past the last byte of a text's.
    pub(crate) extent: u64,
}

/// How an array is stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Storage {
    /// What is between `[` and `]` of a text.
    Text,
    /// The elements' bytes, little endian.
    Plain,
    /// Whole numbers as compressed differences; numbers that are not whole through these or a table.
    Compressed,
}

/// A list and how it edits the lists of weaker layers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ListOp {
    /// The whole list; weaker ones do not count.
    pub explicit: Option<Vec<Value>>,
    /// Items put in front.
    pub prepended: Vec<Value>,
    /// Items put at the end.
    pub appended: Vec<Value>,
    /// Items put at the end unless they are there.
    pub added: Vec<Value>,
    /// Items taken away.
    pub deleted: Vec<Value>,
    /// Items brought into this order.
    pub ordered: Vec<Value>,
}

impl ListOp {
    /// The list that comes out where no weaker layer has one.
    pub fn items(&self) -> impl Iterator<Item = &Value> {
        let edits = self.prepended.iter().chain(&self.added).chain(&self.appended);
        let edits = if self.explicit.is_some() { None } else { Some(edits) };
        self.explicit.iter().flatten().chain(edits.into_iter().flatten())
    }
}

/// Another layer, or a prim in it or here, that is pulled in. Not followed: flatten the stage first.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// The other layer; empty for this one.
    pub asset: Name,
    /// The prim in it; empty for the default prim.
    pub prim: Name,
}
