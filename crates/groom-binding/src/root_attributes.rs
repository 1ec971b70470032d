//! What a groom learns from the surface under its roots.

use glam::{DVec3, Vec2, Vec3};
use groom::{Attribute, Domain, Groom, Values, names};
use moving_mesh::{MovingMesh, Part};

use crate::{Binding, BindingError, Surface};

/// The number of the triangle that a strand is bound to: int per strand.
pub const ROOT_TRIANGLE: &str = "root_triangle";

/// The surface's normal under a root, at rest and of unit length: vec3 per strand. (0, 0, 0) where it has none.
pub const ROOT_NORMAL: &str = "root_normal";

/// What strands are put into groups by.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum GroupBy {
    /// The name of the material under the root; parts without one are one group.
    Material,
    /// The part of the mesh under the root.
    Part,
}

/// Sets `root_uv` to the mesh's texture coordinate under each root, V upwards.
///
/// # Errors
/// [`BindingError::Invalid`]: the binding is of another groom or mesh, or the mesh has no coordinates.
pub fn set_root_uvs(groom: &mut Groom, binding: &Binding, surface: &Surface<'_>) -> Result<(), BindingError> {
    binding.check(groom, surface)?;
    let expected = "one a vertex";
    let uvs = surface.uvs.ok_or_else(|| BindingError::invalid("mesh", "no texture coordinates", expected))?;
    set(groom, names::ROOT_UV, Values::Vec2(root_uvs(binding, surface.triangles, uvs)))
}

/// Sets [`ROOT_NORMAL`].
///
/// # Errors
/// [`BindingError::Invalid`]: the binding is of a groom with another number of strands.
pub fn set_root_normals(groom: &mut Groom, binding: &Binding) -> Result<(), BindingError> {
    let normals = binding.roots().iter().map(|root| match root.facing {
        Some(_) => (root.rest.rotation * DVec3::Y).as_vec3(),
        None => Vec3::ZERO,
    });
    let values = Values::Vec3(normals.collect());
    binding.check_groom(groom)?;
    set(groom, ROOT_NORMAL, values)
}

/// Sets [`ROOT_TRIANGLE`], by which the groom can be bound again.
///
/// # Errors
/// [`BindingError::Invalid`]: the binding is of a groom with another number of strands, or a triangle's number is
/// too large for the attribute.
pub fn set_root_triangles(groom: &mut Groom, binding: &Binding) -> Result<(), BindingError> {
    let number = |triangle| {
        i32::try_from(triangle).map_err(|_| {
            let most = format!("at most {}", i32::MAX);
            BindingError::invalid(ROOT_TRIANGLE, format!("triangle {triangle}"), most)
        })
    };
    let numbers: Result<Vec<i32>, _> = binding.roots().iter().map(|root| number(root.triangle)).collect();
    let numbers = numbers?;
    binding.check_groom(groom)?;
    set(groom, ROOT_TRIANGLE, Values::Int(numbers))
}

/// Sets the strands' `color` to the base colour of the mesh under their roots: the material's factor times its
/// picture at the texture coordinate there, linear Rec. 709. White where the mesh says nothing.
///
/// # Errors
/// [`BindingError::Mesh`] when a picture under some root cannot be had; [`BindingError::Invalid`] when the binding
/// is of another groom or mesh. The groom is then as it was.
pub fn set_root_colors(groom: &mut Groom, binding: &Binding, mesh: &MovingMesh) -> Result<(), BindingError> {
    let surface = Surface::of(mesh);
    binding.check(groom, &surface)?;
    let parts = parts_of(binding, mesh.parts());
    let uvs = surface.uvs.map(|uvs| root_uvs(binding, surface.triangles, uvs));
    let mut colors = vec![Vec3::ONE; binding.strand_count()];
    for (number, part) in mesh.parts().iter().enumerate() {
        // A picture that no strand stands on is not decoded.
        if !parts.contains(&Some(number)) {
            continue;
        }
        let picture = if part.has_uvs { part.texture()? } else { None };
        for (strand, color) in colors.iter_mut().enumerate().filter(|(s, _)| parts[*s] == Some(number)) {
            let uv = uvs.as_ref().map_or(Vec2::ZERO, |uvs| uvs[strand]);
            let sampled = picture.as_ref().map_or(Vec3::ONE, |picture| picture.sample(uv));
            *color = part.base_color * sampled;
        }
    }
    set(groom, names::COLOR, Values::Vec3(colors))
}

/// Puts strands into groups by what is under their roots; the names of the groups, by number. Groups are numbered
/// in the order of the mesh's parts, those without strands too. Nameless ones have an empty name.
///
/// # Errors
/// [`BindingError::Invalid`] when the binding is of another groom or mesh.
pub fn set_groups(
    groom: &mut Groom,
    binding: &Binding,
    mesh: &MovingMesh,
    by: GroupBy,
) -> Result<Vec<String>, BindingError> {
    binding.check(groom, &Surface::of(mesh))?;
    let mut groups: Vec<String> = Vec::new();
    let mut group_of_part = Vec::new();
    for part in mesh.parts() {
        let name = match by {
            GroupBy::Part => part.name.clone(),
            GroupBy::Material => part.material.clone().unwrap_or_default(),
        };
        let known = match by {
            GroupBy::Part => None,
            GroupBy::Material => groups.iter().position(|group| *group == name),
        };
        group_of_part.push(known.unwrap_or(groups.len()) as i32);
        if known.is_none() {
            groups.push(name);
        }
    }
    let parts = parts_of(binding, mesh.parts());
    let numbers = parts.into_iter().map(|part| part.map_or(0, |part| group_of_part[part])).collect();
    set(groom, names::GROUP, Values::Int(numbers))?;
    Ok(groups)
}

fn set(groom: &mut Groom, name: &str, values: Values) -> Result<(), BindingError> {
    Ok(groom.set_attribute(name, Attribute { domain: Domain::Strand, values })?)
}

fn root_uvs(binding: &Binding, triangles: &[[u32; 3]], uvs: &[Vec2]) -> Vec<Vec2> {
    let under = |root: &crate::Root| {
        let [a, b, c] = triangles[root.triangle as usize].map(|vertex| uvs[vertex as usize].as_dvec2());
        let weights = root.barycentrics;
        (weights.x * a + weights.y * b + weights.z * c).as_vec2()
    };
    binding.roots().iter().map(under).collect()
}

/// The part that each strand stands on.
fn parts_of(binding: &Binding, parts: &[Part]) -> Vec<Option<usize>> {
    let holds = |triangle: usize| parts.iter().position(|part| part.triangles.contains(&triangle));
    let mut last: Option<usize> = None;
    let part = |root: &crate::Root| {
        let triangle = root.triangle as usize;
        // Neighbours mostly stand on the same.
        let same = last.filter(|&number| parts[number].triangles.contains(&triangle));
        last = same.or_else(|| holds(triangle));
        last
    };
    binding.roots().iter().map(part).collect()
}
