//! Whether roots stay where they were bound.

use glam::DVec3;
use glam::Vec3;
use groom::Groom;
use groom_binding::Binding;
use moving_mesh::Pose;

/// How much farther from its place, or nearer to it, a root is than it was bound, at most.
pub(crate) fn root_error(
    groom: &Groom,
    binding: &Binding,
    triangles: &[[u32; 3]],
    pose: &Pose,
    positions: &[Vec3],
    origin: DVec3,
) -> f64 {
    let errors = binding.roots().iter().zip(groom.offsets()).filter_map(|(root, &first)| {
        let corners = triangles.get(root.triangle as usize)?;
        let [a, b, c] = corners.map(|vertex| pose.positions.get(vertex as usize).copied());
        let (a, b, c) = (a? - origin, b? - origin, c? - origin);
        let place = a + root.barycentrics.y * (b - a) + root.barycentrics.z * (c - a);
        let distance = positions.get(first as usize)?.as_dvec3().distance(place);
        Some((distance - root.height.abs()).abs())
    });
    errors.fold(0.0, f64::max)
}
