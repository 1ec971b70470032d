//! A mesh in the colours of its own materials.

use glam::Vec3;
use hair_render::{MeshObject, Motion, RenderError};
use moving_mesh::{Part, TriangleMesh};

/// The pieces of a mesh that have a base colour in common, each reflecting it; and what there is to say of pictures
/// that could not be read. A part with a picture reflects its mean: surfaces here have one colour.
///
/// # Errors
/// [`RenderError::Argument`] as [`Motion::keys`], of which there is no reason when `object` was sound.
pub fn by_base_color(
    object: MeshObject,
    parts: &[Part],
) -> Result<(Vec<MeshObject>, Vec<String>), RenderError> {
    let mut words = Vec::new();
    let mut colors: Vec<(Vec3, Vec<[u32; 3]>)> = Vec::new();
    for part in parts {
        let color = part.base_color * mean(part, &mut words);
        let color = color.clamp(Vec3::ZERO, Vec3::ONE);
        let triangles = object.mesh.triangles.get(part.triangles.clone()).unwrap_or_default();
        match colors.iter_mut().find(|(other, _)| *other == color) {
            Some((_, all)) => all.extend_from_slice(triangles),
            None => colors.push((color, triangles.to_vec())),
        }
    }
    if let [(color, _)] = colors.as_slice() {
        return Ok((vec![MeshObject { albedo: *color, ..object }], words));
    }
    let colors = colors.into_iter().filter(|(_, triangles)| !triangles.is_empty());
    let pieces =
        colors.map(|(albedo, triangles)| piece(&object, triangles, albedo)).collect::<Result<_, _>>()?;
    Ok((pieces, words))
}

/// The mean of a part's picture; white where it has none.
fn mean(part: &Part, words: &mut Vec<String>) -> Vec3 {
    match part.texture() {
        Ok(None) => Vec3::ONE,
        Ok(Some(picture)) => {
            let sum = picture.pixels.iter().fold(glam::DVec3::ZERO, |sum, pixel| sum + pixel.as_dvec3());
            (sum / picture.pixels.len().max(1) as f64).as_vec3()
        }
        Err(error) => {
            words.push(format!("{error}; its base colour is taken without the picture"));
            Vec3::ONE
        }
    }
}

/// Some triangles of an object, with the vertices that they use.
fn piece(object: &MeshObject, mut triangles: Vec<[u32; 3]>, albedo: Vec3) -> Result<MeshObject, RenderError> {
    let mut numbers = vec![u32::MAX; object.mesh.positions.len()];
    let mut kept: Vec<usize> = Vec::new();
    for vertex in triangles.iter_mut().flatten() {
        let Some(number) = numbers.get_mut(*vertex as usize) else { continue };
        if *number == u32::MAX {
            *number = kept.len() as u32;
            kept.push(*vertex as usize);
        }
        *vertex = *number;
    }
    let some =
        |all: &[Vec3]| -> Vec<Vec3> { kept.iter().filter_map(|&vertex| all.get(vertex).copied()).collect() };
    let keys = |motion: &Motion| match motion.positions() {
        [] => Ok(Motion::STILL),
        keys => Motion::keys(keys.iter().map(|key| some(key)).collect()),
    };
    let mesh = TriangleMesh {
        positions: some(&object.mesh.positions),
        normals: object.mesh.normals.as_deref().map(some),
        triangles,
    };
    let (motion, turning) = (keys(&object.motion)?, keys(&object.turning)?);
    Ok(MeshObject { mesh, albedo, origin: object.origin, motion, turning })
}
