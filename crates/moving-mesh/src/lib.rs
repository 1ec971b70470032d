//! Triangle meshes for grooms to grow on and to shade, read from OBJ and glTF.
//!
//! ```no_run
//! use moving_mesh::TriangleMesh;
//!
//! let head = TriangleMesh::open("samples/head.obj")?;
//! println!("{} triangles", head.triangles.len());
//! # Ok::<(), moving_mesh::MeshError>(())
//! ```
//!
//! A mesh is read in its rest pose: glTF node transforms, default morph weights and skins are applied.
//! Poses at other times have their place here and are not built yet. Knows no hair and no light.

mod error;
mod gltf_file;
mod obj_file;
mod pose;
mod triangle_mesh;

pub use error::MeshError;
pub use pose::Pose;
pub use triangle_mesh::TriangleMesh;
