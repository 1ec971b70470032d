//! What a stage is made of, said once; the text and the crate write it down.

use usd_layer::write::WriteError;

use crate::usd::write::array::Array;

/// Takes a stage in the order of a text: the layer, then prims, each with its properties before its children.
pub(super) trait Sink {
    /// An array put aside until an attribute takes it as a sample.
    type Stored;

    /// Puts an array aside; nothing has been said of the layer yet.
    fn store(&mut self, array: &Array<'_>) -> Result<Self::Stored, WriteError>;

    /// Metadata of the layer: each name once, in alphabetical order.
    fn layer(&mut self, metadata: &[(&str, Single<'_>)]) -> Result<(), WriteError>;

    /// Opens a prim below the one that is open.
    fn begin(&mut self, prim: &Head<'_>) -> Result<(), WriteError>;

    /// An attribute of the prim that is open.
    fn attribute(
        &mut self,
        attribute: Declaration<'_>,
        content: Content<'_, Self::Stored>,
    ) -> Result<(), WriteError>;

    /// A relationship of the prim that is open.
    fn relationship(&mut self, name: &str, target: &str) -> Result<(), WriteError>;

    /// Closes the prim that is open.
    fn end(&mut self) -> Result<(), WriteError>;
}

/// What stands at the head of a prim.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Head<'a> {
    pub name: &'a str,
    pub type_name: &'a str,
    /// Schemas applied to it.
    pub apis: &'a [&'a str],
    /// Whether it is the model itself.
    pub is_component: bool,
}

/// What stands before an attribute's value, and the interpolation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Declaration<'a> {
    pub name: &'a str,
    pub type_name: &'a str,
    pub uniform: bool,
    pub interpolation: Option<&'a str>,
    /// How many values make one.
    pub element_size: Option<i32>,
}

impl<'a> Declaration<'a> {
    pub fn new(type_name: &'a str, name: &'a str) -> Self {
        Declaration { name, type_name, uniform: false, interpolation: None, element_size: None }
    }

    pub fn uniform(type_name: &'a str, name: &'a str) -> Self {
        Declaration { uniform: true, ..Declaration::new(type_name, name) }
    }
}

/// What an attribute holds.
pub(super) enum Content<'a, S> {
    /// Nothing: an output.
    Nothing,
    Single(Single<'a>),
    Array(&'a Array<'a>),
    /// Time codes and arrays put aside.
    Samples(&'a [(f64, S)]),
    /// Time codes and values that are small enough to be kept until now.
    Moving(&'a [(f64, Single<'a>)]),
    /// The path of another attribute.
    Connection(&'a str),
}

/// One value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Single<'a> {
    Token(&'a str),
    Text(&'a str),
    Float(f32),
    Double(f64),
    Float2([f32; 2]),
    Float3([f32; 3]),
    Double3([f64; 3]),
    Matrix4([f64; 16]),
    Tokens(&'a [&'a str]),
    Float3s(&'a [[f32; 3]]),
    /// Bits of halves.
    Half3s(&'a [[u16; 3]]),
    /// Real part first.
    Quaternions(&'a [[f32; 4]]),
    Matrix4s(&'a [[f64; 16]]),
}
