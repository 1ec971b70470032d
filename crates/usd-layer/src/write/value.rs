//! Values and how a crate refers to them (OpenUSD, `pxr/usd/usd/crateDataTypes.h`).

/// A value of a layer. Arrays are borrowed: they go to the stream as they lie.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Value<'a> {
    /// `bool`.
    Bool(bool),
    /// `int`.
    Int(i32),
    /// `float`.
    Float(f32),
    /// `double`.
    Double(f64),
    /// `token`: a word of a fixed vocabulary.
    Token(&'a str),
    /// `string`: words for people.
    String(&'a str),
    /// `float2`, `texCoord2f`.
    Float2([f32; 2]),
    /// `float3`, `point3f`, `vector3f`, `color3f`.
    Float3([f32; 3]),
    /// `double3`.
    Double3([f64; 3]),
    /// `matrix4d`: rows, for points that are rows.
    Matrix4([f64; 16]),
    /// `int[]`.
    Ints(&'a [i32]),
    /// `float[]`.
    Floats(&'a [f32]),
    /// `float2[]`, `texCoord2f[]`.
    Float2s(&'a [[f32; 2]]),
    /// `float3[]`, `point3f[]`, `vector3f[]`, `color3f[]`.
    Float3s(&'a [[f32; 3]]),
    /// `half3[]`: bits of halves.
    Half3s(&'a [[u16; 3]]),
    /// `quatf[]`: real part first.
    Quaternions(&'a [[f32; 4]]),
    /// `matrix4d[]`: rows, for points that are rows.
    Matrix4s(&'a [[f64; 16]]),
    /// `token[]`.
    Tokens(&'a [&'a str]),
    /// `string[]`.
    Strings(&'a [&'a str]),
}

/// A value the layer holds, made by [`CrateWriter::store`](crate::write::CrateWriter::store); it means nothing to
/// other writers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Stored(pub(super) u64);

/// Numbers of the types, as they stand in references to values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub(super) enum Type {
    Bool = 1,
    Int = 3,
    Float = 8,
    Double = 9,
    String = 10,
    Token = 11,
    Matrix4 = 15,
    Quaternion = 17,
    Float2 = 20,
    Double3 = 23,
    Float3 = 24,
    Half3 = 25,
    TokenListOp = 32,
    PathListOp = 34,
    TokenVector = 41,
    Specifier = 42,
    Variability = 44,
    TimeSamples = 46,
    DoubleVector = 48,
}

const ARRAY: u64 = 1 << 63;
const IN_PLACE: u64 = 1 << 62;
const COMPRESSED: u64 = 1 << 61;
/// Offsets in the file have 48 bits.
pub(super) const LARGEST_OFFSET: u64 = (1 << 48) - 1;

impl Stored {
    /// A value of 32 bits, kept in the reference itself.
    pub(super) fn in_place(kind: Type, bits: u32) -> Self {
        Stored(IN_PLACE | (kind as u64) << 48 | u64::from(bits))
    }

    /// A single value at `offset` of the layer.
    pub(super) fn at(kind: Type, offset: u64) -> Self {
        Stored((kind as u64) << 48 | offset)
    }

    /// An array at `offset` of the layer.
    pub(super) fn array(kind: Type, offset: u64, compressed: bool) -> Self {
        let compressed = if compressed { COMPRESSED } else { 0 };
        Stored(ARRAY | compressed | (kind as u64) << 48 | offset)
    }
}
