//! What can be asked of readers and writers, and what comes back.

use glam::DVec3;
use groom::{Groom, UpAxis};

use crate::{Format, Warning};

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
    /// Points of every strand in a file that is a bare list of them (PLY without strands).
    pub points_per_strand: Option<u32>,
    /// How far, in the file's units, a polyline may lie from the cubic curve it stands for; `None` is a
    /// thousandth of the curve's length, or as much more as keeps the polylines within four times the curves'
    /// points ([`Warning::CurvesCoarser`](crate::Warning::CurvesCoarser)). An error that is given is kept, with up
    /// to 256 points a span.
    pub curve_error: Option<f32>,
    /// Leave positions relative to where the first curves of the file stand ([`Loaded::origin`]), so that those of
    /// a character far away keep their precision (USD, Alembic).
    pub keep_origin: bool,
    /// Which time of an animated file, in its frames (time codes); `None` is the first.
    pub time: Option<f64>,
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
    /// What the file turned out to be; readers of one format leave it open.
    pub format: Option<Format>,
    /// Times at which an animated file has positions, in its frames; empty for a still.
    pub times: Vec<f64>,
    /// Frames a second of an animated file.
    pub frame_rate: Option<f64>,
    /// Where positions are measured from, in the groom's units; 0 unless [`ReadOptions::keep_origin`] asks for
    /// another.
    pub origin: DVec3,
}

impl Loaded {
    /// A still groom about which there is nothing more to say.
    #[must_use]
    pub fn still(groom: Groom) -> Self {
        Loaded {
            groom,
            warnings: Vec::new(),
            repairs: Vec::new(),
            hair: None,
            format: None,
            times: Vec::new(),
            frame_rate: None,
            origin: DVec3::ZERO,
        }
    }
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
    /// The program the file is for, where readers differ (USD, Alembic).
    pub dialect: Option<Dialect>,
    /// The material of the strands (USD); `None` writes none.
    pub look: Option<Look>,
    /// Strands as surfaces instead of lines (glTF).
    pub mesh: Option<Mesh>,
    /// Every attribute the format can hold, also where some readers stumble over them (glTF).
    pub all_attributes: bool,
    /// Bits a coordinate of a position is rounded to, 4 to 24; glTF then stores 16-bit integers up to 16.
    pub quantize: Option<u32>,
}

/// A program that reads grooms in a way of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Dialect {
    /// Unreal Engine: `GroomAPI`, `groom_*` attributes; Alembic in centimetres, z up.
    Unreal,
    /// SideFX Karma: phantom end points instead of pinned curves.
    Karma,
    /// Blender.
    Blender,
    /// SideFX Houdini: its names for hair attributes.
    Houdini,
}

/// How strands become surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Mesh {
    /// Closed tubes with this many sides, 3 to 32.
    Tubes {
        /// Sides around the strand.
        sides: u32,
    },
    /// Flat strips, two vertices a point.
    Ribbons,
}

/// A hair material in the parameters of Chiang et al. 2016, as numbers that need no renderer to be
/// understood.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Look {
    /// Colour of the hair under white light, linear Rec. 709, for materials that take a colour.
    pub color: [f32; 3],
    /// Absorption per fibre radius, linear Rec. 709.
    pub absorption: [f32; 3],
    /// Longitudinal roughness as an artist gives it, 0 to 1.
    pub beta_m: f32,
    /// Azimuthal roughness as an artist gives it, 0 to 1.
    pub beta_n: f32,
    /// Longitudinal variance v and logistic scale s of R, TT and TRT.
    pub roughness: [[f32; 2]; 3],
    /// Tilt of the cuticle's scales, radians, over 0 towards the root.
    pub alpha: f32,
    /// Index of refraction.
    pub eta: f32,
    /// Melanin concentration (0 to 1) and redness (0 to 1) if the colour was given so.
    pub melanin: Option<[f32; 2]>,
}
