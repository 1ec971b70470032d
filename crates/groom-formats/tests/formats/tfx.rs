//! TressFX `.tfx` 3 and 4: the layouts to the byte, AMD's bear, and files that lie.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use std::io::Write;
use std::path::Path;

use crate::support::from_bytes;
use crate::support::lies::{change_everywhere, cut_everywhere, told, with_u32};
use glam::{Vec2, Vec3};
use groom::{Domain, Groom, UpAxis, Values, names};
use groom_formats::{Format, ReadOptions};
use proptest::prelude::*;

const V3: &[u8] = include_bytes!("../golden/v3.tfx");
const V4: &[u8] = include_bytes!("../golden/v4.tfx");

proptest! {
    #[test]
    fn any_bytes_are_read_or_refused(
        version in prop::sample::select(vec![3.0_f32, 4.0]),
        words in prop::collection::vec(prop_oneof![0_u32..400, any::<u32>()], 0..120),
    ) {
        let mut bytes = version.to_le_bytes().to_vec();
        bytes.extend(words.iter().flat_map(|word| word.to_le_bytes()));
        let _ = from_bytes(Format::Tfx, &bytes);
    }
}

fn values<'a>(groom: &'a Groom, name: &str, domain: Domain) -> &'a Values {
    let attribute = groom.attribute(name).unwrap();
    assert_eq!(attribute.domain, domain, "{name}");
    &attribute.values
}

fn expected_points() -> Vec<Vec3> {
    let point = |i: i32| Vec3::new((i / 4) as f32, (i % 4) as f32, 0.5 * (i % 4) as f32);
    (0..8).map(point).collect()
}

#[test]
fn version_3_is_the_makers() {
    let loaded = from_bytes(Format::Tfx, V3).unwrap();
    assert_eq!(loaded.warnings, []);
    let groom = loaded.groom;
    assert_eq!((groom.offsets(), groom.up_axis), (&[0, 4, 8][..], UpAxis::Y));
    assert_eq!(groom.positions(), expected_points());
    let uvs = Values::Vec2(vec![Vec2::new(0.125, 0.25), Vec2::new(0.5, 0.75)]);
    assert_eq!(values(&groom, names::ROOT_UV, Domain::Strand), &uvs);
    let uvs = Values::Vec2((0..8).map(|i| Vec2::new(i as f32 / 8.0, 1.0)).collect());
    assert_eq!(values(&groom, "uv", Domain::Vertex), &uvs);
    let colors = (0..8).map(|i| Vec3::new(1.0, (i % 4) as f32 / 4.0, 0.0)).collect();
    assert_eq!(values(&groom, names::COLOR, Domain::Vertex), &Values::Vec3(colors));
    assert_eq!(values(&groom, names::TRANSPARENCY, Domain::Vertex), &Values::Float(vec![0.25; 8]));
    assert_eq!(values(&groom, "thickness", Domain::Strand), &Values::Float(vec![0.5, 0.25]));
    assert_eq!(values(&groom, "guide_index", Domain::Strand), &Values::Int(vec![0, 0]));
    assert_eq!(values(&groom, "both_ends_immovable", Domain::Groom), &Values::Int(vec![1]));
    assert_eq!(values(&groom, "follow_strands", Domain::Groom), &Values::Int(vec![5]));
    assert!(groom.attribute("pinned").is_none());
}

#[test]
fn version_4_is_the_makers() {
    let groom = from_bytes(Format::Tfx, V4).unwrap().groom;
    assert_eq!(groom.positions(), expected_points());
    assert_eq!(values(&groom, "pinned", Domain::Vertex), &Values::Int(vec![1, 1, 0, 0, 1, 1, 0, 0]));
    let names: Vec<_> = groom.attributes().map(|(name, _)| name).collect();
    assert_eq!(names, ["pinned", "root_uv"]);
    // An inverse mass that is more than a yes or no.
    let heavy = from_bytes(Format::Tfx, &with_u32(V4, 160 + 16 * 2 + 12, 0.5_f32.to_bits())).unwrap().groom;
    let masses = vec![0.0, 0.0, 0.5, 1.0, 0.0, 0.0, 1.0, 1.0];
    assert_eq!(values(&heavy, "inverse_mass", Domain::Vertex), &Values::Float(masses));
}

#[test]
fn the_bear_has_the_vertices_of_its_hair_file() {
    let folder = std::env::var_os("GROOMKIT_DATA").map(std::path::PathBuf::from);
    let folder = folder.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"));
    let (tfx, hair) = (folder.join("hair/bear.tfx"), folder.join("hair/bear_fur.hair"));
    if !tfx.is_file() || !hair.is_file() {
        let _ = writeln!(std::io::stderr(), "skipped: {} and its .hair are not there", tfx.display());
        return;
    }
    let load = |path: &Path| groom_formats::read(path, &ReadOptions::default()).unwrap().groom;
    let (tfx, hair) = (load(&tfx), load(&hair));
    assert_eq!((tfx.strand_count(), tfx.point_count()), (48_113, 4 * 48_113));
    assert!(tfx.offsets() == hair.offsets() && tfx.positions() == hair.positions());
}

#[test]
fn lies_are_refused_at_their_byte() {
    for bytes in [V3, V4] {
        cut_everywhere(Format::Tfx, bytes);
        change_everywhere(Format::Tfx, bytes);
    }
    let version = |version: f32| told(Format::Tfx, &with_u32(V3, 0, version.to_bits()));
    assert!(version(2.0).contains("byte 0: found version 2, expected version 3 or 4"));
    assert!(version(f32::NAN).contains("found version NaN"));
    let turned = told(Format::Tfx, &with_u32(V3, 0, 3.0_f32.to_bits().swap_bytes()));
    assert!(turned.contains("version 3, big endian"), "{turned}");
    assert!(told(Format::Tfx, b"numStrands 4\n").contains("text, as TressFX 2"));
    for strands in [1 << 31, u32::MAX] {
        let told = told(Format::Tfx, &with_u32(V3, 4, strands));
        assert!(told.contains("byte 144: found the offset 296, expected an offset from 296 on"), "{told}");
    }
    // Both counts as large as they can be: their product needs 65 bits of bytes.
    told(Format::Tfx, &with_u32(&with_u32(V3, 4, u32::MAX), 8, u32::MAX));
    assert!(told(Format::Tfx, &with_u32(V4, 8, 0)).contains("byte 8: found strands of 0 vertices"));
    assert!(told(Format::Tfx, &with_u32(V4, 4, 0)).contains("no strand with a point"));
    assert!(told(Format::Tfx, &with_u32(V4, 12, 0)).contains("byte 12: found the offset 0"));
    assert!(told(Format::Tfx, &with_u32(V4, 12, 100)).contains("expected an offset from 160 on"));
    assert!(
        told(Format::Tfx, &with_u32(V4, 16, 292)).contains("of texture coordinates of strands in a file")
    );
}
