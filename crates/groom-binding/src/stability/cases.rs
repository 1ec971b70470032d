//! The rows of the table.

use glam::{DAffine3, DMat3, DQuat, DVec3, Vec3};
use groom::{Groom, GroomError};

use super::StabilityCase;
use super::shapes::{Mesh, egg, sheet, strands, tufts};

/// Poses that a case runs through.
const POSES: u32 = 8;

pub(super) fn all() -> Result<Vec<StabilityCase>, GroomError> {
    let hair = strands(400, 0.2, 1)?;
    let upright = |mesh: &Mesh| tufts(mesh.rest.positions.iter().map(|p| p.as_vec3()));
    let sized = |size: f64| {
        let mut groom = hair.clone();
        groom.positions_mut().iter_mut().for_each(|p| *p *= size as f32);
        groom
    };
    let dots = |groom: &Groom| {
        let roots: Vec<Vec3> = groom.strands().map(|strand| strand[0]).collect();
        Groom::new((0..=roots.len() as u32).collect(), roots)
    };
    let plain = |name| StabilityCase {
        name,
        mesh: egg(12, 16),
        groom: hair.clone(),
        motions: nods(DVec3::ZERO),
        spoil: |_, _, _| {},
        is_rigid: true,
    };
    let spoilt = |name, spoil| StabilityCase { spoil, is_rigid: false, ..plain(name) };
    let on = |name, mesh| StabilityCase { mesh, ..plain(name) };
    Ok(vec![
        plain("nothing odd"),
        on("degenerate triangles at rest", with_slivers(egg(12, 16))),
        spoilt("triangles that collapse", collapse_some),
        spoilt("triangles that turn over", pull_over),
        on("every vertex repeated", soup(egg(12, 16))),
        StabilityCase { groom: upright(&sheet(4))?, ..on("two sides back to back", leaf(4)) },
        spoilt("a mesh that collapses to a point", to_a_point),
        StabilityCase { is_rigid: false, ..on("a mesh that is a point at rest", scaled(egg(4, 5), 0.0)) },
        StabilityCase { motions: mirrors(), ..plain("mirrored") },
        StabilityCase { motions: jump(), ..plain("a jump of 1000 in one frame") },
        StabilityCase { groom: upright(&with_middles(egg(12, 16)))?, ..plain("roots on edges and vertices") },
        StabilityCase { groom: dots(&hair)?, ..plain("strands of one point") },
        StabilityCase { groom: Groom::new(vec![0], Vec::new())?, ..plain("no strand") },
        StabilityCase { groom: upright(&sheet(3))?, ..on("a single triangle", one_triangle()) },
        StabilityCase { motions: nods(DVec3::new(1e6, -1e6, 1e6)), ..plain("1e6 from the origin") },
        StabilityCase { groom: sized(1e-6), ..on("1e-6 times the size", scaled(egg(12, 16), 1e-6)) },
        StabilityCase { groom: sized(1e6), ..on("1e6 times the size", scaled(egg(12, 16), 1e6)) },
    ])
}

/// A nod to the side, all told by less than a right angle, some way off.
fn nods(off: DVec3) -> Vec<DAffine3> {
    let turn = |t: f64| DQuat::from_scaled_axis(DVec3::new(0.7, 0.5, -0.4) * t);
    let nod = |t: f64| DAffine3::from_rotation_translation(turn(t), off + DVec3::new(0.5, 0.2, 0.0) * t);
    (1..=POSES).map(|number| nod(f64::from(number) / f64::from(POSES))).collect()
}

/// Every other pose is seen in a mirror.
fn mirrors() -> Vec<DAffine3> {
    let mirror = DAffine3::from_mat3(DMat3::from_diagonal(DVec3::new(-1.0, 1.0, 1.0)));
    let seen = |(number, motion)| if number % 2 == 0 { motion * mirror } else { motion };
    nods(DVec3::ZERO).into_iter().enumerate().map(seen).collect()
}

fn jump() -> Vec<DAffine3> {
    let mut motions = nods(DVec3::ZERO);
    let half = motions.len() / 2;
    for motion in &mut motions[half..] {
        motion.translation += DVec3::new(1000.0, 0.0, 0.0);
    }
    motions
}

/// Every third triangle once more with two of its corners in one, and once more with three in a line.
fn with_slivers(mut mesh: Mesh) -> Mesh {
    let mut slivers = Vec::new();
    for &[a, b, c] in mesh.triangles.iter().step_by(3) {
        slivers.push([a, b, b]);
        let middle = mesh.rest.positions[b as usize].midpoint(mesh.rest.positions[c as usize]);
        slivers.push([b, mesh.rest.positions.len() as u32, c]);
        mesh.rest.positions.push(middle);
        mesh.uvs.push(mesh.uvs[a as usize]);
    }
    // The first in number, so that they would be taken where they are as near as others.
    mesh.triangles.splice(0..0, slivers);
    mesh
}

/// Every triangle with vertices of its own.
fn soup(mesh: Mesh) -> Mesh {
    let vertices: Vec<usize> = mesh.triangles.as_flattened().iter().map(|&vertex| vertex as usize).collect();
    let mut own = mesh.clone();
    own.rest.positions = vertices.iter().map(|&vertex| mesh.rest.positions[vertex]).collect();
    own.uvs = vertices.iter().map(|&vertex| mesh.uvs[vertex]).collect();
    own.triangles = (0..mesh.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    own
}

/// A sheet with a second one behind it that faces the other way, on vertices of its own.
fn leaf(n: u32) -> Mesh {
    let mut mesh = sheet(n);
    let count = mesh.rest.positions.len() as u32;
    let back: Vec<[u32; 3]> =
        mesh.triangles.iter().map(|&[a, b, c]| [a + count, c + count, b + count]).collect();
    mesh.triangles.extend(back);
    mesh.rest.positions.extend_from_within(..);
    mesh.uvs.extend_from_within(..);
    mesh
}

fn one_triangle() -> Mesh {
    let mut mesh = sheet(1);
    mesh.triangles.truncate(1);
    mesh
}

/// A vertex more at the middle of every edge; no triangle uses it.
fn with_middles(mut mesh: Mesh) -> Mesh {
    for t in &mesh.triangles {
        for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
            let middle = mesh.rest.positions[a as usize].midpoint(mesh.rest.positions[b as usize]);
            mesh.rest.positions.push(middle);
        }
    }
    mesh
}

fn scaled(mut mesh: Mesh, size: f64) -> Mesh {
    mesh.rest.positions.iter_mut().for_each(|p| *p *= size);
    mesh
}

/// Every fifth triangle becomes a point, and every fifth after it a line, in turn with poses at which nothing does.
fn collapse_some(mesh: &Mesh, pose: usize, positions: &mut [DVec3]) {
    if pose.is_multiple_of(2) {
        return;
    }
    for (number, &[a, b, c]) in mesh.triangles.iter().enumerate() {
        let (a, b, c) = (a as usize, b as usize, c as usize);
        match number % 5 {
            0 => {
                (positions[b], positions[c]) = (positions[a], positions[a]);
            }
            1 => positions[c] = positions[a].midpoint(positions[b]),
            _ => {}
        }
    }
}

/// Here and there a vertex is pulled over the far edge of one of its triangles, along the surface, at each pose
/// another: the triangle turns over, and its neighbours, which are sheared, do not.
fn pull_over(mesh: &Mesh, pose: usize, positions: &mut [DVec3]) {
    let before = positions.to_vec();
    for t in mesh.triangles.iter().skip(pose).step_by(17) {
        let [a, b, c] = t.map(|vertex| before[vertex as usize]);
        positions[t[2] as usize] = c + 1.6 * (a.midpoint(b) - c);
    }
}

/// Smaller and smaller, nothing for three poses, and back.
fn to_a_point(_: &Mesh, pose: usize, positions: &mut [DVec3]) {
    let size = [1.0, 1e-3, 1e-9, 0.0, 0.0, 0.0, 1e-6, 1.0].get(pose).copied().unwrap_or(1.0);
    let centre = positions.iter().sum::<DVec3>() / positions.len().max(1) as f64;
    positions.iter_mut().for_each(|p| *p = centre + (*p - centre) * size);
}
