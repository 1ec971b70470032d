//! What fur on any surface fulfils.

#![allow(clippy::unwrap_used, clippy::panic)] // tests fail by panicking

use glam::{DVec3, Vec3, dvec3};
use groom::{Groom, Statistics};
use groom_samples::{FurOptions, FurSurface, SampleError, fur_on};

struct Mesh {
    positions: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<Vec3>,
}

impl Mesh {
    fn surface(&self) -> FurSurface<'_> {
        FurSurface { positions: &self.positions, triangles: &self.triangles, normals: Some(&self.normals) }
    }

    fn corners(&self, triangle: usize) -> [DVec3; 3] {
        self.triangles[triangle].map(|v| self.positions[v as usize])
    }
}

/// A box with these sides, its six faces in squares; every square has vertices of its own.
fn slab(sides: DVec3, squares: u32) -> Mesh {
    let mut mesh = Mesh { positions: Vec::new(), triangles: Vec::new(), normals: Vec::new() };
    for face in 0..6 {
        let axis = face / 2;
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let mut normal = Vec3::ZERO;
        normal[axis] = if face % 2 == 0 { -1.0 } else { 1.0 };
        let side = if face % 2 == 0 { -0.5 } else { 0.5 };
        for square in 0..squares * squares {
            let at = |du: u32, dv: u32| {
                let mut p = DVec3::splat(side);
                p[u] = f64::from(square % squares + du) / f64::from(squares) - 0.5;
                p[v] = f64::from(square / squares + dv) / f64::from(squares) - 0.5;
                p * sides
            };
            let first = mesh.positions.len() as u32;
            mesh.positions.extend([at(0, 0), at(1, 0), at(1, 1), at(0, 1)]);
            mesh.normals.extend([normal; 4]);
            let [a, b, c, d] = [first, first + 1, first + 2, first + 3];
            let outwards = [[a, b, c], [a, c, d]];
            mesh.triangles.extend(if side > 0.0 { outwards } else { outwards.map(|[a, b, c]| [a, c, b]) });
        }
    }
    mesh
}

fn grown(mesh: &Mesh, options: &FurOptions) -> Groom {
    fur_on(&mesh.surface(), options).unwrap()
}

#[test]
fn roots_are_spread_by_area() {
    let mesh = slab(dvec3(4.0, 1.0, 2.0), 5);
    let options = FurOptions { strands: 3001, ..FurOptions::default() };
    let groom = grown(&mesh, &options);
    assert_eq!((groom.strand_count(), groom.point_count()), (3001, 3001 * 8));
    let area = |[a, b, c]: [DVec3; 3]| 0.5 * (b - a).cross(c - a).length();
    let whole: f64 = (0..mesh.triangles.len()).map(|t| area(mesh.corners(t))).sum();
    let (mut strand, mut due) = (0, 0.0);
    for triangle in 0..mesh.triangles.len() {
        let corners = mesh.corners(triangle);
        let [a, b, c] = corners;
        // Roots come in the order of the triangles: those on this one, one after another.
        let on = |p: &Vec3| {
            let p = p.as_dvec3();
            area([p, a, b]) + area([p, b, c]) + area([p, c, a]) < area(corners) * (1.0 + 1e-5)
        };
        while strand < 3001 && on(&groom.strand(strand)[0]) {
            strand += 1;
        }
        due += area(corners) / whole * 3001.0;
        assert!((strand as f64 - due).abs() < 2.0, "triangle {triangle}: {strand} of {due}");
    }
    assert_eq!(strand, 3001);
    // Evenly inside of triangles too: no two roots much closer than that many need be.
    let roots: Vec<Vec3> = groom.strands().map(|s| s[0]).collect();
    let spacing = (whole / 3001.0).sqrt();
    let nearest = |i: usize| {
        let others = roots.iter().enumerate().filter(|(j, _)| *j != i);
        others.map(|(_, p)| f64::from(p.distance(roots[i]))).fold(f64::INFINITY, f64::min)
    };
    let close = (0..roots.len()).step_by(7).filter(|&i| nearest(i) < 0.2 * spacing).count();
    // Thrown at random 50 are.
    assert!(close < 36, "{close} of {}", roots.len() / 7);
}

#[test]
fn fur_is_sound_and_the_same_every_time() {
    let mesh = slab(dvec3(4.0, 1.0, 2.0), 3);
    let options = FurOptions { strands: 900, color: true, ..FurOptions::default() };
    let groom = grown(&mesh, &options);
    let figures = Statistics::of(&groom);
    assert_eq!((figures.non_finite_points, figures.zero_length_segments), (0, 0));
    assert!((0..900).all(|s| groom.strand_range(s).all(|v| groom.radii().get(s, v) > 0.0)));
    assert!(groom.colors().is_some());
    assert_eq!(groom, grown(&mesh, &options));
    assert_ne!(groom, grown(&mesh, &FurOptions { seed: 2, ..options }));
}

/// Straight up, without anything that bends strands: the normal, and the length asked for.
#[test]
fn without_lean_strands_stand_on_the_skin() {
    let mesh = slab(dvec3(2.0, 2.0, 2.0), 2);
    let options = FurOptions {
        strands: 600,
        lean: 0.0,
        curl: 0.0,
        clump: 0.0,
        variation: 0.0,
        thin: 0.0,
        ..FurOptions::default()
    };
    let groom = grown(&mesh, &options);
    let length = options.length * 12f32.sqrt();
    for strand in groom.strands() {
        let (root, tip) = (strand[0], strand[7]);
        let face = root.abs().max_position();
        assert!((tip[face].abs() - 1.0 - length).abs() < 0.02 * length, "{root} {tip}");
        let whole: f32 = strand.windows(2).map(|p| p[0].distance(p[1])).sum();
        assert!((whole - length).abs() < 1e-4 * length);
    }
}

#[test]
fn fur_lies_where_it_is_told_and_keeps_off_the_skin() {
    let mesh = slab(dvec3(2.0, 2.0, 2.0), 2);
    for towards in [Vec3::NEG_Z, Vec3::new(1.0, 0.5, 0.0)] {
        let groom = grown(&mesh, &FurOptions { strands: 600, towards, ..FurOptions::default() });
        // Where the skin faces along the direction there is nowhere to lie to.
        let beside = |s: &&[Vec3]| s[0].abs()[towards.abs().max_position()] < 0.99;
        let lies = |s: &[Vec3]| (s[7] - s[0]).normalize().dot(towards.normalize());
        for strand in groom.strands().filter(beside) {
            assert!(lies(strand) > 0.1, "{towards}: {} from {} to {}", lies(strand), strand[0], strand[7]);
        }
        let inside = groom.positions().iter().filter(|p| p.abs().max_element() < 0.999).count();
        assert!(inside < groom.point_count() / 500, "{inside}");
    }
}

#[test]
fn thin_places_have_short_fur() {
    let length = |groom: &Groom| -> f32 {
        let of = |s: &[Vec3]| s.windows(2).map(|p| p[0].distance(p[1])).sum::<f32>();
        groom.strands().map(of).sum::<f32>() / groom.strand_count() as f32
    };
    let even = FurOptions { strands: 600, thin: 0.0, curl: 0.0, clump: 0.0, ..FurOptions::default() };
    let (thick, thin) = (slab(dvec3(2.0, 2.0, 2.0), 2), slab(dvec3(2.0, 0.02, 2.0), 2));
    let shorter =
        |mesh| length(&grown(mesh, &FurOptions { thin: 1.0, ..even })) / length(&grown(mesh, &even));
    let (full, short) = (shorter(&thick), shorter(&thin));
    assert!((full - 1.0).abs() < 0.02 && short < 0.15, "{full} {short}");
}

#[test]
fn what_nothing_can_grow_on_is_refused() {
    let good = slab(DVec3::ONE, 1);
    let options = FurOptions { strands: 10, ..FurOptions::default() };
    let refused = |mesh: &Mesh| matches!(fur_on(&mesh.surface(), &options), Err(SampleError::Surface { .. }));
    let with = |positions: Vec<DVec3>, triangles| {
        let normals = vec![Vec3::Y; positions.len()];
        Mesh { positions, triangles, normals }
    };
    assert!(!refused(&good));
    assert!(refused(&with(vec![], vec![])));
    assert!(refused(&with(vec![DVec3::ONE; 3], vec![[0, 1, 2]])));
    assert!(refused(&with(good.positions.clone(), vec![[0, 1, 99]])));
    assert!(refused(&with(vec![DVec3::X, DVec3::Y, DVec3::NAN], vec![[0, 1, 2]])));
    assert!(refused(&with(vec![DVec3::X, DVec3::Y, DVec3::splat(1e39)], vec![[0, 1, 2]])));
    let normals = FurSurface { normals: Some(&[Vec3::Y]), ..good.surface() };
    assert!(fur_on(&normals, &options).is_err());
    for bad in [
        FurOptions { strands: 0, ..options },
        FurOptions { points: 1, ..options },
        FurOptions { length: 0.0, ..options },
        FurOptions { length: f32::NAN, ..options },
        FurOptions { lean: 1.5, ..options },
        FurOptions { thin: -0.1, ..options },
        FurOptions { towards: Vec3::ZERO, ..options },
    ] {
        let Err(told) = fur_on(&good.surface(), &bad) else { panic!("accepted: {bad:?}") };
        assert!(told.to_string().contains("expected"), "{told}");
    }
}
