//! What a pipeline may say: every key, its type and its default.
//!
//! Plain data; reading it from text is `expand`'s work, its ranges are `check`'s.

use std::path::PathBuf;

use fibre_material::MaterialFile;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

mod attributes;
mod binding;
mod camera;
mod comp;
mod editor;
mod groom;
mod lights;
mod mesh;
mod motion;
mod page;
mod render;
mod sheet;
mod tone;
mod turn;
mod video;

pub use attributes::Attributes;
pub use binding::{Beyond, Bind, BindBy, BindMode, Rest};
pub use camera::{CameraFile, CameraSettings};
pub use comp::Comp;
pub use editor::{json_schema, json_schema_text};
pub use groom::{Axis, GroomSource, SampleSource, Style};
pub use lights::{AreaSource, CornellBox, EnvironmentSource, Lights};
pub use mesh::MeshSource;
pub use motion::{BlurBy, MotionSettings};
pub use page::Page;
pub use render::{Precision, Render};
pub use sheet::{Caption, Sheet};
pub use tone::{Tone, ToneCurve};
pub use turn::{Ease, Turn, Turning};
pub use video::{Codec, Video};

/// A whole pipeline. Paths are relative to the file they are written in.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Pipeline {
    /// Version of these keys; 1.
    #[schemars(extend("minimum" = 1, "maximum" = 1))]
    pub version: Option<u32>,
    /// What the pipeline is called; the file's name when absent.
    pub name: Option<String>,
    /// Folder for everything made, relative to the folder the program is started in.
    pub output: Option<PathBuf>,
    /// Where the strands come from.
    pub groom: GroomSource,
    /// A mesh under the strands, such as a head.
    pub mesh: Option<MeshSource>,
    /// Strands bound to the mesh, which carries them.
    pub bind: Option<Bind>,
    /// What moves, and its blur.
    pub motion: Option<MotionSettings>,
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
    /// What is done to finished frames before they are shown.
    pub comp: Comp,
    /// The contact sheet; none when absent.
    pub sheet: Option<Sheet>,
    /// Films.
    pub video: Vec<Video>,
    /// The page that shows the result; none when absent.
    pub page: Option<Page>,
}
