//! Where strands are bound.

use glam::{DVec3, Vec2, Vec3};
use groom::{Attribute, Domain, Groom, Values, names, random};
use groom_binding::{
    Beyond, BindBy, BindOptions, BindReport, Binding, BindingError, ROOT_TRIANGLE, RootFrames, Surface,
    carry_rigid,
};
use moving_mesh::Pose;

use crate::shapes::{Mesh, egg};
use crate::strands;

fn bind(groom: &Groom, mesh: &Mesh, options: &BindOptions) -> (Binding, BindReport) {
    Binding::new(groom, &mesh.surface(), options).unwrap()
}

fn roots(points: &[Vec3]) -> Groom {
    Groom::new((0..=points.len() as u32).collect(), points.to_vec()).unwrap()
}

fn place(mesh: &Mesh, triangle: u32, weights: DVec3) -> DVec3 {
    let [a, b, c] = mesh.triangles[triangle as usize].map(|v| mesh.rest.positions[v as usize]);
    weights.x * a + weights.y * b + weights.z * c
}

/// Every triangle is asked, on a lattice of points: none is nearer than what the tree found.
#[test]
fn no_triangle_is_nearer() {
    let mesh = egg(7, 11);
    let groom = strands(300, 0.9, 5);
    let (binding, report) = bind(&groom, &mesh, &BindOptions::default());
    let lattice: Vec<DVec3> = (0..=8)
        .flat_map(|i| {
            (0..=8 - i).map(move |j| DVec3::new(f64::from(i), f64::from(j), f64::from(8 - i - j)) / 8.0)
        })
        .collect();
    for (strand, root) in binding.roots().iter().enumerate() {
        let from = groom.strand(strand)[0].as_dvec3();
        let at = place(&mesh, root.triangle, root.barycentrics);
        assert!((at.distance(from) - root.height.abs()).abs() < 1e-14);
        for triangle in 0..mesh.triangles.len() as u32 {
            for &weights in &lattice {
                let other = place(&mesh, triangle, weights).distance(from);
                assert!(root.height.abs() <= other + 1e-12, "strand {strand}, triangle {triangle}");
            }
        }
        // The egg is convex: inside is negative.
        let inside = mesh.triangles.iter().all(|t| {
            let [a, b, c] = t.map(|v| mesh.rest.positions[v as usize]);
            (b - a).cross(c - a).dot(from - a) < 0.0
        });
        assert_eq!(root.height < 0.0, inside, "strand {strand}: {}", root.height);
    }
    assert_eq!((report.strands, report.without_frame), (300, 0));
    assert!(report.distances.is_sorted() && report.kept.is_none());
    let most = binding.roots().iter().map(|root| root.height.abs()).fold(0.0, f64::max);
    assert_eq!(report.distance_at(1.0), Some(most));
    let size = (4.0f64 + 4.0 + 2.6 * 2.6).sqrt();
    assert!((report.mesh_size / size - 1.0).abs() < 0.05, "{} {size}", report.mesh_size);
}

#[test]
fn on_vertices_and_edges_the_first_triangle_counts() {
    let mesh = egg(8, 12);
    let exact = |p: DVec3| p.as_vec3().as_dvec3();
    let mut mesh = mesh;
    mesh.rest.positions.iter_mut().for_each(|p| *p = exact(*p));
    let points: Vec<Vec3> = mesh.rest.positions.iter().map(|p| p.as_vec3()).collect();
    let (binding, report) = bind(&roots(&points), &mesh, &BindOptions::default());
    assert!(report.distance_at(1.0).unwrap() < 1e-15);
    for (vertex, root) in binding.roots().iter().enumerate() {
        let at = mesh.rest.positions[vertex];
        let touches = |t: &[u32; 3]| t.iter().any(|&v| mesh.rest.positions[v as usize] == at);
        let first = mesh.triangles.iter().position(touches).unwrap();
        assert_eq!(root.triangle as usize, first, "vertex {vertex}");
        assert_eq!(root.barycentrics.max_element(), 1.0);
    }
}

#[test]
fn the_number_of_threads_changes_nothing() {
    let (mesh, groom) = (egg(20, 30), strands(3000, 0.4, 9));
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let (binding, report) = bind(&groom, &mesh, &BindOptions::default());
            let mut frames = RootFrames::new(&binding, mesh.surface()).unwrap();
            frames.follow(&mesh.posed(|p| p * p.length())).unwrap();
            let mut out = Vec::new();
            carry_rigid(&groom, &frames, DVec3::ZERO, &mut out).unwrap();
            (binding, report, out)
        })
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn a_limit_keeps_snaps_or_drops() {
    let (mesh, groom) = (egg(10, 14), strands(400, 0.5, 2));
    let options = |beyond| BindOptions { limit: Some(0.2), beyond, ..BindOptions::default() };
    let (all, report) = bind(&groom, &mesh, &options(Beyond::Keep));
    let far = |strand: &u32| all.roots()[*strand as usize].height.abs() > 0.2;
    let expected: Vec<u32> = (0..400).filter(far).collect();
    assert!(expected.len() > 50 && report.beyond == expected && report.kept.is_none());
    assert_eq!(all, bind(&groom, &mesh, &BindOptions::default()).0);

    let (snapped, report) = bind(&groom, &mesh, &options(Beyond::Snap));
    assert_eq!(report.beyond, expected);
    let mut frames = RootFrames::new(&snapped, mesh.surface()).unwrap();
    let at_rest: Vec<_> = frames.motions().collect();
    frames.follow(&mesh.rest).unwrap();
    for (before, after) in at_rest.iter().zip(frames.motions()) {
        assert!(before.turn.abs_diff_eq(after.turn, 1e-14), "new frames are those of the rest pose");
        assert_eq!(before.to, after.to);
    }
    for (strand, motion) in at_rest.iter().enumerate() {
        let root = snapped.roots()[strand];
        let at = motion.apply(groom.strand(strand)[0].as_dvec3());
        let height = at.distance(place(&mesh, root.triangle, root.barycentrics));
        let expected = if far(&(strand as u32)) { 0.0 } else { all.roots()[strand].height.abs() };
        assert!((height - expected).abs() < 1e-14, "strand {strand}");
    }

    let (some, report) = bind(&groom, &mesh, &options(Beyond::Drop));
    let kept = report.kept.unwrap();
    assert_eq!((kept.len(), some.strand_count()), (400 - expected.len(), 400 - expected.len()));
    assert!(some.check(&groom, &mesh.surface()).is_err());
    let fewer = groom.keep_strands(&kept).unwrap();
    some.check(&fewer, &mesh.surface()).unwrap();
    assert_eq!(some, bind(&fewer, &mesh, &BindOptions::default()).0);
}

#[test]
fn by_texture_coordinate() {
    let mesh = egg(10, 14);
    let mut groom = strands(300, 0.3, 4);
    let uvs: Vec<Vec2> =
        (0..300).map(|s| Vec2::new(random(1, s, "u"), 0.2 + 0.6 * random(1, s, "v"))).collect();
    let values = Values::Vec2(uvs.clone());
    groom.set_attribute(names::ROOT_UV, Attribute { domain: Domain::Strand, values }).unwrap();
    let options = BindOptions { by: BindBy::RootUv, ..BindOptions::default() };
    let (binding, report) = bind(&groom, &mesh, &options);
    assert!(report.ambiguous.is_empty() && report.outside.is_empty());
    for (root, uv) in binding.roots().iter().zip(&uvs) {
        let [a, b, c] = mesh.triangles[root.triangle as usize].map(|v| mesh.uvs[v as usize]);
        let w = root.barycentrics.as_vec3();
        assert!((w.x * a + w.y * b + w.z * c).distance(*uv) < 1e-6);
    }
    // The same texture twice: the half that a strand is nearer to counts, and it is told.
    let mut twice = mesh.clone();
    twice.uvs.iter_mut().for_each(|uv| uv.x = (2.0 * uv.x) % 1.0);
    for t in &twice.triangles {
        // No triangle may lie across the place where the halves meet.
        let u = t.map(|v| twice.uvs[v as usize].x);
        let wraps = u.contains(&0.0) && u.iter().any(|&u| u > 0.5);
        if wraps {
            for (&v, u) in t.iter().zip(u) {
                if u == 0.0 {
                    twice.uvs[v as usize].x = 1.0;
                }
            }
        }
    }
    let (binding, report) = bind(&groom, &twice, &options);
    assert!(report.ambiguous.len() > 200, "{}", report.ambiguous.len());
    for &strand in &report.ambiguous {
        let root = binding.roots()[strand as usize];
        let at = groom.strand(strand as usize)[0].as_dvec3();
        let here = place(&twice, root.triangle, root.barycentrics);
        let opposite = DVec3::new(-here.x, here.y, -here.z);
        assert!(here.distance(at) <= opposite.distance(at) + 0.05, "strand {strand}");
    }
    // Outside all triangles.
    let values = Values::Vec2(vec![Vec2::new(0.5, 1.5); 300]);
    groom.set_attribute(names::ROOT_UV, Attribute { domain: Domain::Strand, values }).unwrap();
    assert_eq!(bind(&groom, &mesh, &options).1.outside.len(), 300);
}

#[test]
fn by_given_triangle() {
    let mesh = egg(6, 8);
    let mut groom = strands(50, 0.3, 8);
    let given: Vec<i32> = (0..50).collect();
    let set = |groom: &mut Groom, values| {
        groom.set_attribute(ROOT_TRIANGLE, Attribute { domain: Domain::Strand, values }).unwrap();
    };
    set(&mut groom, Values::Int(given.clone()));
    let options = BindOptions { by: BindBy::RootTriangle, ..BindOptions::default() };
    let (binding, _) = bind(&groom, &mesh, &options);
    assert!(binding.roots().iter().zip(given).all(|(root, given)| root.triangle == given as u32));
    set(&mut groom, Values::Int([vec![0; 49], vec![mesh.triangles.len() as i32]].concat()));
    let error = Binding::new(&groom, &mesh.surface(), &options).unwrap_err().to_string();
    assert_eq!(error, "strand 49: root_triangle 80, expected 0 or more, less than 80");
    set(&mut groom, Values::Float(vec![0.0; 50]));
    let error = Binding::new(&groom, &mesh.surface(), &options).unwrap_err().to_string();
    assert_eq!(error, "attribute `root_triangle`: float per strand, expected one int a strand, to bind by");
}

#[test]
fn what_cannot_be_bound_is_refused() {
    let (mesh, groom) = (egg(6, 8), strands(20, 0.1, 1));
    let check = |groom: &Groom, mesh: &Mesh, options: &BindOptions, words: &str| {
        let error = Binding::new(groom, &mesh.surface(), options).unwrap_err().to_string();
        assert_eq!(error, words);
    };
    let plain = BindOptions::default();
    for (limit, found) in [(-1.0, "-1"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let options = BindOptions { limit: Some(limit), ..plain };
        check(&groom, &mesh, &options, &format!("limit is {found}, expected a finite distance, 0 or more"));
    }
    let mut broken = mesh.clone();
    broken.triangles[7] = [0, 1, 63];
    check(&groom, &broken, &plain, "triangle 7: vertices [0, 1, 63], expected less than 63");
    let mut broken = mesh.clone();
    broken.rest.positions[5].y = f64::NAN;
    let at = broken.rest.positions[5];
    check(&groom, &broken, &plain, &format!("vertex 5: {at}, expected finite numbers"));
    let mut broken = mesh.clone();
    broken.uvs.pop();
    check(&groom, &broken, &plain, "texture coordinates: 62 of them, expected one a vertex: 63");
    let mut broken = groom.clone();
    broken.positions_mut()[1].x = f32::INFINITY;
    let at = broken.positions()[1];
    check(&broken, &mesh, &plain, &format!("strand 1, point 0: {at}, expected finite numbers"));
    let none = Mesh { triangles: vec![], ..mesh.clone() };
    check(&groom, &none, &plain, "mesh: no triangle, expected one or more, to bind strands to");
    let by_uv = BindOptions { by: BindBy::RootUv, ..plain };
    check(&groom, &mesh, &by_uv, "attribute `root_uv`: not there, expected one vec2 a strand, to bind by");
    let bare = Surface { uvs: None, ..mesh.surface() };
    let error = Binding::new(&groom, &bare, &by_uv).unwrap_err().to_string();
    assert_eq!(error, "mesh: no texture coordinates, expected one a vertex, to bind by");
}

#[test]
fn another_mesh_or_pose_is_refused() {
    let (mesh, groom) = (egg(6, 8), strands(20, 0.1, 1));
    let (binding, _) = bind(&groom, &mesh, &BindOptions::default());
    let mut other = mesh.clone();
    other.triangles[3].rotate_left(1);
    assert!(matches!(RootFrames::new(&binding, other.surface()), Err(BindingError::Invalid { .. })));
    let mut frames = RootFrames::new(&binding, mesh.surface()).unwrap();
    let before = frames.frames().to_vec();
    let short = Pose { positions: mesh.rest.positions[1..].to_vec(), normals: None };
    let error = frames.follow(&short).unwrap_err().to_string();
    assert_eq!(error, "pose: 62 vertices, expected as many as at rest: 63");
    let mut broken = mesh.rest.clone();
    broken.positions[9].z = f64::NAN;
    assert!(frames.follow(&broken).is_err());
    assert_eq!(frames.frames(), before);
    let error = carry_rigid(&strands(19, 0.1, 1), &frames, DVec3::ZERO, &mut Vec::new()).unwrap_err();
    assert_eq!(error.to_string(), "groom: 19 strands, expected as many as are bound: 20");
}

#[test]
fn nothing_is_bound_to_nothing() {
    let empty = Groom::new(vec![0], vec![]).unwrap();
    let nothing = Mesh { triangles: vec![], rest: Pose::default(), uvs: vec![] };
    for mesh in [&nothing, &egg(4, 5)] {
        for by in [BindBy::Nearest, BindBy::RootUv, BindBy::RootTriangle] {
            let (binding, report) = bind(&empty, mesh, &BindOptions { by, ..BindOptions::default() });
            assert_eq!((binding.strand_count(), report.strands, report.distance_at(0.5)), (0, 0, None));
            let mut frames = RootFrames::new(&binding, mesh.surface()).unwrap();
            frames.follow(&mesh.rest).unwrap();
            let mut out = vec![Vec3::ZERO; 3];
            carry_rigid(&empty, &frames, DVec3::ZERO, &mut out).unwrap();
            assert!(out.is_empty());
        }
    }
}
