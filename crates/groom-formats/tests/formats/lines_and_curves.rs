//! glTF and USD: what is in the bytes, without other people's programs (those run end to end).

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use crate::support::{any_groom, full_groom, offsets, to_bytes};
use glam::Vec3;
use groom::{Groom, UpAxis, names};
use groom_formats::{Format, FormatError, Warning, WriteOptions};
use proptest::prelude::*;
use serde_json::Value;

/// The document and the buffer of a `.glb`.
fn chunks(glb: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| u32::from_le_bytes(glb[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&glb[..4], word(4), word(8)), (&b"glTF"[..], 2, glb.len()));
    let json_end = 20 + word(12);
    assert_eq!((&glb[16..20], &glb[json_end + 4..json_end + 8]), (&b"JSON"[..], &b"BIN\0"[..]));
    assert_eq!(json_end + 8 + word(json_end), glb.len());
    (serde_json::from_slice(&glb[20..json_end]).unwrap(), &glb[json_end + 8..])
}

fn array<'a>(json: &Value, bytes: &'a [u8], accessor: &Value) -> &'a [u8] {
    let view = &json["bufferViews"]
        [json["accessors"][accessor.as_u64().unwrap() as usize]["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    &bytes[start..start + view["byteLength"].as_u64().unwrap() as usize]
}

fn floats(bytes: &[u8]) -> Vec<f32> {
    bytes.chunks(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
}

#[test]
fn glb_holds_lines_in_metres_with_y_up() {
    let mut groom = full_groom();
    groom.up_axis = UpAxis::Z;
    groom.meters_per_unit = 0.01;
    let (glb, warnings) = to_bytes(Format::Glb, &groom).unwrap();
    let (json, bytes) = chunks(&glb);
    let primitive = &json["meshes"][0]["primitives"][0];
    assert_eq!(
        (json["meshes"][0]["primitives"].as_array().unwrap().len(), &primitive["mode"]),
        (1, &1.into())
    );
    let attributes = &primitive["attributes"];
    let indices: Vec<u32> =
        floats(array(&json, bytes, &primitive["indices"])).iter().map(|f| f.to_bits()).collect();
    assert_eq!(indices, [0, 1, 1, 2, 3, 4, 4, 5, 5, 6], "strands of 3 and 4 points");
    let points = floats(array(&json, bytes, &attributes["POSITION"]));
    let kept = [0, 1, 2, 4, 5, 6, 7];
    for (place, vertex) in kept.into_iter().enumerate() {
        let p = groom.positions()[vertex];
        let metres = [p.x, p.z, -p.y].map(|c| (f64::from(c) * 0.01) as f32);
        assert_eq!(points[3 * place..3 * place + 3], metres);
    }
    let widths = floats(array(&json, bytes, &attributes["_WIDTH"]));
    let expected = kept.map(|v| (f64::from(2.0 * groom.radii().get(0, v)) * 0.01) as f32);
    assert_eq!(widths, expected);
    let colors = array(&json, bytes, &attributes["COLOR_0"]);
    assert_eq!(json["materials"][0]["alphaMode"], "BLEND", "transparency would not be seen");
    assert_eq!((&colors[..4], &colors[24..]), (&[255, 0, 0, 191][..], &[51, 102, 153, 191][..]));
    let format = Format::Glb;
    assert!(warnings.contains(&Warning::OnePointStrandsLeftOut { format, strands: 1 }));
    assert!(warnings.iter().any(|w| matches!(w, Warning::Rounded { name: "transparency", .. })));
    assert!(!warnings.iter().any(|w| matches!(w, Warning::Rounded { name: "color", .. })));
}

proptest! {
    #[test]
    fn glb_bounds_are_exact(groom in any_groom()) {
        let result = to_bytes(Format::Glb, &groom);
        if groom.strands().all(|points| points.len() < 2) {
            let refused = matches!(result, Err(FormatError::Empty { points: 2, .. }));
            prop_assert!(refused);
            return Ok(());
        }
        let glb = result.unwrap().0;
        let (json, bytes) = chunks(&glb);
        let accessor = &json["meshes"][0]["primitives"][0]["attributes"]["POSITION"];
        let points = floats(array(&json, bytes, accessor));
        let accessor = &json["accessors"][accessor.as_u64().unwrap() as usize];
        for axis in 0..3 {
            let values = points.iter().skip(axis).step_by(3).copied();
            let (min, max) = values.fold((f32::INFINITY, f32::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
            prop_assert_eq!(accessor["min"][axis].as_f64().unwrap() as f32, min);
            prop_assert_eq!(accessor["max"][axis].as_f64().unwrap() as f32, max);
        }
    }
}

#[test]
fn gltf_is_two_files_and_no_stream() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("my hair.gltf");
    let groom = full_groom();
    groom_formats::write(&groom, &path, &WriteOptions::default()).unwrap();
    let json: Value = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    assert_eq!(json["buffers"][0]["uri"], "my%20hair.bin");
    let bytes = std::fs::read(folder.path().join("my hair.bin")).unwrap();
    assert_eq!(json["buffers"][0]["byteLength"], bytes.len());
    assert_eq!(bytes, chunks(&to_bytes(Format::Glb, &groom).unwrap().0).1);
    assert!(matches!(to_bytes(Format::Gltf, &groom), Err(FormatError::Unsupported { .. })));
}

#[test]
fn usda_is_as_documented() {
    let groom = full_groom();
    let (bytes, warnings) = to_bytes(Format::Usda, &groom).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let text = text.replace(env!("CARGO_PKG_VERSION"), "VERSION");
    let golden = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/usda_is_as_documented.usda");
    if std::env::var_os("GROOMKIT_BLESS").is_some() {
        std::fs::write(&golden, &text).unwrap();
    }
    assert_eq!(text, std::fs::read_to_string(golden).unwrap(), "set GROOMKIT_BLESS=1 to accept");
    let format = Format::Usda;
    assert_eq!(
        warnings,
        [
            Warning::OnePointStrandsLeftOut { format, strands: 1 },
            Warning::AttributeRenamed { format, name: "clump weight".into(), written: "clump_weight".into() },
        ]
    );
}

#[test]
fn nothing_to_draw_and_values_out_of_range_are_refused() {
    let one_point = Groom::new(offsets(&[1, 1]), vec![Vec3::ZERO; 2]).unwrap();
    let mut bad = full_groom();
    bad.positions_mut()[4].z = f32::INFINITY;
    let mut huge = full_groom();
    huge.positions_mut()[4].z = 3.0e38;
    huge.set_attribute(names::RADIUS, groom::Attribute::constant_float(3.0e38)).unwrap();
    huge.meters_per_unit = 100.0;
    for format in [Format::Glb, Format::Usda] {
        assert!(matches!(to_bytes(format, &one_point), Err(FormatError::Empty { points: 2, .. })));
        assert!(matches!(to_bytes(format, &bad), Err(FormatError::Value { vertex: 4, strand: 2, .. })));
        assert!(matches!(to_bytes(format, &huge), Err(FormatError::Unsupported { .. })));
    }
}

#[test]
fn colours_outside_0_to_1_are_clamped_and_told() {
    let mut groom = full_groom();
    groom.set_attribute(names::COLOR, groom::Attribute::constant_vec3(Vec3::new(2.0, -1.0, 0.0))).unwrap();
    let warnings = to_bytes(Format::Glb, &groom).unwrap().1;
    assert!(warnings.contains(&Warning::Clamped { format: Format::Glb, name: "color", values: 7 }));
}

#[test]
fn opaque_hair_is_not_blended() {
    let mut groom = full_groom();
    groom.set_attribute(names::TRANSPARENCY, groom::Attribute::constant_float(0.0)).unwrap();
    let (glb, _) = to_bytes(Format::Glb, &groom).unwrap();
    let mode = &chunks(&glb).0["materials"][0]["alphaMode"];
    assert!(mode.is_null() || mode == "OPAQUE", "{mode}");
}

#[test]
fn neither_file_of_a_pair_is_replaced_when_the_other_cannot_be() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("a.bin"), "old").unwrap();
    std::fs::create_dir(folder.path().join("a.gltf")).unwrap();
    let path = folder.path().join("a.gltf");
    groom_formats::write(&full_groom(), &path, &WriteOptions::default()).unwrap_err();
    assert_eq!(std::fs::read(folder.path().join("a.bin")).unwrap(), b"old");
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 2, "nothing is left behind");
}

#[cfg(unix)]
#[test]
fn a_pipe_is_written_to_and_stays_a_pipe() {
    use std::os::unix::fs::FileTypeExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("pipe.txt");
    assert!(std::process::Command::new("mkfifo").arg(&path).status().unwrap().success());
    let reader = std::thread::spawn({
        let path = path.clone();
        move || std::fs::read(path).unwrap()
    });
    groom_formats::write(&full_groom(), &path, &WriteOptions::default()).unwrap();
    assert!(path.metadata().unwrap().file_type().is_fifo());
    assert_eq!(reader.join().unwrap(), to_bytes(Format::Text, &full_groom()).unwrap().0);
}

#[test]
fn a_failed_write_leaves_the_old_file() {
    let folder = tempfile::tempdir().unwrap();
    let one_point = Groom::new(offsets(&[1]), vec![Vec3::ZERO]).unwrap();
    for format in [Format::Usda, Format::Glb, Format::Gltf] {
        let path = folder.path().join(format!("old.{format}"));
        std::fs::write(&path, "old").unwrap();
        groom_formats::write(&one_point, &path, &WriteOptions::default()).unwrap_err();
        assert_eq!(std::fs::read(&path).unwrap(), b"old");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 3, "nothing is left behind");
    let nowhere = folder.path().join("no such folder/a.txt");
    let error = groom_formats::write(&full_groom(), &nowhere, &WriteOptions::default()).unwrap_err();
    assert!(error.to_string().contains("no such folder"), "{error}");
    let unknown = groom_formats::write(&full_groom(), &folder.path().join("a.fbx"), &WriteOptions::default());
    assert!(matches!(unknown, Err(FormatError::UnknownFormat { .. })));
}
