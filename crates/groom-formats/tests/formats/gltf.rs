//! glTF written and read back; surfaces; grids; files that lie.

#![cfg(feature = "gltf")]
#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use crate::support::{any_groom, full_groom, offsets, set};
use glam::{Vec2, Vec3};
use groom::{Attribute, Domain, Groom, UpAxis, Values, names};
use groom_formats::{Format, FormatError, Loaded, Mesh, ReadOptions, Warning, WriteOptions};
use proptest::prelude::*;
use serde_json::{Value, json};

fn written(groom: &Groom, options: &WriteOptions) -> (Vec<u8>, Vec<Warning>) {
    let mut bytes = Vec::new();
    let warnings = groom_formats::write_to(Format::Glb, groom, &mut bytes, "memory", options).unwrap();
    (bytes, warnings)
}

fn read(bytes: &[u8]) -> Result<Loaded, FormatError> {
    groom_formats::read_from(Format::Glb, bytes, "memory", &ReadOptions::default())
}

/// `groom` without its strands of one point.
fn drawn(groom: &Groom) -> Groom {
    let mut groom = groom.clone();
    groom.repair();
    groom
}

/// A `.glb` of one buffer.
fn glb(json: &Value, binary: &[u8]) -> Vec<u8> {
    let mut json = json.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let word = |n: usize| (n as u32).to_le_bytes().to_vec();
    let length = 12 + 8 + json.len() + 8 + binary.len();
    let head = [b"glTF".to_vec(), word(2), word(length), word(json.len()), b"JSON".to_vec(), json];
    [head.concat(), word(binary.len()), b"BIN\0".to_vec(), binary].concat()
}

fn le(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

/// A document of one mesh, whose accessors are VEC3 floats one after the other, with `nodes` and `primitives`.
fn document(nodes: Value, primitives: Value, accessors: Value, bytes: usize) -> Value {
    json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": nodes,
        "meshes": [{"primitives": primitives}], "accessors": accessors,
        "bufferViews": [{"buffer": 0, "byteLength": bytes}], "buffers": [{"byteLength": bytes}]
    })
}

mod reading {
    use super::*;

    proptest! {
        #[test]
        fn what_is_written_is_read(groom in any_groom()) {
            prop_assume!(groom.strands().any(|points| points.len() > 1));
            let mut groom = groom;
            groom.remove_attribute(names::COLOR);
            groom.remove_attribute(names::TRANSPARENCY);
            let loaded = read(&written(&groom, &WriteOptions::default()).0).unwrap();
            let expected: Vec<&[Vec3]> = groom.strands().filter(|points| points.len() > 1).collect();
            let found: Vec<&[Vec3]> = loaded.groom.strands().collect();
            prop_assert_eq!(found.len(), expected.len());
            let bits = |strands: &[&[Vec3]]| -> Vec<[u32; 3]> {
                strands.concat().iter().map(|p| p.to_array().map(f32::to_bits)).collect()
            };
            prop_assert_eq!(bits(&found), bits(&expected));
            let mut next = 0;
            for strand in 0..groom.strand_count() {
                let range = groom.strand_range(strand);
                for vertex in range.clone().filter(|_| range.len() > 1) {
                    let radius = loaded.groom.radii().get(0, next);
                    prop_assert_eq!(radius.to_bits(), groom.radii().get(strand, vertex).to_bits());
                    next += 1;
                }
            }
        }

        #[test]
        fn broken_bytes_are_read_or_refused(
            cut in any::<prop::sample::Index>(),
            flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..5),
        ) {
            let options = WriteOptions { all_attributes: true, ..WriteOptions::default() };
            let mut bytes = written(&full_groom(), &options).0;
            for (at, value) in flips {
                let at = at.index(bytes.len());
                bytes[at] = value;
            }
            let _ = read(&bytes);
            let _ = read(&bytes[..cut.index(bytes.len())]);
        }
    }

    #[test]
    fn every_attribute_comes_back() {
        let mut groom = full_groom();
        set(&mut groom, names::GROUP, Domain::Strand, Values::Int(vec![3, 0, 3]));
        set(&mut groom, names::GUIDE, Domain::Strand, Values::Int(vec![1, 0, 0]));
        let velocities = (0..8).map(|i| Vec3::new(i as f32, 0.5, -1.0)).collect();
        set(&mut groom, names::VELOCITY, Domain::Vertex, Values::Vec3(velocities));
        set(&mut groom, "layer", Domain::Groom, Values::Int(vec![12]));
        set(&mut groom, "flow", Domain::Strand, Values::Vec3(vec![Vec3::X; 3]));
        let colors = vec![Vec3::X, Vec3::Y, Vec3::new(0.2, 0.4, 0.6)];
        set(&mut groom, names::COLOR, Domain::Strand, Values::Vec3(colors));
        set(&mut groom, names::TRANSPARENCY, Domain::Groom, Values::Float(vec![0.2]));
        for (quantize, tolerance) in [(None, 1e-7), (Some(24), 1e-6), (Some(16), 1e-4), (Some(12), 2e-3)] {
            let options = WriteOptions { all_attributes: true, quantize, ..WriteOptions::default() };
            let (bytes, warnings) = written(&groom, &options);
            assert!(!warnings.iter().any(|w| matches!(w, Warning::AttributeLeftOut { .. })), "{warnings:?}");
            let loaded = read(&bytes).unwrap();
            assert_eq!(loaded.warnings, []);
            let expected = drawn(&groom);
            assert_eq!(loaded.groom.offsets(), expected.offsets());
            for (a, b) in loaded.groom.positions().iter().zip(expected.positions()) {
                assert!((*a - *b).length() <= tolerance, "{quantize:?}: {a} {b}");
            }
            for (name, attribute) in expected.attributes() {
                let found = loaded.groom.attribute(name).unwrap_or_else(|| panic!("{name} is lost"));
                assert_eq!(found.domain, attribute.domain, "{name}");
                same(name, &found.values, &attribute.values);
            }
            assert_eq!(loaded.groom.attributes().count(), expected.attributes().count());
        }
    }

    fn same(name: &str, a: &Values, b: &Values) {
        let numbers = |values: &Values| -> Vec<f64> {
            match values {
                Values::Float(v) => v.iter().map(|&v| v.into()).collect(),
                Values::Vec2(v) => v.iter().flat_map(|v| v.to_array()).map(f64::from).collect(),
                Values::Vec3(v) => v.iter().flat_map(|v| v.to_array()).map(f64::from).collect(),
                Values::Int(v) => v.iter().map(|&v| v.into()).collect(),
            }
        };
        assert_eq!(a.type_name(), b.type_name(), "{name}");
        assert_eq!(a.len(), b.len(), "{name}");
        for (a, b) in numbers(a).into_iter().zip(numbers(b)) {
            assert!((a - b).abs() <= 1e-6 * b.abs().max(1.0), "{name}: {a} {b}");
        }
    }

    #[test]
    fn axis_and_unit_are_gltfs_unless_said() {
        let mut groom = full_groom();
        groom.up_axis = UpAxis::Z;
        groom.meters_per_unit = 0.01;
        let bytes = written(&groom, &WriteOptions::default()).0;
        let loaded = read(&bytes).unwrap();
        assert_eq!((loaded.groom.up_axis, loaded.groom.meters_per_unit), (UpAxis::Y, 1.0));
        let options =
            ReadOptions { up_axis: Some(UpAxis::Z), meters_per_unit: Some(0.5), ..ReadOptions::default() };
        let told = groom_formats::read_from(Format::Glb, &bytes[..], "memory", &options).unwrap().groom;
        assert_eq!((told.up_axis, told.meters_per_unit), (UpAxis::Z, 0.5));
        assert_eq!(told.positions(), loaded.groom.positions(), "the numbers are kept");
    }

    #[test]
    fn two_files_are_read_as_one_is() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("my hair.gltf");
        groom_formats::write(&full_groom(), &path, &WriteOptions::default()).unwrap();
        let loaded = groom_formats::read(&path, &ReadOptions::default()).unwrap();
        assert_eq!(loaded.groom, read(&written(&full_groom(), &WriteOptions::default()).0).unwrap().groom);
        std::fs::remove_file(folder.path().join("my hair.bin")).unwrap();
        let error = groom_formats::read(&path, &ReadOptions::default()).unwrap_err();
        assert!(error.to_string().contains("my hair.bin"), "{error}");
    }

    /// Strips, loops and triangles in one mesh shown twice, the second time moved, turned and twice as large.
    #[test]
    fn nodes_place_every_primitive() {
        let primitives = json!([
            {"mode": 3, "attributes": {"POSITION": 0, "_RADIUS": 1, "NORMAL": 0}},
            {"mode": 2, "attributes": {"POSITION": 0, "COLOR_0": 2}},
            {"mode": 4, "attributes": {"POSITION": 0}}
        ]);
        let accessors = json!([
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "SCALAR"},
            {"bufferView": 0, "byteOffset": 48, "componentType": 5123, "normalized": true, "count": 3, "type": "VEC3"}
        ]);
        let nodes = json!([
            {"mesh": 0, "children": [1]},
            {"mesh": 0, "translation": [0, 0, 9], "scale": [2, 2, 2],
             "rotation": [0, 0, std::f64::consts::FRAC_1_SQRT_2, std::f64::consts::FRAC_1_SQRT_2]}
        ]);
        let mut binary = le(&[0., 0., 0., 1., 0., 0., 1., 1., 0., 0.1, 0.2, 0.3]);
        binary.extend([65535_u16, 0, 13107, 0, 0, 0, 0, 0, 0].map(u16::to_le_bytes).concat());
        let loaded = read(&glb(&document(nodes, primitives, accessors, 66), &binary)).unwrap();
        let groom = &loaded.groom;
        assert_eq!(groom.offsets(), [0, 3, 7, 10, 14]);
        assert_eq!(groom.strand(1), [Vec3::ZERO, Vec3::X, Vec3::new(1., 1., 0.), Vec3::ZERO]);
        let moved = [Vec3::new(0., 0., 9.), Vec3::new(0., 2., 9.), Vec3::new(-2., 2., 9.)];
        for (found, expected) in groom.strand(2).iter().zip(moved) {
            assert!((*found - expected).length() < 1e-6, "{found}");
        }
        assert!((groom.radii().get(2, 8) - 0.4).abs() < 1e-6 && groom.radii().get(1, 3) == 0.0);
        assert_eq!(groom.colors().unwrap().get(1, 3), Vec3::new(1.0, 0.0, 0.2));
        assert_eq!(groom.colors().unwrap().get(0, 0), Vec3::ONE);
        let format = Format::Glb;
        let partly = |name: &str| Warning::AttributePartly { format, name: name.to_owned() };
        assert_eq!(
            loaded.warnings,
            [
                Warning::PrimitivesSkipped { format, primitives: 2 },
                partly("color"),
                partly("radius"),
                Warning::AttributeNotRead {
                    name: "NORMAL".to_owned(),
                    why: "a groom has no place for its kind of values".to_owned(),
                },
            ]
        );
        assert!(groom.attribute(names::GROUP).is_none(), "each primitive is a single strand");
    }

    #[test]
    fn primitives_of_several_strands_are_groups() {
        let primitives = json!([
            {"mode": 1, "attributes": {"POSITION": 0, "TEXCOORD_0": 1}},
            {"mode": 3, "attributes": {"POSITION": 0, "TEXCOORD_0": 1}}
        ]);
        let accessors = json!([
            {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
            {"componentType": 5126, "count": 4, "type": "VEC2", "sparse": {"count": 1,
             "indices": {"bufferView": 0, "componentType": 5125}, "values": {"bufferView": 0, "byteOffset": 4}}}
        ]);
        let binary = le(&[0., 0., 0., 0., 0., 1., 5., 0., 0., 5., 0., 1.]);
        let document = document(json!([{"mesh": 0}]), primitives, accessors, 48);
        let groom = read(&glb(&document, &binary)).unwrap().groom;
        assert_eq!(groom.offsets(), [0, 2, 4, 8]);
        assert_eq!(groom.attribute(names::GROUP).unwrap().values, Values::Int(vec![0, 0, 1]));
        let uv = groom.attribute(names::ROOT_UV).unwrap();
        assert_eq!((uv.domain, &uv.values), (Domain::Strand, &Values::Vec2(vec![Vec2::Y; 3])), "v is up");
    }

    #[test]
    fn files_without_strands_are_refused() {
        let primitive = json!([{"mode": 4, "attributes": {"POSITION": 0}}]);
        let accessors = json!([{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}]);
        let document = document(json!([{"mesh": 0}]), primitive, accessors, 36);
        let error = read(&glb(&document, &[0; 36])).unwrap_err().to_string();
        let told = "memory: meshes: found 1 primitives of triangles or points, and no line, expected LINES";
        assert!(error.starts_with(told), "{error}");
        let tubes = WriteOptions { mesh: Some(Mesh::Ribbons), ..WriteOptions::default() };
        assert!(read(&written(&full_groom(), &tubes).0).is_err());
    }

    #[test]
    fn instances_without_end_take_no_memory() {
        let nodes: Vec<Value> = std::iter::once(json!({"children": (1..2000).collect::<Vec<_>>()}))
            .chain((1..2000).map(|_| json!({"mesh": 0})))
            .collect();
        let primitive = json!([{"mode": 3, "attributes": {"POSITION": 0}}]);
        let accessors = json!([{"bufferView": 0, "componentType": 5126, "count": 3000, "type": "VEC3"}]);
        let document = document(nodes.into(), primitive, accessors, 36000);
        let error = read(&glb(&document, &[0; 36000])).unwrap_err().to_string();
        assert!(error.contains("expected strands of at most 4 times the file's bytes"), "{error}");
    }

    #[test]
    fn shared_indices_without_end_take_no_time() {
        // Segments without length make no strand and take no memory.
        let primitives = vec![json!({"mode": 1, "attributes": {"POSITION": 0}, "indices": 1}); 2000];
        let accessors = json!([
            {"bufferView": 0, "componentType": 5126, "count": 2, "type": "VEC3"},
            {"bufferView": 0, "componentType": 5121, "count": 36000, "type": "SCALAR"}
        ]);
        let document = document(json!([{"mesh": 0}]), primitives.into(), accessors, 36000);
        let error = read(&glb(&document, &[0; 36000])).unwrap_err().to_string();
        assert!(error.contains("expected at most 64 a byte of the file"), "{error}");
    }

    #[test]
    fn truncation_at_every_length_is_an_error() {
        let options = WriteOptions { all_attributes: true, quantize: Some(12), ..WriteOptions::default() };
        let bytes = written(&full_groom(), &options).0;
        for length in 0..bytes.len() {
            read(&bytes[..length]).unwrap_err();
        }
    }

    #[test]
    fn numbers_that_lie_are_told() {
        let primitives = json!([{"mode": 1, "attributes": {"POSITION": 0, "_WIDTH": 1}, "indices": 2}]);
        let accessors = json!([
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {"bufferView": 0, "byteOffset": 36, "componentType": 5126, "count": 3, "type": "SCALAR"},
            {"bufferView": 0, "byteOffset": 48, "componentType": 5125, "count": 4, "type": "SCALAR"}
        ]);
        let mut binary = le(&[0.; 12]);
        binary.extend([0_u32, 1, 1, 2].map(u32::to_le_bytes).concat());
        let whole = document(json!([{"mesh": 0}]), primitives, accessors, 64).to_string();
        let told = |text: &str, binary: &[u8]| {
            read(&glb(&serde_json::from_str(text).unwrap(), binary)).map(|_| ()).unwrap_err().to_string()
        };
        assert!(read(&glb(&serde_json::from_str(&whole).unwrap(), &binary)).is_ok());
        for (truth, lie, expected) in [
            (r#""count":4"#, r#""count":3"#, "meshes[0].primitives[0]: found 3 ends of segments"),
            (r#""count":4"#, r#""count":4000000000"#, "accessors[2]: found 4000000000 elements"),
            (r#""POSITION":0"#, r#""POSITION":7"#, "meshes[0].primitives[0].attributes.POSITION: found 7"),
            (r#""POSITION":0,"#, "", "meshes[0].primitives[0].attributes[\"POSITION\"]: found Missing data"),
            (r#""POSITION":0"#, r#""POSITION":1"#, "accessors[1]: found type Scalar, expected Vec3"),
            (r#""indices":2"#, r#""indices":0"#, "accessors[0]: found Vec3 of F32, expected Scalar of U8"),
            (r#""_WIDTH":1"#, r#""_WIDTH":2"#, "meshes[0].primitives[0].attributes._WIDTH: found 4 values"),
        ] {
            assert!(whole.contains(truth), "{truth} in {whole}");
            let error = told(&whole.replace(truth, lie), &binary);
            assert!(error.contains(expected), "{error}");
        }
        binary[60] = 3;
        assert!(told(&whole, &binary).contains("found index 3, expected below the vertex count 3"));
    }

    /// Other projects' broken files are refused with words.
    #[test]
    fn malformed_files_of_others_are_refused() {
        use std::io::Write;
        let root = std::env::var_os("GROOMKIT_DATA").map_or_else(
            || std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"),
            std::path::PathBuf::from,
        );
        let mut folders = vec![root.join("meshes")];
        if !folders[0].is_dir() {
            let _ = writeln!(std::io::stderr(), "skipped: meshes is not in $GROOMKIT_DATA");
            return;
        }
        let mut seen = 0;
        while let Some(folder) = folders.pop() {
            for path in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
                if path.is_dir() {
                    folders.push(path);
                } else if path.extension().is_some_and(|ending| ending == "gltf" || ending == "glb") {
                    seen += 1;
                    let error = groom_formats::read(&path, &ReadOptions::default()).unwrap_err().to_string();
                    assert!(error.contains(": "), "{error}");
                }
            }
        }
        assert!(seen > 15, "{seen} files");
    }
}

mod writing {
    use super::*;

    #[test]
    fn integers_that_floats_cannot_hold_are_left_out() {
        let mut groom = full_groom();
        set(&mut groom, names::ID, Domain::Strand, Values::Int(vec![1, 2, (1 << 24) + 1]));
        set(&mut groom, "odd", Domain::Groom, Values::Float(vec![f32::NAN]));
        let options = WriteOptions { all_attributes: true, ..WriteOptions::default() };
        let warnings = written(&groom, &options).1;
        for name in ["id", "odd"] {
            let name = name.to_owned();
            assert!(warnings.contains(&Warning::AttributeLeftOut { format: Format::Glb, name }));
        }
    }

    #[test]
    fn the_error_of_a_grid_is_told_and_true() {
        let groom = drawn(&full_groom());
        for bits in [4, 8, 12, 16, 17, 24] {
            let options = WriteOptions { quantize: Some(bits), ..WriteOptions::default() };
            let (bytes, warnings) = written(&groom, &options);
            let told = warnings.iter().find_map(|warning| match warning {
                Warning::PositionsRounded { bits: b, error, .. } if *b == bits => Some(*error),
                _ => None,
            });
            let read = read(&bytes).unwrap().groom;
            let pairs = read.positions().iter().zip(groom.positions());
            let found = pairs.map(|(a, b)| (*a - *b).length()).fold(0.0, f32::max);
            let told = told.unwrap();
            assert!((found - told).abs() <= 1e-6, "{bits} bits: {found} m, told {told} m");
            let step = 7.0 / ((1_u32 << bits) - 1) as f32;
            assert!(told <= step * 0.87 + 1e-6, "{bits} bits: {told} m at {step} m a cube");
        }
    }

    #[test]
    fn integers_are_stored_up_to_16_bits() {
        for (bits, is_stored) in [(12, true), (16, true), (17, false)] {
            let options = WriteOptions { quantize: Some(bits), ..WriteOptions::default() };
            let bytes = written(&full_groom(), &options).0;
            let text = String::from_utf8_lossy(&bytes);
            let required = text.contains(r#""extensionsRequired":["KHR_mesh_quantization"]"#);
            assert_eq!(required, is_stored, "{bits} bits");
        }
    }
}

mod surfaces {
    use super::*;

    /// Positions, normals, texture coordinates and triangles of a file of one surface.
    struct Surface {
        positions: Vec<Vec3>,
        normals: Vec<Vec3>,
        uvs: Vec<Vec2>,
        triangles: Vec<[usize; 3]>,
    }

    fn surface(groom: &Groom, mesh: Mesh) -> Surface {
        let bytes = written(groom, &WriteOptions { mesh: Some(mesh), ..WriteOptions::default() }).0;
        let asset = gltf_bytes::Asset::open(&bytes, None).unwrap();
        let primitive = asset.document.meshes().next().unwrap().primitives().next().unwrap();
        assert_eq!(primitive.mode(), gltf::mesh::Mode::Triangles);
        let floats = |semantic: gltf::Semantic| {
            let accessor = primitive.get(&semantic).unwrap();
            gltf_bytes::Elements::open(&accessor, &asset.buffers).unwrap().floats().unwrap()
        };
        let triples = |values: Vec<f32>| values.as_chunks::<3>().0.iter().map(|&v| Vec3::from(v)).collect();
        let indices = gltf_bytes::Elements::open(&primitive.indices().unwrap(), &asset.buffers).unwrap();
        let indices: Vec<usize> = indices.indices().unwrap().into_iter().map(|i| i as usize).collect();
        Surface {
            positions: triples(floats(gltf::Semantic::Positions)),
            normals: triples(floats(gltf::Semantic::Normals)),
            uvs: floats(gltf::Semantic::TexCoords(0)).as_chunks::<2>().0.iter().map(|&v| v.into()).collect(),
            triangles: indices.as_chunks::<3>().0.to_vec(),
        }
    }

    /// Strands with bends, turns, repeated points and one of two points.
    fn curls() -> Groom {
        let helix = (0..20).map(|i| {
            let t = i as f32 * 0.3;
            Vec3::new(t.cos(), t.sin(), t * 0.3)
        });
        let odd = [[0., 0., 0.], [0., 1., 0.], [0., 1., 0.], [0., 2., 0.], [0., 1., 0.], [1., 1., 0.]];
        let points: Vec<Vec3> =
            helix.chain(odd.map(Vec3::from)).chain([Vec3::ZERO, Vec3::new(0.0, -1.0, 0.0)]).collect();
        let mut groom = Groom::new(offsets(&[20, 6, 2]), points).unwrap();
        let radii = (0..28).map(|i| 0.01 + 0.001 * i as f32).collect();
        set(&mut groom, names::RADIUS, Domain::Vertex, Values::Float(radii));
        groom
    }

    #[test]
    fn rings_of_tubes_are_round_and_face_outward() {
        let groom = curls();
        for sides in [3_u32, 4, 7, 32] {
            let tube = surface(&groom, Mesh::Tubes { sides });
            assert_eq!(tube.positions.len(), groom.point_count() * sides as usize);
            assert_eq!(
                tube.triangles.len(),
                2 * (sides as usize * groom.segment_count() + (sides as usize - 2) * groom.strand_count())
            );
            for (i, (position, normal)) in tube.positions.iter().zip(&tube.normals).enumerate() {
                let point = i / sides as usize;
                let way = *position - groom.positions()[point];
                let radius = groom.radii().get(0, point);
                assert!((way.length() - radius).abs() < 1e-6, "{sides} sides, point {point}");
                assert!((normal.length() - 1.0).abs() < 1e-5);
                assert!(way.normalize().dot(*normal) > 0.999, "the normal looks outward");
            }
        }
    }

    #[test]
    fn tubes_are_watertight() {
        let tube = surface(&curls(), Mesh::Tubes { sides: 5 });
        let mut edges = std::collections::BTreeMap::new();
        for [a, b, c] in tube.triangles {
            for edge in [(a, b), (b, c), (c, a)] {
                assert!(edges.insert(edge, ()).is_none(), "{edge:?} twice the same way");
            }
        }
        assert!(edges.keys().all(|&(a, b)| edges.contains_key(&(b, a))), "every edge has a neighbour");
    }

    /// By the divergence theorem, the volume inside outward triangles is positive and that of the prism.
    #[test]
    fn straight_tubes_hold_their_volume() {
        for direction in [Vec3::X, -Vec3::Y, Vec3::new(1.0, 2.0, -0.5).normalize()] {
            let points = (0..5).map(|i| direction * i as f32).collect();
            let mut groom = Groom::new(vec![0, 5], points).unwrap();
            groom.set_attribute(names::RADIUS, Attribute::constant_float(0.5)).unwrap();
            let tube = surface(&groom, Mesh::Tubes { sides: 6 });
            let corner = |i: usize| tube.positions[i];
            let volume: f32 =
                tube.triangles.iter().map(|&[a, b, c]| corner(a).cross(corner(b)).dot(corner(c)) / 6.0).sum();
            // A hexagon of circumradius r has the area r^2 * 3 sqrt(3) / 2.
            let expected = 4.0 * 0.25 * 1.5 * 3.0_f32.sqrt();
            assert!((volume - expected).abs() < 1e-4, "{volume} {expected}");
        }
    }

    #[test]
    fn ribbons_are_as_wide_as_the_strand_and_do_not_flip() {
        let groom = curls();
        let ribbon = surface(&groom, Mesh::Ribbons);
        assert_eq!(ribbon.positions.len(), 2 * groom.point_count());
        assert_eq!(ribbon.triangles.len(), 2 * groom.segment_count());
        for (i, pair) in ribbon.positions.as_chunks::<2>().0.iter().enumerate() {
            let width = 2.0 * groom.radii().get(0, i);
            assert!(((pair[1] - pair[0]).length() - width).abs() < 1e-6);
            assert!(((pair[1] + pair[0]) / 2.0 - groom.positions()[i]).length() < 1e-6);
            assert!((ribbon.normals[2 * i].length() - 1.0).abs() < 1e-5);
        }
        // Along the helix, neighbours' sides and normals stay close and the winding agrees with the normals.
        for i in 0..19 {
            let side = |i: usize| (ribbon.positions[2 * i + 1] - ribbon.positions[2 * i]).normalize();
            assert!(side(i).dot(side(i + 1)) > 0.9, "point {i}");
        }
        for &[a, b, c] in &ribbon.triangles[..38] {
            let [p, q, r] = [a, b, c].map(|i| ribbon.positions[i]);
            assert!((q - p).cross(r - p).dot(ribbon.normals[a]) > 0.0);
        }
    }

    #[test]
    fn texture_coordinates_are_the_root_uv_or_across_and_along() {
        let mut groom = drawn(&full_groom());
        let ribbon = surface(&groom, Mesh::Ribbons);
        assert_eq!((ribbon.uvs[0], ribbon.uvs[6]), (Vec2::new(0.0, 1.0), Vec2::new(0.5, 0.75)), "v is down");
        groom.remove_attribute(names::ROOT_UV);
        let ribbon = surface(&groom, Mesh::Ribbons);
        assert_eq!((ribbon.uvs[0], ribbon.uvs[1]), (Vec2::ZERO, Vec2::X));
        assert_eq!((ribbon.uvs[4], ribbon.uvs[5]), (Vec2::Y, Vec2::ONE));
        let tube = surface(&groom, Mesh::Tubes { sides: 4 });
        assert_eq!(tube.uvs[..4].iter().map(|uv| uv.x).collect::<Vec<_>>(), [0.0, 0.5, 1.0, 0.5]);
    }
}
