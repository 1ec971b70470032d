//! What a pipeline may say: every key, its type and its default.
//!
//! Plain data; reading it from text is `yaml.rs`'s work, its ranges are `check.rs`'s.

use std::path::PathBuf;

use fibre_material::MaterialFile;
use serde::{Deserialize, Serialize};

/// A whole pipeline.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Pipeline {
    /// Version of these keys; 1.
    pub version: Option<u32>,
    /// What the pipeline is called; the file's name when absent.
    pub name: Option<String>,
    /// Folder for everything made, relative to the folder the program is started in.
    pub output: Option<PathBuf>,
    /// Where the strands come from.
    pub groom: GroomSource,
    /// A mesh under the strands, such as a head.
    pub mesh: Option<MeshSource>,
    /// Changes made to the groom before anything else sees it.
    pub attributes: Attributes,
    /// Files to write the groom to, in the output folder; the format follows the extension.
    pub convert: Vec<PathBuf>,
    /// How the strands scatter light: the keys of a material file, among them `file` and `preset`.
    pub material: MaterialFile,
    /// What shines.
    pub lights: Lights,
    /// How the groom is framed.
    pub camera: CameraSettings,
    /// Which views are taken.
    pub turntable: Turn,
    /// How a frame is rendered.
    pub render: Render,
    /// From light to display colours, for the sheet and PNG frames.
    pub tone: Tone,
    /// The contact sheet; none when absent.
    pub sheet: Option<Sheet>,
}

/// Where the strands come from: a file or a made-up sample, one of the two.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct GroomSource {
    /// A groom file, relative to the pipeline file.
    pub file: Option<PathBuf>,
    /// A groom the program makes itself.
    pub sample: Option<SampleSource>,
    /// Which axis of the file points up; the file's own word when absent.
    pub up: Option<Axis>,
    /// Metres in one unit of the file; the file's own word, or 1, when absent.
    pub meters_per_unit: Option<f64>,
    /// Mend what is merely odd in a file (zero-length segments, one-point strands).
    pub repair: bool,
}

/// A groom the program makes itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct SampleSource {
    /// Kind of hair.
    pub style: Style,
    /// How many strands.
    pub strands: u32,
    /// Points a strand.
    pub points: u32,
    /// Everything random follows from it.
    pub seed: u64,
}

impl Default for SampleSource {
    fn default() -> Self {
        SampleSource { style: Style::Wavy, strands: 5000, points: 24, seed: 1 }
    }
}

/// Kind of made-up hair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Style {
    /// Straight hair.
    Straight,
    /// Wavy hair.
    Wavy,
    /// Curly hair.
    Curly,
}

/// An axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// The second axis.
    Y,
    /// The third axis.
    Z,
}

/// A matte mesh.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct MeshSource {
    /// `.obj`, `.gltf` or `.glb`, relative to the pipeline file.
    pub file: PathBuf,
    /// Which axis of the file points up; the file's own word when absent.
    pub up: Option<Axis>,
    /// Metres in one unit of the file; the file's own word when absent.
    pub meters_per_unit: Option<f64>,
    /// Reflected share of the light, linear Rec. 709.
    pub albedo: [f32; 3],
}

impl Default for MeshSource {
    fn default() -> Self {
        MeshSource { file: PathBuf::new(), up: None, meters_per_unit: None, albedo: [0.5, 0.42, 0.36] }
    }
}

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

/// What shines.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Lights {
    /// Light from all around.
    pub environment: Option<EnvironmentSource>,
    /// Shining rectangles.
    pub area: Vec<AreaSource>,
}

/// Light from all around: one of `file`, `constant` or `studio: true`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct EnvironmentSource {
    /// An equirectangular `.hdr` or `.exr`, relative to the pipeline file.
    pub file: Option<PathBuf>,
    /// The same radiance from everywhere.
    pub constant: Option<[f32; 3]>,
    /// A studio the program makes itself: soft boxes over a grey room.
    pub studio: bool,
    /// Turn about the up axis, degrees.
    pub rotation: f32,
    /// Factor on the radiance.
    pub intensity: f32,
}

impl Default for EnvironmentSource {
    fn default() -> Self {
        EnvironmentSource { file: None, constant: None, studio: false, rotation: 0.0, intensity: 1.0 }
    }
}

/// A rectangle that shines from its front, in world metres, Y up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct AreaSource {
    /// Its middle, metres.
    pub position: [f64; 3],
    /// The point its front looks at, metres.
    pub target: [f64; 3],
    /// Width and height, metres.
    pub size: [f32; 2],
    /// Radiance, linear Rec. 709.
    pub radiance: [f32; 3],
}

impl Default for AreaSource {
    fn default() -> Self {
        AreaSource { position: [1.0, 1.0, 1.0], target: [0.0; 3], size: [0.5, 0.5], radiance: [5.0; 3] }
    }
}

/// How the groom is framed. The camera stands on a circle about the target.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct CameraSettings {
    /// Vertical field of view, degrees.
    pub fov: f64,
    /// Angle above the horizon, degrees.
    pub elevation: f64,
    /// Distance to the target in metres; far enough for everything to fit when absent.
    pub distance: Option<f64>,
    /// Factor on the size in the picture when the distance is fitted.
    pub zoom: f64,
    /// What is looked at, in world metres, Y up; the middle of the scene when absent.
    pub target: Option<[f64; 3]>,
}

impl Default for CameraSettings {
    fn default() -> Self {
        CameraSettings { fov: 30.0, elevation: 5.0, distance: None, zoom: 1.0, target: None }
    }
}

/// Which views are taken.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Turn {
    /// How many, spread evenly.
    pub frames: u32,
    /// Azimuth of the first, degrees; 0 looks at the front.
    pub start: f64,
    /// How far the camera goes round, degrees; a full circle does not repeat its start.
    pub degrees: f64,
    /// What stays with the groom: `camera` turns the camera alone, `groom` turns the groom before
    /// a camera and lights that stand still.
    pub turn: Turning,
}

impl Default for Turn {
    fn default() -> Self {
        Turn { frames: 12, start: 0.0, degrees: 360.0, turn: Turning::Camera }
    }
}

/// What turns.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Turning {
    /// The camera goes round; the light stays with the groom.
    Camera,
    /// The groom turns before the camera; the light stays with the camera.
    Groom,
}

/// How a frame is rendered.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Render {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Samples a pixel.
    pub spp: u32,
    /// Everything random follows from it.
    pub seed: u64,
    /// Scatterings after the first before a path is cut.
    pub max_bounces: u32,
    /// Passes beside beauty and alpha: R, TT, TRT, residual, scattered, surface, background.
    pub aovs: Vec<String>,
    /// Leave the environment out of the picture and say by alpha what is covered.
    pub transparent: bool,
}

impl Default for Render {
    fn default() -> Self {
        Render {
            width: 512,
            height: 512,
            spp: 64,
            seed: 0,
            max_bounces: 256,
            aovs: Vec::new(),
            transparent: true,
        }
    }
}

/// From light to display colours.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Tone {
    /// Stops: each doubles the light.
    pub exposure: f32,
    /// How bright values are brought into 0..1.
    pub curve: ToneCurve,
    /// What lies behind transparent frames, linear Rec. 709; exposure and curve leave it alone.
    pub background: [f32; 3],
    /// Also write every frame as a PNG beside its EXR.
    pub frames: bool,
}

impl Default for Tone {
    fn default() -> Self {
        Tone { exposure: 0.0, curve: ToneCurve::Neutral, background: [0.18; 3], frames: false }
    }
}

/// How bright values are brought into 0..1.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum ToneCurve {
    /// Khronos PBR Neutral: true colours, soft highlights.
    Neutral,
    /// Cut off at 1.
    Clip,
}

/// The contact sheet.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Sheet {
    /// The PNG, in the output folder.
    pub file: PathBuf,
    /// Frames in a row; about square when absent.
    pub columns: Option<u32>,
    /// Pixels between frames.
    pub gap: u32,
    /// Write each frame's number in its corner.
    pub labels: bool,
}

impl Default for Sheet {
    fn default() -> Self {
        Sheet { file: PathBuf::from("sheet.png"), columns: None, gap: 4, labels: true }
    }
}
