//! What the page is given, as its script reads it.

use std::collections::BTreeMap;

use serde::Serialize;

/// How light becomes what is shown, as for the PNGs.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tone {
    /// Stops: each doubles the light.
    pub exposure: f32,
    /// How bright values are brought into 0..1.
    pub curve: Curve,
    /// What lies behind transparent pixels, linear Rec. 709; exposure and curve leave it alone.
    pub backdrop: [f32; 3],
    /// A picture that lies there instead.
    pub plate: Option<Plate>,
}

/// How bright values are brought into 0..1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Curve {
    /// Khronos PBR Neutral.
    Neutral,
    /// Cut off at 1.
    Clip,
}

/// A picture behind all frames of its size.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plate {
    pub(crate) width: u32,
    pub(crate) height: u32,
    pub(crate) png: String,
}

/// One thing that differs from variant to variant.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Axis {
    /// What it is called.
    pub name: String,
    /// The names of its settings.
    pub settings: Vec<String>,
}

/// A variant: a setting of every axis.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Variant {
    /// Its name; empty where there is but one.
    pub id: String,
    /// The name of its setting on every axis, in their order.
    pub settings: Vec<String>,
    /// How its passes are weighed before anybody touches anything; 1 where nothing is said.
    pub weights: BTreeMap<String, f32>,
    /// Everything it was made with: keys and values.
    pub parameters: Vec<(String, String)>,
}

/// What the script reads.
#[derive(Serialize)]
pub(crate) struct Data<'a> {
    pub tones: &'a [Tone],
    pub fps: f64,
    pub axes: &'a [Axis],
    pub passes: Vec<&'a String>,
    pub variants: Vec<Shown<'a>>,
}

/// A variant with its frames.
#[derive(Serialize)]
pub(crate) struct Shown<'a> {
    #[serde(flatten)]
    pub variant: &'a Variant,
    /// Which of the tones is its own.
    pub tone: usize,
    pub frames: Vec<FrameShown<'a>>,
}

/// A frame with the layers that are lit.
#[derive(Serialize)]
pub(crate) struct FrameShown<'a> {
    number: u32,
    facts: &'a [(String, String)],
    width: u32,
    height: u32,
    jpeg: &'a str,
    alpha: Option<&'a str>,
    /// One for every pass, null where it is black; null where the frame's passes are not kept.
    layers: Option<Vec<Option<&'a str>>>,
}

/// A frame, encoded.
#[derive(Debug)]
pub(crate) struct Frame {
    pub number: u32,
    pub facts: Vec<(String, String)>,
    pub width: u32,
    pub height: u32,
    pub jpeg: String,
    pub alpha: Option<String>,
    /// One for every pass of the page, none where it is black; none at all where they are not kept.
    pub layers: Option<Vec<Option<String>>>,
}

impl Frame {
    /// The layer of a pass, if it is kept and not black.
    pub fn layer(&self, pass: usize) -> Option<&str> {
        self.layers.as_ref()?.get(pass)?.as_deref()
    }

    /// The frame with those of its layers that are asked for.
    pub fn shown(&self, passes: &[usize]) -> FrameShown<'_> {
        let layers = |_: &Vec<_>| passes.iter().map(|&pass| self.layer(pass)).collect();
        FrameShown {
            number: self.number,
            facts: &self.facts,
            width: self.width,
            height: self.height,
            jpeg: &self.jpeg,
            alpha: self.alpha.as_deref(),
            layers: self.layers.as_ref().map(layers),
        }
    }
}
