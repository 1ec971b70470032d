//! Roots spread over a surface.

use glam::{DVec3, Vec3};
use groom::random;

use crate::{FurSurface, SampleError};

/// A place on the surface and its outward normal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Root {
    pub(crate) place: DVec3,
    pub(crate) normal: DVec3,
}

/// `count` roots in the order of the triangles, each triangle with its share by area, and the whole area.
///
/// The shares are rounded so that they stay within one of the exact share for any run of triangles; inside a
/// triangle the roots follow Roberts' R2 sequence, which leaves neither gaps nor heaps, from a place of its own.
pub(crate) fn roots(
    surface: &FurSurface<'_>,
    normals: &[DVec3],
    count: u32,
    seed: u64,
) -> Result<(Vec<Root>, f64), SampleError> {
    let corners = |triangle: &[u32; 3]| triangle.map(|v| surface.positions[v as usize]);
    let areas: Vec<f64> = surface.triangles.iter().map(|t| area(corners(t))).collect();
    let total: f64 = areas.iter().sum();
    if !(total > 0.0 && total.is_finite()) {
        return Err(SampleError::Surface {
            place: "all triangles together".into(),
            found: format!("an area of {total}"),
            expected: "an area over 0 for fur to grow on",
        });
    }
    let offset = f64::from(random(seed, 0, "fur share"));
    let (mut sum, mut given) = (0.0, 0_u32);
    let mut roots = Vec::with_capacity(count as usize);
    for (id, (triangle, area)) in surface.triangles.iter().zip(&areas).enumerate() {
        sum += area;
        let due = (sum / total * f64::from(count) + offset).floor() as u32;
        let (places, directions) = (corners(triangle), triangle.map(|v| normals[v as usize]));
        let shift = |purpose| f64::from(random(seed, id as u32, purpose));
        let (first, second) = (shift("fur u"), shift("fur v"));
        for k in 0..due.saturating_sub(given) {
            let u = (first + 0.754_877_666_246_692_8 * f64::from(k)).fract();
            let v = (second + 0.569_840_290_998_053_3 * f64::from(k)).fract();
            // The far half of the parallelogram is the near half turned round.
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            let at = |values: [DVec3; 3]| values[0] * (1.0 - u - v) + values[1] * u + values[2] * v;
            roots.push(Root { place: at(places), normal: at(directions).normalize_or(face(places)) });
        }
        given = given.max(due);
    }
    // Rounding of the last sum may leave one strand over or short.
    roots.truncate(count as usize);
    while let Some(&last) = roots.last().filter(|_| roots.len() < count as usize) {
        roots.push(last);
    }
    Ok((roots, total))
}

/// The normal at every vertex: the file's, or the sum over all triangles that touch its place, each weighted by
/// its area. Vertices at the same place share it, so that a seam of the texture is no ridge in the fur.
pub(crate) fn normals(surface: &FurSurface<'_>) -> Vec<DVec3> {
    if let Some(normals) = surface.normals {
        return normals.iter().map(|n| n.as_dvec3().normalize_or_zero()).collect();
    }
    let key = |v: u32| surface.positions[v as usize].to_array().map(|x| (x + 0.0).to_bits());
    let mut sums = std::collections::HashMap::<[u64; 3], DVec3>::new();
    for triangle in surface.triangles {
        let [a, b, c] = triangle.map(|v| surface.positions[v as usize]);
        let normal = (b - a).cross(c - a);
        for &v in triangle {
            *sums.entry(key(v)).or_default() += normal;
        }
    }
    let of = |v| sums.get(&key(v)).map_or(DVec3::ZERO, |sum| sum.normalize_or_zero());
    (0..surface.positions.len() as u32).map(of).collect()
}

fn area([a, b, c]: [DVec3; 3]) -> f64 {
    0.5 * (b - a).cross(c - a).length()
}

fn face([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or(DVec3::Y)
}

/// Refuses a surface whose numbers do not hold together.
pub(crate) fn check(surface: &FurSurface<'_>) -> Result<(), SampleError> {
    let fault = |place: String, found: String, expected| Err(SampleError::Surface { place, found, expected });
    let count = surface.positions.len();
    if let Some(v) = surface.positions.iter().position(|p| !p.as_vec3().is_finite()) {
        return fault(format!("vertex {v}"), surface.positions[v].to_string(), "finite numbers of 32 bits");
    }
    let inside = |triangle: &[u32; 3]| triangle.iter().all(|&v| (v as usize) < count);
    if let Some(t) = surface.triangles.iter().position(|triangle| !inside(triangle)) {
        let found = format!("vertex indices {:?} of {count} vertices", surface.triangles[t]);
        return fault(format!("triangle {t}"), found, "indices below the vertex count");
    }
    match surface.normals {
        Some(normals) if normals.len() != count => {
            fault("normals".into(), format!("{} for {count} vertices", normals.len()), "one a vertex")
        }
        Some(normals) if !normals.iter().all(|n: &Vec3| n.is_finite()) => {
            fault("normals".into(), "one that is not finite".into(), "finite numbers")
        }
        _ => Ok(()),
    }
}
