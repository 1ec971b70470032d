//! A path tracer for hair: scene, cameras, lights, integrator, film, EXR.
//!
//! A [`SceneDescription`] (grooms, meshes, an [`Environment`], [`AreaLight`]s) is built into a
//! [`Scene`], seen through a [`Camera`] and rendered to a [`Frame`]: beauty, alpha, a pass for every
//! lobe of the fibres, and a [`FrameReport`] with the seconds it took and the estimated error.
//!
//! World space is metres, Y up, right-handed. Whatever unit or axes a groom or mesh comes in is
//! turned into it by [`Scene::build`], which also recentres everything, so that a scene a million
//! metres from the origin renders like one at the origin.
//!
//! What moves while the [`Shutter`] is open says so as [`Motion`] of its [`HairObject`] or [`MeshObject`]
//! (positions at two or more times, or velocities and accelerations), a camera as a [`MovingCamera`]. A scene in
//! which nothing moves is built and traced as if there were no shutter.
//!
//! The same scene, camera and settings give the same bits, whatever the number of threads. A long render goes in
//! passes ([`render_from`]): after each it can be looked at ([`SoFar`]) or written down ([`Checkpoint`], a picture
//! like any other), and one that was stopped and taken up again has the bits of one that was not.
//!
//! ```
//! use glam::Vec3;
//! use groom::{Attribute, Groom, names};
//! use hair_render::*;
//!
//! let mut groom = Groom::new(vec![0, 2], vec![Vec3::ZERO, Vec3::Y])?;
//! groom.set_attribute(names::RADIUS, Attribute::constant_float(0.05))?;
//! let scene = Scene::build(SceneDescription {
//!     hair: vec![HairObject::still(groom, HairMaterial::default())],
//!     environment: Some(Environment::constant(Vec3::ONE)?),
//!     ..Default::default()
//! })?;
//! let camera = Camera::fit(scene.bounds(), 0.0, 0.0, 0.5, 1.0)?;
//! let settings = RenderSettings { width: 16, height: 16, spp: 4, ..Default::default() };
//! let frame = render(&scene, &camera, &settings, &Silent)?;
//! assert!(frame.alpha.iter().any(|&alpha| alpha > 0.0));
//! println!("{} s, relative error {:?}", frame.report.seconds, frame.report.relative_error);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod aov;
mod area_light;
mod blur;
mod bounds;
mod camera;
mod caption;
mod checkpoint;
mod checkpoint_check;
mod checkpoint_every;
mod checkpoint_layers;
mod checkpoint_read;
mod checkpoint_write;
mod color_match;
mod color_probe;
mod color_search;
mod contact_sheet;
mod crop;
mod description;
mod digits;
mod environment;
mod environment_file;
mod environment_table;
mod error;
mod estimate;
mod explain;
mod exposure;
mod exr_file;
mod exr_read;
mod fibre_hit;
mod fibres;
mod filter;
mod frame;
mod frame_header;
mod frame_read;
mod lights;
mod models;
mod motion;
mod motion_report;
mod moving_camera;
mod output;
mod path;
mod placing;
mod posed_mesh;
mod progress;
mod render;
mod sampler;
mod scene;
mod settings;
mod shutter;
mod shutter_shape;
mod shutter_times;
mod studio;
mod sums;
mod surface;
mod table_use;
mod tone_map;

pub use aov::{Aov, AovSet};
pub use area_light::AreaLight;
pub use blur::{Blur, Movement};
pub use bounds::Bounds;
pub use camera::Camera;
pub use checkpoint::Checkpoint;
pub use checkpoint_every::{CheckpointEvery, CheckpointTimer, checkpoint_path};
pub use color_match::{ColorMatch, ColorMatching, match_color};
pub use color_search::Reach;
pub use contact_sheet::{ContactSheet, SheetLayout};
pub use crop::{Crop, Cutout};
pub use description::{HairMaterial, HairObject, MeshObject, SceneDescription, Transparency};
pub use environment::Environment;
pub use environment_file::{LightPicture, read_light};
pub use error::RenderError;
pub use explain::{LeftOut, explain, explain_camera};
pub use exr_file::{Metadata, Precision};
pub use fibre_material::{HairColor, Material};
pub use frame::{Frame, FrameReport};
pub use frame_header::FrameHeader;
pub use motion::Motion;
pub use motion_report::MotionReport;
pub use moving_camera::MovingCamera;
pub use output::check_output;
pub use posed_mesh::MeshTimes;
pub use progress::{Next, Progress, Silent, SoFar};
pub use render::{PASS_SPP, Rendered, render, render_from, render_moving};
pub use scene::Scene;
pub use settings::{Background, LightSampling, RenderSettings};
pub use shutter::{Shutter, ShutterOffset};
pub use shutter_shape::ShutterShape;
pub use studio::{STUDIO_WIDTH, write_studio};
pub use table_use::TableUse;
pub use tone_map::{
    Backdrop, Curve, Preview, ToneMapping, tone_map, tone_map_deep, tone_map_over, tone_map_over_deep,
};
