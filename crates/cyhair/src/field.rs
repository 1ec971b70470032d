//! The named parts of a HAIR file, for messages.

use std::fmt;

/// A part of a HAIR file: a header field or an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Field {
    /// The four bytes `HAIR`.
    Magic,
    /// How many strands there are.
    HairCount,
    /// How many points all strands have together.
    PointCount,
    /// Which arrays follow the header.
    ArrayBits,
    /// Segments of every strand when the segments array is absent.
    DefaultSegments,
    /// Thickness (a diameter) when the thickness array is absent.
    DefaultThickness,
    /// Transparency when the transparency array is absent.
    DefaultTransparency,
    /// Colour when the colours array is absent.
    DefaultColor,
    /// 88 bytes of text.
    Info,
    /// The segments array, one `u16` a strand.
    Segments,
    /// The points array, three `f32` a point.
    Points,
    /// The thickness array, one `f32` a point.
    Thickness,
    /// The transparency array, one `f32` a point.
    Transparency,
    /// The colours array, three `f32` a point.
    Colors,
}

impl Field {
    /// The five arrays in the order they have in a file, which is the order of their bits.
    pub const ARRAYS: [Field; 5] =
        [Field::Segments, Field::Points, Field::Thickness, Field::Transparency, Field::Colors];

    /// The bit that announces this array in the header; 0 for header fields.
    #[must_use]
    pub fn bit(self) -> u32 {
        Field::ARRAYS.iter().position(|&array| array == self).map_or(0, |index| 1 << index)
    }

    /// Bytes one value of this array takes; 0 for header fields.
    #[must_use]
    pub fn value_bytes(self) -> u64 {
        match self {
            Field::Segments => 2,
            Field::Points | Field::Colors => 12,
            Field::Thickness | Field::Transparency => 4,
            _ => 0,
        }
    }

    /// Where a header field starts; 128, the end of the header, for arrays.
    #[must_use]
    pub fn header_offset(self) -> u64 {
        match self {
            Field::Magic => 0,
            Field::HairCount => 4,
            Field::PointCount => 8,
            Field::ArrayBits => 12,
            Field::DefaultSegments => 16,
            Field::DefaultThickness => 20,
            Field::DefaultTransparency => 24,
            Field::DefaultColor => 28,
            Field::Info => 40,
            _ => 128,
        }
    }
}

impl fmt::Display for Field {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Field::Magic => "magic",
            Field::HairCount => "hair_count",
            Field::PointCount => "point_count",
            Field::ArrayBits => "arrays",
            Field::DefaultSegments => "default_segments",
            Field::DefaultThickness => "default_thickness",
            Field::DefaultTransparency => "default_transparency",
            Field::DefaultColor => "default_color",
            Field::Info => "info",
            Field::Segments => "segments",
            Field::Points => "points",
            Field::Thickness => "thickness",
            Field::Transparency => "transparency",
            Field::Colors => "colors",
        })
    }
}
