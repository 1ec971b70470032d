//! The types of values by their number in a crate: OpenUSD's `crateDataTypes.h`.

use crate::{Element, Scalar};

/// What a type number stands for.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Kind {
    Element(Element),
    Dictionary,
    ListOp(Item),
    Vector(Item),
    DoubleVector,
    Payload,
    Specifier,
    Permission,
    Variability,
    VariantSelection,
    TimeSamples,
    Blocked,
    /// A value that says its own type.
    Wrapped,
    Unsupported(&'static str),
}

/// An item of a list.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Item {
    Token,
    String,
    Path,
    Int,
    Int64,
    UInt,
    UInt64,
    Reference,
    Payload,
    LayerOffset,
}

impl Item {
    /// The fewest bytes it takes.
    pub(super) fn least(self) -> u64 {
        match self {
            Item::Token | Item::String | Item::Path | Item::Int | Item::UInt => 4,
            Item::Int64 | Item::UInt64 | Item::Payload => 8,
            Item::LayerOffset => 16,
            Item::Reference => 32,
        }
    }
}

pub(super) fn kind(number: u8) -> Kind {
    let single = |scalar| Kind::Element(Element::single(scalar));
    let vector = |scalar, n| Kind::Element(Element::vector(scalar, n));
    match number {
        1 => single(Scalar::Bool),
        2 => single(Scalar::UChar),
        3 => single(Scalar::Int),
        4 => single(Scalar::UInt),
        5 => single(Scalar::Int64),
        6 => single(Scalar::UInt64),
        7 => single(Scalar::Half),
        8 => single(Scalar::Float),
        9 | 56 => single(Scalar::Double),
        10 => single(Scalar::String),
        11 => single(Scalar::Token),
        12 => single(Scalar::Asset),
        13 => Kind::Element(Element::matrix(2)),
        14 => Kind::Element(Element::matrix(3)),
        15 => Kind::Element(Element::matrix(4)),
        16 => Kind::Element(Element::quaternion(Scalar::Double)),
        17 => Kind::Element(Element::quaternion(Scalar::Float)),
        18 => Kind::Element(Element::quaternion(Scalar::Half)),
        19 => vector(Scalar::Double, 2),
        20 => vector(Scalar::Float, 2),
        21 => vector(Scalar::Half, 2),
        22 => vector(Scalar::Int, 2),
        23 => vector(Scalar::Double, 3),
        24 => vector(Scalar::Float, 3),
        25 => vector(Scalar::Half, 3),
        26 => vector(Scalar::Int, 3),
        27 => vector(Scalar::Double, 4),
        28 => vector(Scalar::Float, 4),
        29 => vector(Scalar::Half, 4),
        30 => vector(Scalar::Int, 4),
        31 => Kind::Dictionary,
        32 => Kind::ListOp(Item::Token),
        33 => Kind::ListOp(Item::String),
        34 => Kind::ListOp(Item::Path),
        35 => Kind::ListOp(Item::Reference),
        36 => Kind::ListOp(Item::Int),
        37 => Kind::ListOp(Item::Int64),
        38 => Kind::ListOp(Item::UInt),
        39 => Kind::ListOp(Item::UInt64),
        40 => Kind::Vector(Item::Path),
        41 => Kind::Vector(Item::Token),
        42 => Kind::Specifier,
        43 => Kind::Permission,
        44 => Kind::Variability,
        45 => Kind::VariantSelection,
        46 => Kind::TimeSamples,
        47 => Kind::Payload,
        48 => Kind::DoubleVector,
        49 => Kind::Vector(Item::LayerOffset),
        50 => Kind::Vector(Item::String),
        51 => Kind::Blocked,
        52 => Kind::Wrapped,
        55 => Kind::ListOp(Item::Payload),
        60 => Kind::Blocked,
        53 => Kind::Unsupported("UnregisteredValue"),
        54 => Kind::Unsupported("UnregisteredValueListOp"),
        57 => Kind::Unsupported("PathExpression"),
        58 => Kind::Unsupported("Relocates"),
        59 => Kind::Unsupported("Spline"),
        _ => Kind::Unsupported("a type newer than this reader"),
    }
}
