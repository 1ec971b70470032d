//! A mesh at any time.

use std::path::{Path, PathBuf};

use glam::{DMat4, Vec2};

use crate::error::Fault;
use crate::loaded::{Loaded, Motion, Source};
use crate::shape::Shape;
use crate::{
    Animation, MeshError, MeshOptions, Part, Pose, RestPose, Skeleton, TriangleMesh, gltf_file, obj_file,
    usd_file,
};

/// Triangles that stay the same, and where their vertices are at any time.
///
/// Times are seconds. Before the first key and after the last the mesh stands as it does there. Poses may be
/// asked for from several threads at once.
#[derive(Debug)]
pub struct MovingMesh {
    path: PathBuf,
    shape: Shape,
    motion: Motion,
    source: Source,
    rest: Pose,
}

impl MovingMesh {
    /// Reads `.obj`, `.gltf`, `.glb`, `.usd`, `.usda`, `.usdc` or `.usdz`, told apart by the ending; all meshes
    /// of the file become one. A name with `#` in the place of digits, `walk.####.obj`, is a sequence with one OBJ
    /// file a frame: they are read when a pose wants them, and a few are kept. Other files are held in memory; of a
    /// USD layer that is all its samples, as they are in the file.
    ///
    /// # Errors
    /// [`MeshError`]: the file cannot be read, breaks its format's rules or uses what is not supported; it has no
    /// animation as asked for; an option is out of range.
    pub fn open(path: impl AsRef<Path>, options: &MeshOptions) -> Result<Self, MeshError> {
        let path = path.as_ref();
        options.check()?;
        let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase()).unwrap_or_default();
        let read: fn(&Path, &MeshOptions) -> Result<Loaded, Fault> = match ending.as_str() {
            "obj" => obj_file::read,
            "gltf" | "glb" => gltf_file::read,
            "usd" | "usda" | "usdc" | "usdz" => usd_file::read,
            _ => {
                return Err(MeshError::Unsupported {
                    path: path.to_owned(),
                    what: format!("the ending `.{ending}`"),
                    remedy: "use .obj, .gltf, .glb, .usd, .usda, .usdc or .usdz",
                });
            }
        };
        let loaded = read(path, options).map_err(|fault| fault.in_file(path))?;
        MovingMesh::new(path, loaded, options)
    }

    fn new(path: &Path, loaded: Loaded, options: &MeshOptions) -> Result<Self, MeshError> {
        let Loaded { shape, mut motion, source } = loaded;
        let chosen = options.animation.among(&motion.animations).map_err(|fault| fault.in_file(path))?;
        motion.time_range = motion.time_range.filter(|_| chosen.is_some());
        let shape = shape.checked().map_err(|fault| fault.in_file(path))?;
        motion.frame_rate = options.frame_rate.or(motion.frame_rate);
        motion.is_z_up = options.z_up.unwrap_or(motion.is_z_up);
        motion.meters_per_unit = options.meters_per_unit.unwrap_or(motion.meters_per_unit);
        let mut mesh = MovingMesh { path: path.to_owned(), shape, motion, source, rest: Pose::default() };
        let mut rest = Pose::default();
        mesh.at(options.rest, &mut rest)?;
        mesh.rest = rest;
        Ok(mesh)
    }

    /// Vertex indices, three a triangle, counter-clockwise seen from outside, all below the vertex count.
    #[must_use]
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.shape.triangles
    }

    /// How many vertices every pose has.
    #[must_use]
    pub fn vertex_count(&self) -> usize {
        self.shape.vertex_count
    }

    /// Texture coordinates with V upwards, one a vertex, when any part has them; 0 in parts that have none.
    #[must_use]
    pub fn uvs(&self) -> Option<&[Vec2]> {
        self.shape.parts.iter().any(|part| part.has_uvs).then_some(self.shape.uvs.as_slice())
    }

    /// What the mesh is put together from, in the order of the triangles.
    #[must_use]
    pub fn parts(&self) -> &[Part] {
        &self.shape.parts
    }

    /// The animations of the file, whichever of them moves the mesh.
    #[must_use]
    pub fn animations(&self) -> &[Animation] {
        &self.motion.animations
    }

    /// Whether poses of different times may differ.
    #[must_use]
    pub fn moves(&self) -> bool {
        self.motion.time_range.is_some_and(|(start, end)| end > start)
    }

    /// Times of the first and last key in seconds; `None` for a mesh that nothing animates.
    #[must_use]
    pub fn time_range(&self) -> Option<(f64, f64)> {
        self.motion.time_range
    }

    /// Frames a second: as [`MeshOptions::frame_rate`] says, else as the file does. A glTF file knows only
    /// seconds: its rate is the lowest of 24, 25, 30, 48, 50, 60 and 120 whose frames hold all keys within
    /// 1e-4 s.
    #[must_use]
    pub fn frame_rate(&self) -> Option<f64> {
        self.motion.frame_rate
    }

    /// Whether Z is up; Y is otherwise.
    #[must_use]
    pub fn is_z_up(&self) -> bool {
        self.motion.is_z_up
    }

    /// How long a unit is (1 where the file does not say).
    #[must_use]
    pub fn meters_per_unit(&self) -> f64 {
        self.motion.meters_per_unit
    }

    /// The pose that [`MeshOptions::rest`] asked for.
    #[must_use]
    pub fn rest(&self) -> &Pose {
        &self.rest
    }

    /// The pose at `time`, in seconds.
    ///
    /// # Errors
    /// As [`MovingMesh::pose_into`].
    pub fn pose(&self, time: f64) -> Result<Pose, MeshError> {
        let mut pose = Pose::default();
        self.pose_into(time, &mut pose)?;
        Ok(pose)
    }

    /// The pose at `time`, in seconds, into a pose that exists: where that had the size, no memory is taken.
    ///
    /// # Errors
    /// [`MeshError::Parameter`] for a time that is no number; [`MeshError::Invalid`] for a vertex that flies
    /// out of the numbers, and for a frame that is another mesh, which it names. What `pose` then holds is not to
    /// be used.
    pub fn pose_into(&self, time: f64, pose: &mut Pose) -> Result<(), MeshError> {
        self.at(RestPose::Time(time), pose)
    }

    fn at(&self, at: RestPose, pose: &mut Pose) -> Result<(), MeshError> {
        if let RestPose::Time(time) = at {
            finite("time", time)?;
        }
        // Without an animation every time is the same.
        let at = if self.motion.time_range.is_none() && at.time().is_some() { RestPose::Nodes } else { at };
        self.source.pose_into(at, pose).map_err(|fault| fault.in_file(&self.path))?;
        match pose.positions.iter().position(|p| !p.is_finite()) {
            None => Ok(()),
            Some(i) => {
                let fault =
                    format!("position {} is not finite at {at:?}, expected numbers", pose.positions[i]);
                Err(Fault::invalid(format!("vertex {i}"), fault).in_file(&self.path))
            }
        }
    }

    /// The joints of the skins, when the mesh has skins that are read as such (glTF).
    #[must_use]
    pub fn skeleton(&self) -> Option<&Skeleton> {
        match &self.source {
            Source::Gltf(rig) => rig.skeleton(),
            _ => None,
        }
    }

    /// `world_from_joint` of every joint of the skeleton at `time`, in seconds; none without a skeleton. A
    /// skinned vertex is at the sum of `weight * world_from_joint * inverse_bind * modelled`.
    ///
    /// # Errors
    /// [`MeshError::Parameter`] for a time that is no number.
    pub fn joint_worlds(&self, time: f64) -> Result<Vec<DMat4>, MeshError> {
        finite("time", time)?;
        Ok(match &self.source {
            Source::Gltf(rig) => rig.joint_worlds(RestPose::Time(time)),
            _ => Vec::new(),
        })
    }

    /// The same triangles in one pose of this mesh, as `f32`.
    #[must_use]
    pub fn to_triangle_mesh(&self, pose: &Pose) -> TriangleMesh {
        TriangleMesh {
            positions: pose.positions.iter().map(|p| p.as_vec3()).collect(),
            triangles: self.shape.triangles.clone(),
            normals: pose.normals.clone(),
        }
    }
}

impl MeshOptions {
    fn check(&self) -> Result<(), MeshError> {
        for (name, value) in
            [("frame rate", self.frame_rate), ("step", self.step), ("metres per unit", self.meters_per_unit)]
        {
            if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
                return Err(MeshError::Parameter { name, value, range: "a number above 0" });
            }
        }
        if let Some((first, last)) = self.frames {
            finite("first frame", first)?;
            finite("last frame", last)?;
            if last < first {
                let range = "a frame not before the first";
                return Err(MeshError::Parameter { name: "last frame", value: last, range });
            }
        }
        if let RestPose::Time(time) = self.rest {
            finite("rest time", time)?;
        }
        Ok(())
    }
}

fn finite(name: &'static str, value: f64) -> Result<(), MeshError> {
    if value.is_finite() {
        Ok(())
    } else {
        Err(MeshError::Parameter { name, value, range: "a finite number" })
    }
}
