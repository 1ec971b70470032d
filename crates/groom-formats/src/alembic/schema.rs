//! Names of Alembic's schemas (`AbcGeom` 1.8) and of Unreal's groom schema, for writer and reader alike.
//!
//! Unreal: "Using Alembic for Grooms", dev.epicgames.com/documentation, version 1.5 of the schema.

use groom::{Domain, names};
use ogawa::{DataType, Metadata, Pod};

/// The schema of curves.
pub(super) const CURVES: &str = "AbcGeom_Curve_v2";
/// The schema of transforms.
pub(super) const XFORM: &str = "AbcGeom_Xform_v3";
/// The compound in which a transform stands, and its parts.
pub(super) const XFORM_COMPOUND: &str = ".xform";
pub(super) const INHERITS: &str = ".inherits";
pub(super) const OPERATIONS: &str = ".ops";
pub(super) const CHANNELS: &str = ".vals";
pub(super) const NOT_IDENTITY: &str = "isNotConstantIdentity";
/// The operation that moves by three numbers.
pub(super) const TRANSLATE: u8 = 1 << 4;
/// The compound in which an object's schema stands.
pub(super) const GEOMETRY: &str = ".geom";
pub(super) const ARBITRARY: &str = ".arbGeomParams";
pub(super) const USER: &str = ".userProperties";
pub(super) const POINTS: &str = "P";
pub(super) const COUNTS: &str = "nVertices";
pub(super) const KIND: &str = "curveBasisAndType";
pub(super) const SELF_BOUNDS: &str = ".selfBnds";
pub(super) const CHILD_BOUNDS: &str = ".childBnds";
pub(super) const VELOCITIES: &str = ".velocities";
pub(super) const WIDTH: &str = "width";
pub(super) const UV: &str = "uv";

pub(super) const GROOM_WIDTH: &str = "groom_width";
pub(super) const GROOM_ROOT_UV: &str = "groom_root_uv";
/// Ids of the three guides a strand follows, `int32[3]` per strand, and how much it follows each: `float[3]`.
pub(super) const CLOSEST_GUIDES: &str = "groom_closest_guides";
pub(super) const GUIDE_WEIGHTS: &str = "groom_guide_weights";
pub(super) const THREE_GUIDES: DataType = DataType::new(Pod::I32, 3);
/// The weights of a strand that follows one guide.
pub(super) const ONE_GUIDE: [f32; 3] = [1.0, 0.0, 0.0];
pub(super) const VERSION_MAJOR: (&str, i16) = ("groom_version_major", 1);
pub(super) const VERSION_MINOR: (&str, i16) = ("groom_version_minor", 5);
pub(super) const TOOL: &str = "groom_tool";

/// Ours: `y` or `z`. Not `groom_`: Unreal takes those for its own.
pub(super) const UP_AXIS: &str = "groomkit_up_axis";
/// Ours: metres in a unit.
pub(super) const METERS_PER_UNIT: &str = "groomkit_meters_per_unit";
/// Ours: attributes that were spread over the points, as `radius=strand,color=groom`.
pub(super) const DOMAINS: &str = "groomkit_domains";
/// Frames a second, in the archive's metadata (`kDCCFPSKey`).
pub(super) const FRAME_RATE: &str = "_ai_DCC_FPS";
/// The same, and what Blender calls it.
pub(super) const FRAME_RATES: [&str; 2] = [FRAME_RATE, "FramesPerTimeUnit"];

/// What `groom_id` is called, which guides are named by.
pub(super) const GROOM_ID: &str = "groom_id";

/// Standard attributes and their names among the arbitrary parameters. Transparency keeps its own: Unreal
/// has none.
pub(super) const PARAMETERS: [(&str, &str); 5] = [
    (names::COLOR, "groom_color"),
    (names::ID, GROOM_ID),
    (names::GROUP, "groom_group_id"),
    (names::GUIDE, "groom_guide"),
    (names::ROOT_UV, GROOM_ROOT_UV),
];

/// Metadata of a Curves object, and of its geometry.
pub(super) fn curves() -> (Metadata, Metadata) {
    let base = Metadata::new().with("schema", CURVES).with("schemaBaseType", "AbcGeom_GeomBase_v1");
    (base.clone().with("schemaObjTitle", &format!("{CURVES}:{GEOMETRY}")), base)
}

/// Metadata of a transform's object, and of its compound.
pub(super) fn xform() -> (Metadata, Metadata) {
    let base = Metadata::new().with("schema", XFORM);
    (base.clone().with("schemaObjTitle", &format!("{XFORM}:{XFORM_COMPOUND}")), base)
}

/// What a scope is called.
pub(super) fn scope(domain: Domain) -> &'static str {
    match domain {
        Domain::Groom => "con",
        Domain::Strand => "uni",
        Domain::Vertex => "vtx",
    }
}

/// Metadata of a geometry parameter, as `OGeomParam` writes it.
pub(super) fn parameter(data_type: DataType, domain: Domain) -> Metadata {
    let number = match data_type.pod {
        Pod::I32 => "int32_t",
        _ => "float32_t",
    };
    // Unreal looks for vectors, also in `groom_color` and `groom_closest_guides`, and refuses what is called anything else.
    let meaning = if data_type.extent > 1 { "vector" } else { "" };
    Metadata::new()
        .with("arrayExtent", "1")
        .with("geoScope", scope(domain))
        .with("interpretation", meaning)
        .with("isGeomParam", "true")
        .with("podExtent", &data_type.extent.to_string())
        .with("podName", number)
}
