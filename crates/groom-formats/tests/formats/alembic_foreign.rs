//! Alembic as other programs write it: transforms, cubic curves, indices, several objects; and files that lie.

#![allow(clippy::unwrap_used, clippy::panic)] // tests fail by panicking

use std::io::Cursor;

use crate::support::from_bytes;
use glam::{DVec3, Vec2, Vec3};
use groom::{Attribute, Domain, Values, names};
use groom_formats::{Format, Loaded, ReadOptions, Warning};
use ogawa::{ArchiveWriter, Compound, DataType, Metadata, Object, Pod, Property, TimeSampling};

type File = ArchiveWriter<Cursor<Vec<u8>>>;

fn archive(build: impl FnOnce(&mut File, &mut Object)) -> Vec<u8> {
    let mut file = ArchiveWriter::new(Cursor::new(Vec::new())).unwrap();
    let mut top = Object::top();
    build(&mut file, &mut top);
    file.finish(&top, &Metadata::new()).unwrap().into_inner()
}

fn array<T: ogawa::Value>(
    file: &mut File,
    name: &str,
    data_type: DataType,
    scope: &str,
    values: &[T],
) -> Property {
    let words = Metadata::new().with("geoScope", scope);
    Property::array(name, data_type, words).with(file.values(values).unwrap())
}

/// A Curves object of points, counts, `[type, wrap, basis]` and other properties of its geometry.
fn curves(
    file: &mut File,
    name: &str,
    points: &[[f32; 3]],
    counts: &[i32],
    kind: [u8; 3],
    others: Vec<Property>,
) -> Object {
    let words = Metadata::new().with("schema", "AbcGeom_Curve_v2");
    let mut geometry = Compound::new();
    geometry.push(array(file, "P", DataType::F32X3, "vtx", points.as_flattened()));
    geometry.push(array(file, "nVertices", DataType::I32, "", counts));
    let kind = file.values(&[kind[0], kind[1], kind[2], kind[2]]).unwrap();
    let property = Property::scalar("curveBasisAndType", DataType::new(Pod::U8, 4), Metadata::new());
    geometry.push(property.with(kind));
    others.into_iter().for_each(|property| geometry.push(property));
    let mut object = Object::new(name, words.clone());
    object.properties.push(Property::compound(".geom", words, geometry));
    object
}

/// A transform of operations, with their numbers at each time.
fn xform(
    file: &mut File,
    name: &str,
    ops: &[u8],
    vals: &[&[f64]],
    times: u32,
    inherits: Option<u8>,
) -> Object {
    let words = Metadata::new().with("schema", "AbcGeom_Xform_v3");
    let mut compound = Compound::new();
    if let Some(inherits) = inherits {
        let property = Property::scalar(".inherits", DataType::new(Pod::Bool, 1), Metadata::new());
        compound.push(property.with(file.values(&[inherits]).unwrap()));
    }
    let property = Property::scalar(".ops", DataType::new(Pod::U8, ops.len() as u8), Metadata::new());
    compound.push(property.with(file.values(ops).unwrap()));
    let count = vals[0].len() as u8;
    let mut property = Property::scalar(".vals", DataType::new(Pod::F64, count), Metadata::new()).at(times);
    vals.iter().for_each(|vals| property.push(file.values(vals).unwrap()));
    compound.push(property);
    let mut object = Object::new(name, words.clone());
    object.properties.push(Property::compound(".xform", words, compound));
    object
}

fn read(bytes: &[u8]) -> Loaded {
    from_bytes(Format::Alembic, bytes).unwrap()
}

fn refused(bytes: &[u8], words: &str) {
    let error = from_bytes(Format::Alembic, bytes).unwrap_err().to_string();
    assert!(error.contains(words), "{error}");
}

fn read_with(bytes: &[u8], options: &ReadOptions) -> Loaded {
    groom_formats::read_from(Format::Alembic, bytes, "memory", options).unwrap()
}

const LINES: [u8; 3] = [1, 0, 0];
const SCALE: u8 = 0;
const MOVE: u8 = 1 << 4;
const ROTATE: u8 = 2 << 4 | 3; // with a hint
const MATRIX: u8 = 3 << 4;
const ROTATE_Z: u8 = 6 << 4;

#[test]
fn transforms_move_points_radii_and_velocities() {
    for inherits in [None, Some(1), Some(0)] {
        let bytes = archive(|file, top| {
            let width = array(file, "width", DataType::F32, "con", &[1.0_f32]);
            let velocities =
                array(file, ".velocities", DataType::F32X3, "", &[1.0_f32, 0.0, 0.0, 0.0, 0.0, 0.0]);
            let points = [[1.0, 0.0, 0.0], [0.0, 0.0, 0.0]];
            let hair = curves(file, "hair", &points, &[2], LINES, vec![width, velocities]);
            let mut turn = xform(file, "turn", &[ROTATE], &[&[0.0, 0.0, 2.0, 90.0]], 0, inherits);
            turn.children.push(hair);
            let mut outer =
                xform(file, "outer", &[MOVE, SCALE], &[&[1.0, 2.0, 3.0, 2.0, 2.0, 2.0]], 0, Some(1));
            outer.children.push(turn);
            top.children.push(outer);
        });
        let groom = read(&bytes).groom;
        let (point, root, radius, velocity) = match inherits {
            Some(0) => (Vec3::new(0.0, 1.0, 0.0), Vec3::ZERO, 0.5, Vec3::Y),
            _ => (Vec3::new(1.0, 4.0, 3.0), Vec3::new(1.0, 2.0, 3.0), 1.0, Vec3::new(0.0, 2.0, 0.0)),
        };
        let near = |a: Vec3, b: Vec3| assert!((a - b).length() < 1e-6, "{a} {b} {inherits:?}");
        near(groom.positions()[0], point);
        near(groom.positions()[1], root);
        assert!((groom.radii().get(0, 0) - radius).abs() < 1e-6);
        let Some(Values::Vec3(velocities)) = groom.attribute(names::VELOCITY).map(|a| &a.values) else {
            panic!()
        };
        near(velocities[0], velocity);
    }
}

#[test]
fn moving_transforms_have_times() {
    let bytes = archive(|file, top| {
        let times = file.add_times(TimeSampling::uniform(1.0 / 24.0, 1.0 / 24.0));
        let hair = curves(file, "hair", &[[0.0; 3], [0.0, 1.0, 0.0]], &[2], LINES, vec![]);
        let matrix = |x: f64| {
            let mut matrix = [0.0; 16];
            [0, 5, 10, 15].into_iter().for_each(|i| matrix[i] = 1.0);
            matrix[12] = x;
            matrix
        };
        let mut moving = xform(
            file,
            "m",
            &[MATRIX, ROTATE_Z],
            &[&[&matrix(1.0)[..], &[0.0]].concat(), &[&matrix(2.0)[..], &[0.0]].concat()],
            times,
            None,
        );
        moving.children.push(hair);
        top.children.push(moving);
    });
    let loaded = read(&bytes);
    assert_eq!((loaded.times, loaded.frame_rate), (vec![1.0, 2.0], Some(24.0)));
    for (time, x) in [(None, 1.0), (Some(1.0), 1.0), (Some(1.5), 1.5), (Some(2.0), 2.0)] {
        let loaded = read_with(&bytes, &ReadOptions { time, ..ReadOptions::default() });
        assert_eq!(loaded.groom.positions(), [Vec3::new(x, 0.0, 0.0), Vec3::new(x, 1.0, 0.0)]);
    }
}

/// Control points of a curve that bends in space.
const BENT: [[f32; 3]; 7] = [
    [0.0, 0.0, 0.0],
    [1.0, 2.0, 0.0],
    [3.0, 2.0, 1.0],
    [4.0, 0.0, 1.0],
    [5.0, -2.0, 1.0],
    [6.0, -1.0, 3.0],
    [7.0, 0.0, 0.0],
];

/// The curve by its definition: the sum of four points, each times a cubic in t.
fn definition(basis: u8, p: [DVec3; 4], t: f64) -> DVec3 {
    let (t2, t3) = (t * t, t * t * t);
    let w = match basis {
        1 => [1.0 - 3.0 * t + 3.0 * t2 - t3, 3.0 * t - 6.0 * t2 + 3.0 * t3, 3.0 * t2 - 3.0 * t3, t3],
        2 => [
            (1.0 - 3.0 * t + 3.0 * t2 - t3) / 6.0,
            (4.0 - 6.0 * t2 + 3.0 * t3) / 6.0,
            (1.0 + 3.0 * t + 3.0 * t2 - 3.0 * t3) / 6.0,
            t3 / 6.0,
        ],
        _ => [
            (-t + 2.0 * t2 - t3) / 2.0,
            (2.0 - 5.0 * t2 + 3.0 * t3) / 2.0,
            (t + 4.0 * t2 - 3.0 * t3) / 2.0,
            (-t2 + t3) / 2.0,
        ],
    };
    p.iter().zip(w).map(|(&p, w)| p * w).sum()
}

fn distance(strand: &[Vec3], point: DVec3) -> f64 {
    let segments = strand.windows(2).map(|pair| {
        let (a, b) = (pair[0].as_dvec3(), pair[1].as_dvec3());
        let t = ((point - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        point.distance(a.lerp(b, t))
    });
    segments.fold(f64::INFINITY, f64::min)
}

#[test]
fn cubic_curves_become_polylines_within_the_error() {
    let points = BENT.map(|p| Vec3::from(p).as_dvec3());
    // Catmull-Rom curves go through all their points: one more lies beyond each end.
    let beyond = [2.0 * points[0] - points[1], 2.0 * points[6] - points[5]];
    for (basis, step) in [(1, 3), (2, 1), (3, 1)] {
        for error in [0.3_f32, 0.01, 0.001] {
            let bytes = archive(|file, top| {
                let width =
                    array(file, "width", DataType::F32, "vtx", &[0.0_f32, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
                top.children.push(curves(file, "hair", &BENT, &[7], [0, 0, basis], vec![width]));
            });
            let options = ReadOptions { curve_error: Some(error), ..ReadOptions::default() };
            let groom = read_with(&bytes, &options).groom;
            let mut through = points.to_vec();
            if basis == 3 {
                through.insert(0, beyond[0]);
                through.push(beyond[1]);
            }
            let mut worst = 0.0_f64;
            for span in through.windows(4).step_by(step) {
                let span: [DVec3; 4] = span.try_into().unwrap();
                for t in 0..=50 {
                    worst =
                        worst.max(distance(groom.strand(0), definition(basis, span, f64::from(t) / 50.0)));
                }
            }
            assert!(worst <= f64::from(error) + 1e-6, "basis {basis}: {worst} over {error}");
            let (first, last) = (groom.positions()[0], *groom.positions().last().unwrap());
            let ends = if basis == 2 {
                let end = |a: usize, b: usize, c: usize| (points[a] + 4.0 * points[b] + points[c]) / 6.0;
                (end(0, 1, 2), end(4, 5, 6))
            } else {
                (points[0], points[6])
            };
            assert!(
                (first.as_dvec3() - ends.0).length() < 1e-6 && (last.as_dvec3() - ends.1).length() < 1e-6
            );
            let radius = groom.radii().get(0, groom.point_count() - 1);
            assert!((radius - if basis == 2 { 2.5 } else { 3.0 }).abs() < 1e-6, "{radius}");
        }
    }
}

#[test]
fn wraps_knots_and_orders() {
    let one = |kind, others: fn(&mut File) -> Vec<Property>| {
        archive(|file, top| {
            let others = others(file);
            top.children.push(curves(file, "hair", &BENT[..4], &[4], kind, others));
        })
    };
    let closed = read(&one([1, 1, 0], |_| vec![])).groom;
    assert_eq!(closed.positions().len(), 5);
    assert_eq!(closed.positions()[0], closed.positions()[4]);
    // Clamped knots: a B-spline that reaches its ends.
    let clamped =
        read(&one([0, 0, 2], |file| vec![array(file, ".knots", DataType::F32, "", &[0.0_f32; 8])])).groom;
    assert_eq!(*clamped.positions().last().unwrap(), Vec3::from(BENT[3]));
    let uniform = |file: &mut File| {
        let knots: Vec<f32> = (0..8).map(|i| i as f32).collect();
        vec![array(file, ".knots", DataType::F32, "", &knots)]
    };
    let open = read(&one([0, 0, 2], uniform)).groom;
    assert!(open.positions().last().unwrap().distance(Vec3::from(BENT[3])) > 0.1);
    let lines = read(&one([2, 0, 2], |file| vec![array(file, ".orders", DataType::U8, "", &[2_u8])])).groom;
    assert_eq!(lines.positions(), BENT[..4].iter().map(|&p| Vec3::from(p)).collect::<Vec<_>>());
    // Blender's Catmull-Rom curves say linear, or several orders and none of them; a basis left over from the
    // library's own default bends no line.
    let no_orders = |file: &mut File| vec![array::<u8>(file, ".orders", DataType::U8, "", &[])];
    for (kind, bent) in [([1, 0, 3], true), ([2, 0, 3], true), ([1, 0, 1], false), ([2, 0, 0], false)] {
        let points = read(&one(kind, no_orders)).groom.point_count();
        assert_eq!(points > 4, bent, "{kind:?}: {points}");
    }
    refused(
        &one([2, 0, 2], |file| vec![array(file, ".orders", DataType::U8, "", &[3_u8])]),
        "/hair.orders: found",
    );
    refused(&one([0, 0, 4], |_| vec![]), "/hair.curveBasisAndType: found hermite curves");
    let three = archive(|file, top| {
        top.children.push(curves(file, "hair", &BENT[..3], &[3], [0, 0, 1], vec![]));
    });
    refused(&three, "found 3 points of curve 0, expected 4 or more for bezier curves");
}

#[test]
fn parameters_of_any_kind_become_attributes() {
    let bytes = archive(|file, top| {
        let points = [[0.0; 3], [0.0, 1.0, 0.0], [1.0; 3], [1.0, 2.0, 1.0], [1.0, 3.0, 1.0]];
        let mut indexed = Compound::new();
        indexed.push(array(file, ".vals", DataType::F32X2, "uni", &[0.5_f32, 0.25, 1.0, 0.0]));
        indexed.push(array(file, ".indices", DataType::U32, "uni", &[1_u32, 0]));
        let words = Metadata::new().with("geoScope", "uni");
        let uv = Property::compound("uv", words, indexed);
        let mut arbitrary = Compound::new();
        arbitrary.push(array(
            file,
            "Cd",
            DataType::new(Pod::F64, 3),
            "uni",
            &[1.0_f64, 0.5, 0.25, 0.0, 0.0, 0.0],
        ));
        arbitrary.push(array(file, "groom_guide", DataType::new(Pod::I8, 1), "uni", &[1_i8, 0]));
        arbitrary.push(array(file, "half", DataType::new(Pod::F16, 1), "", &[0x3c00_u16, 0, 0, 0, 0xc000]));
        arbitrary.push(array(
            file,
            "groom_closest_guides",
            DataType::new(Pod::I32, 3),
            "uni",
            &[1, 2, 3, 4, 5, 6],
        ));
        arbitrary.push(array(file, "misfit", DataType::F32, "vtx", &[1.0_f32; 3]));
        arbitrary.push(array(file, "rgba", DataType::new(Pod::F32, 4), "uni", &[1.0_f32; 8]));
        arbitrary.push(array(file, "large", DataType::new(Pod::I64, 1), "con", &[1_i64 << 40]));
        let names = file.texts(&["scalp", "brow"]).unwrap();
        let of_names = Metadata::new().with("geoScope", "uni");
        arbitrary.push(Property::array("groom_group_name", DataType::STRING, of_names).with(names));
        let arbitrary = Property::compound(".arbGeomParams", Metadata::new(), arbitrary);
        let width = array(file, "width", DataType::F32, "uni", &[1.0_f32, 2.0]);
        top.children.push(curves(file, "hair", &points, &[2, 3], LINES, vec![uv, width, arbitrary]));
    });
    let Loaded { groom, warnings, .. } = read(&bytes);
    let attribute = |name: &str, domain, values| {
        assert_eq!(groom.attribute(name), Some(&Attribute { domain, values }), "{name}");
    };
    attribute(names::ROOT_UV, Domain::Strand, Values::Vec2(vec![Vec2::new(1.0, 0.0), Vec2::new(0.5, 0.25)]));
    attribute(names::COLOR, Domain::Strand, Values::Vec3(vec![Vec3::new(1.0, 0.5, 0.25), Vec3::ZERO]));
    attribute(names::GUIDE, Domain::Strand, Values::Int(vec![1, 0]));
    attribute(names::RADIUS, Domain::Strand, Values::Float(vec![0.5, 1.0]));
    attribute("half", Domain::Vertex, Values::Float(vec![1.0, 0.0, 0.0, 0.0, -2.0]));
    let guides = vec![Vec3::new(1.0, 2.0, 3.0), Vec3::new(4.0, 5.0, 6.0)];
    attribute("groom_closest_guides", Domain::Strand, Values::Vec3(guides));
    let not_read: Vec<&str> = warnings
        .iter()
        .map(|warning| match warning {
            Warning::AttributeNotRead { name, .. } => name.as_str(),
            other => panic!("{other}"),
        })
        .collect();
    assert_eq!(not_read, ["misfit", "rgba", "large", "groom_group_name"]);
    assert_eq!(groom.attributes().count(), 6);
}

#[test]
fn several_objects_are_one_groom_of_groups() {
    let bytes = archive(|file, top| {
        let width = array(file, "width", DataType::F32, "con", &[1.0_f32]);
        let first = curves(file, "scalp", &[[0.0; 3], [1.0; 3]], &[2], LINES, vec![width]);
        let width = array(file, "width", DataType::F32, "vtx", &[2.0_f32, 4.0, 6.0]);
        let second = curves(file, "brow", &[[2.0; 3], [3.0; 3], [4.0; 3]], &[1, 2], LINES, vec![width]);
        top.children = vec![first, Object::new("camera", Metadata::new()), second];
    });
    let groom = read(&bytes).groom;
    assert_eq!(groom.offsets(), [0, 2, 3, 5]);
    let group = Attribute { domain: Domain::Strand, values: Values::Int(vec![0, 1, 1]) };
    assert_eq!(groom.attribute(names::GROUP), Some(&group));
    let radius = Attribute { domain: Domain::Vertex, values: Values::Float(vec![0.5, 0.5, 1.0, 2.0, 3.0]) };
    assert_eq!(groom.attribute(names::RADIUS), Some(&radius));
}

#[test]
fn curves_without_points_are_no_strands() {
    let bytes = archive(|file, top| {
        let width = array(file, "width", DataType::F32, "uni", &[1.0_f32, 2.0, 3.0]);
        top.children.push(curves(file, "hair", &[[0.0; 3], [1.0; 3]], &[1, 0, 1], LINES, vec![width]));
    });
    let Loaded { groom, warnings, .. } = read(&bytes);
    assert_eq!(warnings, [Warning::EmptyStrandsLeftOut { format: Format::Alembic, strands: 1 }]);
    assert_eq!((groom.strand_count(), groom.strand_id(1)), (2, 2));
    assert_eq!(groom.radii().get(1, 1), 1.5);
}

#[test]
fn counts_that_lie_are_refused() {
    for (counts, words) in [
        (&[2, 2][..], "/hair.nVertices: found counts that add up to 4, expected 3, the points there are"),
        (&[4, -1], "/hair.nVertices: found -1 points of curve 1, expected 0 or more"),
        (&[i32::MAX, i32::MAX], "found counts that add up to 4294967294"),
    ] {
        let bytes = archive(|file, top| {
            top.children.push(curves(file, "hair", &[[0.0; 3]; 3], counts, LINES, vec![]));
        });
        refused(&bytes, words);
    }
    refused(&archive(|_, _| {}), "found no curves, expected one or more objects");
}

#[test]
fn a_small_file_makes_no_large_groom() {
    let bytes = archive(|file, top| {
        let large: Vec<f32> = (0..30_000).map(|i| i as f32).collect();
        let mut arbitrary = Compound::new();
        for i in 0..200 {
            arbitrary.push(array(file, &format!("a{i}"), DataType::F32, "vtx", &large));
        }
        let arbitrary = Property::compound(".arbGeomParams", Metadata::new(), arbitrary);
        let points = vec![[0.0; 3]; 30_000];
        top.children.push(curves(file, "hair", &points, &[30_000], LINES, vec![arbitrary]));
    });
    assert!(bytes.len() < 600_000, "the same array stands once");
    refused(&bytes, "4 times the file in all");
}

/// A file of objects that have a header and nothing else, and share the group of nothing.
fn objects_of_nothing(objects: usize) -> Vec<u8> {
    fn put(file: &mut Vec<u8>, count: u64, bytes: &[u8]) -> u64 {
        let place = file.len() as u64;
        file.extend(count.to_le_bytes());
        file.extend(bytes);
        place
    }
    const DATA: u64 = 1 << 63;
    let mut file = b"Ogawa\xff\0\x01\0\0\0\0\0\0\0\0".to_vec();
    let headers = vec![0; 5 * objects + 32];
    let headers = DATA | put(&mut file, headers.len() as u64, &headers);
    let mut children = vec![0; objects + 1];
    children.push(headers);
    let top = put(&mut file, children.len() as u64, bytemuck::cast_slice(&children));
    let version = DATA | put(&mut file, 4, &0_i32.to_le_bytes());
    let library = DATA | put(&mut file, 4, &10_808_i32.to_le_bytes());
    let root = [version, library, top, DATA, DATA, DATA];
    let root = put(&mut file, 6, bytemuck::cast_slice(&root));
    file[8..16].copy_from_slice(&root.to_le_bytes());
    file
}

#[test]
fn objects_of_nothing_take_no_memory() {
    refused(&objects_of_nothing(1), "no curves");
    refused(&objects_of_nothing(10_000), "objects");
}

#[test]
fn older_archives_are_named() {
    refused(b"\x89HDF\r\n\x1a\n and so on", "an Alembic archive of the older HDF5 kind");
    refused(b"Ogawa\0\0\x01\0\0\0\0\0\0\0\0", "the program that wrote it did not finish");
}
