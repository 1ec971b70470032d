//! What is changed of a groom.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Changes made to the groom, in this order: thinning, colours, widths, size.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Attributes {
    /// Keep every n-th strand.
    #[schemars(range(min = 1))]
    pub stride: Option<usize>,
    /// Keep at most this many strands, spread evenly.
    #[schemars(range(min = 1))]
    pub max_strands: Option<usize>,
    /// Colour of all strands, linear Rec. 709, 0..1.
    #[schemars(inner(range(min = 0.0, max = 1.0)))]
    pub color: Option<[f32; 3]>,
    /// How much lighter or darker than `color` single strands may be, in stops; needs `color`.
    #[schemars(range(min = 0.0, max = 8.0))]
    pub color_variation: Option<f32>,
    /// Colours at root and tip, blended along the strand.
    pub color_ramp: Option<[[f32; 3]; 2]>,
    /// Diameter of the strands in the file's units.
    #[schemars(range(min = 0.0))]
    pub width: Option<f32>,
    /// Diameters at root and tip in the file's units, straight in between.
    pub width_ramp: Option<[f32; 2]>,
    /// Multiply positions and widths.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub scale: Option<f32>,
}
