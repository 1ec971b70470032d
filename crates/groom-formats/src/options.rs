//! What can be asked of readers and writers, and what comes back.

use groom::{Groom, UpAxis};

use crate::Warning;

/// What a reader needs to know that the file does not say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ReadOptions {
    /// Which way is up in the file; `None` takes the format's custom (z for HAIR and text).
    pub up_axis: Option<UpAxis>,
    /// Metres in one unit of the file; `None` is 1.
    pub meters_per_unit: Option<f64>,
    /// Mend what is odd instead of only warning of it.
    pub repair: bool,
    /// Bytes the stream has, when that is known: memory for a HAIR file is then taken at once.
    pub known_len: Option<u64>,
}

/// A groom as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The strands, their unit and up axis.
    pub groom: Groom,
    /// What is odd about the file.
    pub warnings: Vec<Warning>,
    /// What was mended, in words; only with [`ReadOptions::repair`].
    pub repairs: Vec<String>,
    /// What a HAIR file holds beside the groom; `None` for other formats.
    pub hair: Option<HairExtras>,
}

/// What a HAIR file holds that a [`Groom`] has no place for; given back to the writer, the file comes
/// out with the same bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HairExtras {
    /// The 88 bytes of free words at the end of the header.
    pub info: [u8; 88],
    /// Whether the numbers of segments are an array even if all strands are alike.
    pub segments_array: bool,
    /// The default behind the segments array.
    pub default_segments: u32,
    /// The default (a diameter) behind the thickness array.
    pub default_thickness: f32,
    /// The default behind the transparency array.
    pub default_transparency: f32,
    /// The default behind the colour array.
    pub default_color: [f32; 3],
}

/// How a groom is written.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct WriteOptions {
    /// What a HAIR file should hold beside the groom; taken from [`Loaded::hair`].
    pub hair: Option<HairExtras>,
}
