//! A mesh that moves, as a scene wants it: one frame of it, and its way through the shutter.

use glam::{DVec3, Vec3};
use moving_mesh::{MeshError, MovingMesh, Pose, TriangleMesh};

use crate::{Bounds, MeshObject, Motion, RenderError};

/// Which moments of a mesh a picture shows, in seconds.
#[derive(Clone, Debug, Default, PartialEq)]
pub enum MeshTimes {
    /// The rest pose that the mesh was opened with: no moment.
    #[default]
    Rest,
    /// One moment, sharp.
    At(f64),
    /// Moments evenly from the shutter's opening to its closing.
    Through(Vec<f64>),
}

impl MeshObject {
    /// A mesh as it stands at `times`, turned to Y up and metres. Its positions are kept relative to where it
    /// stands, so that a character far away loses nothing.
    ///
    /// # Errors
    /// [`RenderError::Mesh`] for a pose that cannot be had, [`RenderError::Argument`] as [`Motion::keys`].
    pub fn posed(mesh: &MovingMesh, times: &MeshTimes, albedo: Vec3) -> Result<Self, RenderError> {
        let poses: Vec<Pose> = match times {
            MeshTimes::Rest => vec![mesh.rest().clone()],
            MeshTimes::At(time) => vec![mesh.pose(*time)?],
            // What does not move is not posed again and again.
            MeshTimes::Through(times) if !mesh.moves() => {
                times.iter().take(1).map(|&time| mesh.pose(time)).collect::<Result<_, MeshError>>()?
            }
            MeshTimes::Through(times) => {
                times.iter().map(|&time| mesh.pose(time)).collect::<Result<_, MeshError>>()?
            }
        };
        let Some(middle) = poses.get(poses.len() / 2) else {
            return Err(RenderError::argument("times of a mesh", "none", "at least one"));
        };
        let placing = Placing { z_up: mesh.is_z_up(), unit: mesh.meters_per_unit() };
        let around = Bounds::of_points(middle.positions.iter().map(|&p| placing.place(p)));
        let origin = around.map_or(DVec3::ZERO, |bounds| bounds.center());
        let positions =
            |pose: &Pose| pose.positions.iter().map(|&p| (placing.place(p) - origin).as_vec3()).collect();
        let normals = |pose: &Pose| -> Option<Vec<Vec3>> {
            pose.normals.as_ref().map(|normals| normals.iter().map(|&n| placing.turn(n)).collect())
        };
        let still = TriangleMesh {
            positions: positions(middle),
            triangles: mesh.triangles().to_vec(),
            normals: normals(middle),
        };
        let mut object = MeshObject { origin, ..MeshObject::still(still, albedo) };
        if poses.len() > 1 {
            object.motion = Motion::keys(poses.iter().map(positions).collect())?;
            let turning: Option<Vec<Vec<Vec3>>> = poses.iter().map(normals).collect();
            object.turning = turning.map_or(Ok(Motion::STILL), Motion::keys)?;
        }
        Ok(object)
    }
}

/// From a mesh's own numbers to the world's.
struct Placing {
    z_up: bool,
    unit: f64,
}

impl Placing {
    fn place(&self, point: DVec3) -> DVec3 {
        let turned = if self.z_up { DVec3::new(point.x, point.z, -point.y) } else { point };
        turned * self.unit
    }

    fn turn(&self, normal: Vec3) -> Vec3 {
        if self.z_up { Vec3::new(normal.x, normal.z, -normal.y) } else { normal }
    }
}
