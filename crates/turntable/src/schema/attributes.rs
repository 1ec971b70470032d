//! What is changed of a groom.

use serde::{Deserialize, Serialize};

/// Changes made to the groom, in this order: thinning, colours, widths, size.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Attributes {
    /// Keep every n-th strand.
    pub stride: Option<usize>,
    /// Keep at most this many strands, spread evenly.
    pub max_strands: Option<usize>,
    /// Colour of all strands, linear Rec. 709, 0..1.
    pub color: Option<[f32; 3]>,
    /// How much lighter or darker than `color` single strands may be, in stops; needs `color`.
    pub color_variation: Option<f32>,
    /// Colours at root and tip, blended along the strand.
    pub color_ramp: Option<[[f32; 3]; 2]>,
    /// Diameter of the strands in the file's units.
    pub width: Option<f32>,
    /// Diameters at root and tip in the file's units, straight in between.
    pub width_ramp: Option<[f32; 2]>,
    /// Multiply positions and widths.
    pub scale: Option<f32>,
}
