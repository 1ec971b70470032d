//! Triangle meshes that move, for grooms to grow on and to shade: OBJ, glTF and USD; and the cameras of such files.
//!
//! ```no_run
//! use moving_mesh::{MeshOptions, MovingMesh};
//!
//! let fox = MovingMesh::open("fox.glb", &MeshOptions::default())?;
//! let pose = fox.pose(0.5)?;
//! println!("{} triangles, first vertex at {}", fox.triangles().len(), pose.positions[0]);
//! # Ok::<(), moving_mesh::MeshError>(())
//! ```
//!
//! | format | what moves it |
//! |---|---|
//! | glTF | skins (any number of joints a vertex), morph targets, nodes; STEP, LINEAR, CUBICSPLINE keys; any animation |
//! | OBJ | a file a frame, `walk.####.obj`: linear between frames |
//! | USD | samples of points, normals and transforms; UsdSkel, blend shapes and composition through usd-core |
//!
//! Which triangles there are never changes: a frame that is another mesh is an error that names it. Positions are
//! `f64`. [`CameraFile`] reads a camera of a glTF or USD file, with its lens and its way. Knows no hair and no
//! light.

mod budget;
mod camera_choice;
mod camera_file;
mod choice;
mod error;
mod gltf_file;
mod loaded;
mod moving_mesh;
mod normals;
mod obj_file;
mod options;
mod part;
mod pose;
mod recent;
mod shape;
mod skeleton;
mod sources;
mod texture;
mod triangle_mesh;
mod usd_file;

pub use camera_choice::CameraChoice;
pub use camera_file::{CameraFile, CameraOptions, CameraPose};
pub use error::MeshError;
pub use moving_mesh::MovingMesh;
pub use options::{Animation, AnimationChoice, MeshOptions, RestPose};
pub use part::Part;
pub use pose::Pose;
pub use skeleton::{Joint, Skeleton};
pub use sources::sources;
pub use texture::TextureImage;
pub use triangle_mesh::TriangleMesh;
