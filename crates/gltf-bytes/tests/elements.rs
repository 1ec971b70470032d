//! Accessors of every kind, and files that lie about them.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use gltf::accessor::Dimensions;
use gltf_bytes::{Asset, Elements, GltfError};
use proptest::prelude::*;

/// A `.glb` of one buffer.
fn glb(accessors: &str, views: &str, binary: &[u8]) -> Vec<u8> {
    let mut json = format!(
        r#"{{"asset":{{"version":"2.0"}},"accessors":[{accessors}],"bufferViews":[{views}],
        "buffers":[{{"byteLength":{}}}]}}"#,
        binary.len()
    )
    .into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut binary = binary.to_vec();
    binary.resize(binary.len().next_multiple_of(4), 0);
    let word = |n: usize| (n as u32).to_le_bytes().to_vec();
    let length = 12 + 8 + json.len() + 8 + binary.len();
    [b"glTF".to_vec(), word(2), word(length), word(json.len()), b"JSON".to_vec(), json]
        .into_iter()
        .chain([word(binary.len()), b"BIN\0".to_vec(), binary])
        .collect::<Vec<_>>()
        .concat()
}

/// Everything of the first accessor.
fn floats(glb: &[u8]) -> Result<Vec<f32>, GltfError> {
    let asset = Asset::open(glb, None)?;
    let mut read = asset.document.accessors().map(|a| Elements::open(&a, &asset.buffers)?.floats());
    read.next().unwrap_or(Ok(Vec::new()))
}

fn le(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|v| v.to_le_bytes()).collect()
}

#[test]
fn every_component_type_is_read_plain_and_normalised() {
    let bytes: Vec<u8> = vec![0, 1, 0x80, 0xff, 0xff, 0x7f, 0, 0x80];
    for (kind, plain, normalised) in [
        (5120, vec![0., 1., -128., -1., -1., 127., 0., -128.], vec![0., 1. / 127., -1., -1. / 127.]),
        (5121, vec![0., 1., 128., 255., 255., 127., 0., 128.], vec![0., 1. / 255., 128. / 255., 1.]),
        (5122, vec![256., -128., 32767., -32768.], vec![256. / 32767., -128. / 32767., 1., -1.]),
        (5123, vec![256., 65408., 32767., 32768.], vec![256. / 65535., 65408. / 65535.]),
        (5125, vec![0xff80_0100_u32 as f32, 0x8000_7fff_u32 as f32], vec![]),
        (5126, vec![f32::from_bits(0xff80_0100), f32::from_bits(0x8000_7fff)], vec![]),
    ] {
        let count = plain.len();
        let accessor = |extra: &str| {
            format!(r#"{{"bufferView":0,"componentType":{kind},"count":{count},"type":"SCALAR"{extra}}}"#)
        };
        let view = r#"{"buffer":0,"byteLength":8}"#;
        let bits = |v: Vec<f32>| v.into_iter().map(f32::to_bits).collect::<Vec<_>>();
        let found = floats(&glb(&accessor(""), view, &bytes)).unwrap();
        // Signalling NaNs may come out quiet.
        if kind != 5126 {
            assert_eq!(bits(found), bits(plain), "{kind}");
        }
        let found = floats(&glb(&accessor(r#","normalized":true"#), view, &bytes)).unwrap();
        for (found, expected) in found.into_iter().zip(normalised) {
            assert_eq!(found, expected, "{kind}");
        }
    }
}

#[test]
fn quantised_positions_are_read_with_their_stride() {
    // u16 x 3 every 8 bytes, as KHR_mesh_quantization wants them.
    let words: Vec<u16> = vec![0, 65535, 13107, 9, 65535, 0, 39321, 9];
    let bytes: Vec<u8> = words.iter().flat_map(|w| w.to_le_bytes()).collect();
    let accessor = r#"{"bufferView":0,"componentType":5123,"normalized":true,"count":2,"type":"VEC3"}"#;
    let view = r#"{"buffer":0,"byteLength":16,"byteStride":8}"#;
    assert_eq!(floats(&glb(accessor, view, &bytes)).unwrap(), [0.0, 1.0, 0.2, 1.0, 0.0, 0.6]);
}

#[test]
fn matrices_are_read_column_by_column_without_their_padding() {
    let accessor = r#"{"bufferView":0,"componentType":5121,"count":2,"type":"MAT2"}"#;
    let bytes = [1, 2, 0, 0, 3, 4, 0, 0, 5, 6, 0, 0, 7, 8, 0, 0];
    let found = floats(&glb(accessor, r#"{"buffer":0,"byteLength":16}"#, &bytes)).unwrap();
    assert_eq!(found, [1., 2., 3., 4., 5., 6., 7., 8.]);
    let numbers: Vec<f32> = (0..32).map(|i| i as f32).collect();
    let accessor = r#"{"bufferView":0,"componentType":5126,"count":2,"type":"MAT4"}"#;
    let found = floats(&glb(accessor, r#"{"buffer":0,"byteLength":128}"#, &le(&numbers))).unwrap();
    assert_eq!(found, numbers);
}

#[test]
fn sparse_accessors_replace_values_or_zeros() {
    let bytes = [le(&[1., 2., 3., 4.]), vec![1, 3, 0, 0], le(&[9., 8.])].concat();
    let sparse =
        r#""sparse":{"count":2,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":2}}"#;
    let views = r#"{"buffer":0,"byteLength":16},{"buffer":0,"byteOffset":16,"byteLength":2},
        {"buffer":0,"byteOffset":20,"byteLength":8}"#;
    let with = |view: &str| format!(r#"{{{view}"componentType":5126,"count":4,"type":"SCALAR",{sparse}}}"#);
    assert_eq!(floats(&glb(&with(r#""bufferView":0,"#), views, &bytes)).unwrap(), [1., 9., 3., 8.]);
    assert_eq!(floats(&glb(&with(""), views, &bytes)).unwrap(), [0., 9., 0., 8.]);
    let lying = with("").replace(r#""count":4"#, r#""count":1000000000000"#);
    let error = floats(&glb(&lying, views, &bytes)).unwrap_err().to_string();
    assert!(error.contains("accessors[0]: found 4000000000000 bytes of values"), "{error}");
    let short = with("").replace(r#""count":4"#, r#""count":3"#);
    let error = floats(&glb(&short, views, &bytes)).unwrap_err().to_string();
    assert_eq!(error, "accessors[0].sparse: found index 3, expected below 3");
}

#[test]
fn what_does_not_fit_is_told() {
    let view = r#"{"buffer":0,"byteLength":12}"#;
    let accessor = r#"{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"}"#;
    assert!(floats(&glb(accessor, view, &[0; 12])).is_ok());
    for (lie, told) in [
        (accessor.replace("3,", "4,"), "accessors[0]: found 4 elements of 4 bytes every 4 from 0, expected"),
        (
            accessor.replace("3,", "18446744073709551615,"),
            "accessors[0]: found 18446744073709551615 elements",
        ),
        (accessor.replace("\"count\"", "\"byteOffset\":4,\"count\""), "accessors[0]: found 3 elements"),
        (
            accessor.replace("\"count\"", "\"byteOffset\":18446744073709551615,\"count\""),
            "accessors[0]: found 3 elements",
        ),
        (accessor.replace("\"bufferView\":0,", ""), "accessors[0]"),
    ] {
        let error = floats(&glb(&lie, view, &[0; 12])).unwrap_err().to_string();
        assert!(error.starts_with(told), "{error}");
    }
    let wide = r#"{"buffer":0,"byteOffset":4,"byteLength":12}"#;
    let error = floats(&glb(accessor, wide, &[0; 12])).unwrap_err().to_string();
    assert!(error.starts_with("bufferViews[0] (of accessors[0]): found 12 bytes from 4"), "{error}");
    let narrow = r#"{"buffer":0,"byteLength":12,"byteStride":4}"#;
    let error = floats(&glb(&accessor.replace("SCALAR", "VEC2"), narrow, &[0; 12])).unwrap_err();
    assert!(error.to_string().contains("8 bytes every 4"), "{error}");
}

#[test]
fn types_that_are_not_asked_for_are_told() {
    let accessor = r#"{"bufferView":0,"componentType":5126,"count":3,"type":"SCALAR"}"#;
    let bytes = glb(accessor, r#"{"buffer":0,"byteLength":12}"#, &[0; 12]);
    let asset = Asset::open(&bytes, None).unwrap();
    let accessor = asset.document.accessors().next().unwrap();
    let error = Elements::of(&accessor, &[Dimensions::Vec3, Dimensions::Vec4], &asset.buffers).unwrap_err();
    assert_eq!(error.to_string(), "accessors[0]: found type Scalar, expected Vec3 or Vec4");
    let elements = Elements::of(&accessor, &[Dimensions::Scalar], &asset.buffers).unwrap();
    assert!(elements.indices().unwrap_err().to_string().contains("Scalar of F32"));
    assert_eq!(elements.map([2, 7].into_iter(), |[a, b]: [f64; 2]| (a, b)), [(0.0, 0.0); 2]);
}

proptest! {
    #[test]
    fn broken_files_are_read_or_refused(
        cut in any::<prop::sample::Index>(),
        flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..4),
    ) {
        let sparse = r#"{"componentType":5126,"count":4,"type":"VEC2","bufferView":0,
            "sparse":{"count":2,"indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}}"#;
        let views = r#"{"buffer":0,"byteLength":32},{"buffer":0,"byteOffset":16,"byteLength":2}"#;
        let mut bytes = glb(sparse, views, &[1; 32]);
        for (at, value) in flips {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        let _ = floats(&bytes);
        let _ = floats(&bytes[..cut.index(bytes.len())]);
    }
}
