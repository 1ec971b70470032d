//! What stands in the Alembic we write: Alembic's own schema and Unreal's, by name, type, scope and number.

#![allow(clippy::unwrap_used, clippy::panic)] // tests fail by panicking

use std::io::Cursor;

use crate::support::{from_bytes, full_groom, set};
use glam::{Vec2, Vec3};
use groom::{Domain, Groom, UpAxis, Values, names};
use groom_formats::{Dialect, Format, FormatError, Warning, WriteOptions};
use ogawa::{Archive, CompoundReader, DataType, ObjectReader, Pod, PropertyKind, PropertyReader};

fn written(groom: &Groom, dialect: Option<Dialect>) -> Vec<u8> {
    let mut file = Cursor::new(Vec::new());
    let options = WriteOptions { dialect, ..WriteOptions::default() };
    groom_formats::write_seekable(Format::Alembic, groom, &mut file, "memory", &options).unwrap();
    file.into_inner()
}

fn hair<'a>(archive: &'a Archive<'a>) -> ObjectReader<'a> {
    let objects: Vec<_> = archive.top().children().unwrap().map(Result::unwrap).collect();
    assert_eq!(objects.len(), 1);
    objects[0]
}

fn inside<'a>(compound: &CompoundReader<'a>, name: &str) -> CompoundReader<'a> {
    property(compound, name).compound().unwrap()
}

fn property<'a>(compound: &CompoundReader<'a>, name: &str) -> PropertyReader<'a> {
    compound.find(name).unwrap().unwrap_or_else(|| panic!("no {name}"))
}

/// Names in their order.
fn listed(compound: &CompoundReader<'_>) -> Vec<String> {
    compound.iter().map(|p| p.unwrap().name().to_owned()).collect()
}

/// Type, scope and numbers of a geometry parameter.
fn parameter(compound: &CompoundReader<'_>, name: &str) -> (DataType, String, Vec<f32>) {
    let property = property(compound, name);
    let words = property.metadata();
    assert_eq!((property.kind(), words.get("isGeomParam")), (PropertyKind::Array, Some("true")), "{name}");
    let extent = property.data_type().unwrap().extent;
    assert_eq!(words.get("podExtent"), Some(extent.to_string().as_str()));
    assert_eq!(words.get("interpretation"), Some(if extent > 1 { "vector" } else { "" }), "{name}");
    let numbers = property.sample(0).unwrap().to_f32().unwrap();
    (property.data_type().unwrap(), words.get("geoScope").unwrap().to_owned(), numbers)
}

fn groomed() -> Groom {
    let mut groom = full_groom();
    set(&mut groom, names::GROUP, Domain::Strand, Values::Int(vec![0, 0, 1]));
    set(&mut groom, names::GUIDE, Domain::Strand, Values::Int(vec![1, 0, 0]));
    set(&mut groom, names::VELOCITY, Domain::Vertex, Values::Vec3(vec![Vec3::new(1.0, 2.0, 3.0); 8]));
    groom
}

#[test]
fn the_curves_are_alembics() {
    let groom = groomed();
    let bytes = written(&groom, None);
    let archive = Archive::new(&bytes).unwrap();
    assert_eq!(archive.library_version(), 10808);
    let hair = hair(&archive);
    assert_eq!(hair.name(), "groom");
    for (key, value) in [
        ("schema", "AbcGeom_Curve_v2"),
        ("schemaBaseType", "AbcGeom_GeomBase_v1"),
        ("schemaObjTitle", "AbcGeom_Curve_v2:.geom"),
    ] {
        assert_eq!(hair.metadata().get(key), Some(value));
    }
    let geometry = inside(&hair.properties().unwrap(), ".geom");
    assert_eq!(
        listed(&geometry),
        [
            ".selfBnds",
            "P",
            "nVertices",
            "curveBasisAndType",
            ".velocities",
            "width",
            "uv",
            ".arbGeomParams",
            ".userProperties"
        ]
    );
    let points = property(&geometry, "P");
    assert_eq!((points.data_type(), points.kind()), (Some(DataType::F32X3), PropertyKind::Array));
    assert_eq!(points.metadata().get("interpretation"), Some("point"));
    assert_eq!(
        points.sample(0).unwrap().to_vec::<f32>().unwrap(),
        bytemuck::cast_slice::<_, f32>(groom.positions())
    );
    assert_eq!(property(&geometry, "nVertices").sample(0).unwrap().to_i32().unwrap(), [3, 1, 4]);
    let basis = property(&geometry, "curveBasisAndType");
    assert_eq!((basis.data_type(), basis.kind()), (Some(DataType::new(Pod::U8, 4)), PropertyKind::Scalar));
    assert_eq!(basis.sample(0).unwrap().bytes(), [1, 0, 0, 0]);
    assert_eq!(property(&geometry, ".velocities").sample(0).unwrap().to_f32().unwrap()[..3], [1.0, 2.0, 3.0]);
    let bounds = [0.0, 0.0, -7.0, f64::from(7.0_f32 * 0.1), f64::from(49.0_f32 * 0.01), 0.0];
    assert_eq!(property(&geometry, ".selfBnds").sample(0).unwrap().to_f64().unwrap(), bounds);
    let all = property(&archive.top().properties().unwrap(), ".childBnds");
    assert_eq!(all.sample(0).unwrap().to_f64().unwrap(), bounds);
}

#[test]
fn the_groom_schema_is_unreals() {
    let groom = groomed();
    let bytes = written(&groom, None);
    let archive = Archive::new(&bytes).unwrap();
    let geometry = inside(&hair(&archive).properties().unwrap(), ".geom");
    let arbitrary = inside(&geometry, ".arbGeomParams");
    assert_eq!(
        listed(&arbitrary),
        [
            "clump weight",
            "groom_color",
            "groom_group_id",
            "groom_guide",
            "groom_id",
            "groom_root_uv",
            "transparency"
        ]
    );
    let ints = |name, values: [f32; 3]| {
        assert_eq!(parameter(&arbitrary, name), (DataType::I32, "uni".into(), values.to_vec()));
    };
    ints("groom_id", [7.0, -1.0, 9.0]);
    ints("groom_group_id", [0.0, 0.0, 1.0]);
    ints("groom_guide", [1.0, 0.0, 0.0]);
    let uv = (DataType::F32X2, "uni".to_owned(), vec![0.0, 0.0, 1.0, 1.0, 0.5, 0.25]);
    assert_eq!(parameter(&arbitrary, "groom_root_uv"), uv);
    assert_eq!(parameter(&geometry, "uv"), uv);
    let (of_color, scope, color) = parameter(&arbitrary, "groom_color");
    assert_eq!((of_color, scope.as_str(), &color[6..]), (DataType::F32X3, "uni", &[0.2, 0.4, 0.6][..]));
    let transparency = (DataType::F32, "con".to_owned(), vec![0.25]);
    assert_eq!(parameter(&arbitrary, "transparency"), transparency);
    let widths = (0..8).map(|i| 2.0 * (i as f32 * 0.003)).collect::<Vec<_>>();
    assert_eq!(parameter(&geometry, "width"), (DataType::F32, "vtx".into(), widths));

    let user = inside(&geometry, ".userProperties");
    for (name, number) in [("groom_version_major", 1), ("groom_version_minor", 5)] {
        let version = property(&user, name);
        assert_eq!((version.kind(), version.data_type()), (PropertyKind::Scalar, Some(DataType::I16)));
        assert_eq!(version.sample(0).unwrap().to_vec::<i16>().unwrap(), [number]);
    }
    let tool = property(&user, "groom_tool").sample(0).unwrap();
    assert!(tool.texts().unwrap()[0].starts_with("groomkit "));
    assert_eq!(property(&user, "groomkit_up_axis").sample(0).unwrap().texts().unwrap(), ["y"]);
    let unit = property(&user, "groomkit_meters_per_unit").sample(0).unwrap();
    assert_eq!(unit.to_vec::<f64>().unwrap(), [1.0]);
}

#[test]
fn guides_are_three_whole_numbers_a_strand() {
    let mut groom = full_groom();
    groom.remove_attribute(names::ID);
    // A float has no such number.
    let far = (1 << 24) + 1;
    set(&mut groom, names::CLOSEST_GUIDE, Domain::Strand, Values::Int(vec![2, far, 0]));
    for dialect in [None, Some(Dialect::Unreal)] {
        let bytes = written(&groom, dialect);
        let archive = Archive::new(&bytes).unwrap();
        let geometry = inside(&hair(&archive).properties().unwrap(), ".geom");
        let arbitrary = inside(&geometry, ".arbGeomParams");
        assert!(arbitrary.find(names::CLOSEST_GUIDE).unwrap().is_none());
        let guides = property(&arbitrary, "groom_closest_guides").sample(0).unwrap().to_vec::<i32>().unwrap();
        assert_eq!(guides, [2, 2, 2, far, far, far, 0, 0, 0]);
        let (of_guides, scope, _) = parameter(&arbitrary, "groom_closest_guides");
        assert_eq!((of_guides, scope.as_str()), (DataType::new(Pod::I32, 3), "uni"));
        let weights = (DataType::F32X3, "uni".to_owned(), [1.0, 0.0, 0.0].repeat(3));
        assert_eq!(parameter(&arbitrary, "groom_guide_weights"), weights);
        let ids = (DataType::I32, "uni".to_owned(), vec![0.0, 1.0, 2.0]);
        assert_eq!(parameter(&arbitrary, "groom_id"), ids, "guides are named by their ids");

        let read = from_bytes(Format::Alembic, &bytes).unwrap().groom;
        assert_eq!(read.attribute(names::CLOSEST_GUIDE), groom.attribute(names::CLOSEST_GUIDE));
        assert!(read.attribute("groom_guide_weights").is_none());
    }
    // Other programs' three guides stay whole numbers too.
    let mut groom = full_groom();
    let three = vec![Vec3::new(1.0, 2.0, 0.0), Vec3::ZERO, Vec3::new(-1.0, 2.0, 2.0)];
    set(&mut groom, "groom_closest_guides", Domain::Strand, Values::Vec3(three));
    let bytes = written(&groom, None);
    let archive = Archive::new(&bytes).unwrap();
    let geometry = inside(&hair(&archive).properties().unwrap(), ".geom");
    let (data_type, _, numbers) = parameter(&inside(&geometry, ".arbGeomParams"), "groom_closest_guides");
    assert_eq!((data_type, &numbers[6..]), (DataType::new(Pod::I32, 3), &[-1.0, 2.0, 2.0][..]));
}

#[test]
fn unreal_gets_centimetres_with_z_up_and_its_own_scopes() {
    let mut groom = groomed();
    groom.up_axis = UpAxis::Y;
    groom.meters_per_unit = 0.5;
    set(&mut groom, names::RADIUS, Domain::Strand, Values::Float(vec![0.5, 0.25, 0.125]));
    let bytes = written(&groom, Some(Dialect::Unreal));
    let archive = Archive::new(&bytes).unwrap();
    let geometry = inside(&hair(&archive).properties().unwrap(), ".geom");
    let points = property(&geometry, "P").sample(0).unwrap().to_f32().unwrap();
    let p = groom.positions()[2];
    let turned = [p.x, -p.z, p.y].map(|v| (f64::from(v) * 50.0) as f32);
    assert_eq!(points[6..9], turned);
    assert_eq!(
        property(&geometry, ".velocities").sample(0).unwrap().to_f32().unwrap()[..3],
        [50.0, -150.0, 100.0]
    );
    let width = (DataType::F32, "uni".to_owned(), vec![50.0, 25.0, 12.5]);
    let arbitrary = inside(&geometry, ".arbGeomParams");
    assert_eq!(parameter(&geometry, "width"), width);
    assert_eq!(parameter(&arbitrary, "groom_width"), width);
    let (_, scope, color) = parameter(&arbitrary, "groom_color");
    assert_eq!((scope.as_str(), color.len()), ("vtx", 24), "Unreal's colours are per vertex");
    let user = inside(&geometry, ".userProperties");
    assert_eq!(property(&user, "groomkit_up_axis").sample(0).unwrap().texts().unwrap(), ["z"]);
    let unit = property(&user, "groomkit_meters_per_unit").sample(0).unwrap();
    assert_eq!(unit.to_vec::<f64>().unwrap(), [0.01]);
}

#[test]
fn blender_gets_a_width_a_point_and_nothing_is_made_up() {
    let mut groom = groomed();
    set(&mut groom, names::RADIUS, Domain::Groom, Values::Float(vec![0.5]));
    let bytes = written(&groom, None);
    let archive = Archive::new(&bytes).unwrap();
    let geometry = inside(&hair(&archive).properties().unwrap(), ".geom");
    assert_eq!(parameter(&geometry, "width"), (DataType::F32, "vtx".into(), vec![1.0; 8]));
    let user = inside(&geometry, ".userProperties");
    assert_eq!(property(&user, "groomkit_domains").sample(0).unwrap().texts().unwrap(), ["radius=groom"]);

    let bare = Groom::new(vec![0, 2], vec![Vec3::ZERO, Vec3::X]).unwrap();
    let bytes = written(&bare, None);
    let archive = Archive::new(&bytes).unwrap();
    let geometry = inside(&hair(&archive).properties().unwrap(), ".geom");
    let only = [".selfBnds", "P", "nVertices", "curveBasisAndType", ".userProperties"];
    assert_eq!(listed(&geometry), only);
}

#[test]
fn identical_arrays_stand_once() {
    let (mut one, mut two) = (groomed(), groomed());
    let uvs = vec![Vec2::new(0.1, 0.2); 3];
    set(
        &mut one,
        "another uv",
        Domain::Strand,
        Values::Vec2(vec![Vec2::ZERO, Vec2::ONE, Vec2::new(0.5, 0.25)]),
    );
    set(&mut two, "another uv", Domain::Strand, Values::Vec2(uvs));
    let key_and_length = 8 + 16;
    assert_eq!(written(&one, None).len() + key_and_length + 24, written(&two, None).len());
}

#[test]
fn names_are_made_fit_and_no_strand_is_an_error() {
    let mut groom = full_groom();
    set(&mut groom, "a/b", Domain::Groom, Values::Int(vec![1]));
    set(&mut groom, "groom_id", Domain::Groom, Values::Int(vec![2]));
    let (_, warnings) = crate::support::to_bytes(Format::Alembic, &groom).unwrap();
    let renamed = |name: &str, written: &str| Warning::AttributeRenamed {
        format: Format::Alembic,
        name: name.into(),
        written: written.into(),
    };
    assert_eq!(warnings, [renamed("a/b", "a_b"), renamed("groom_id", "groom_id_2")]);
    let none = Groom::new(vec![0], vec![]).unwrap();
    assert!(matches!(crate::support::to_bytes(Format::Alembic, &none), Err(FormatError::Empty { .. })));
}
