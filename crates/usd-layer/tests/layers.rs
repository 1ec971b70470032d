//! What a layer holds, from a text and from a crate of the same.

#![allow(clippy::unwrap_used, clippy::expect_used, missing_docs)]

use usd_layer::{Layer, Place, Specifier, Value};

const TEXT: &[u8] = include_bytes!("data/small.usda");
/// `small.usda` exported by usd-core 26.11.
const CRATE: &[u8] = include_bytes!("data/small.usdc");

/// A package with one file, stored.
fn package(layer: &[u8]) -> Vec<u8> {
    let mut bytes = b"PK\x03\x04\x0a\0\0\0\0\0\0\0\0\0".to_vec();
    bytes.extend([0; 4]);
    bytes.extend((layer.len() as u32).to_le_bytes());
    bytes.extend((layer.len() as u32).to_le_bytes());
    bytes.extend([6, 0, 28, 0]);
    bytes.extend(b"a.usdc");
    bytes.extend([0; 28]);
    bytes.extend(layer);
    bytes.extend(b"PK\x01\x02 and so on");
    bytes
}

fn each(check: impl Fn(&Layer<&[u8]>)) {
    let package = package(CRATE);
    for bytes in [TEXT, CRATE, &package[..]] {
        check(&Layer::read(bytes).unwrap());
    }
}

fn value<'a>(layer: &'a Layer<&[u8]>, path: &str, attribute: &str) -> &'a Value {
    layer.prim(path).unwrap().attribute(attribute).unwrap().default.as_ref().unwrap()
}

#[test]
fn metadata() {
    each(|layer| {
        let text = |name| layer.metadata(name).unwrap().text().unwrap().to_owned();
        assert_eq!(
            (text("defaultPrim"), text("upAxis"), text("documentation")),
            ("Groom".into(), "Z".into(), "Two\nlines".into())
        );
        assert_eq!(text("comment"), "A comment");
        assert_eq!(layer.metadata("metersPerUnit").unwrap().number(), Some(0.01));
        let data = layer.metadata("customLayerData").unwrap();
        assert_eq!(data.entry("maker").unwrap().text(), Some("a \"test\""));
        let inner = data.entry("inner").unwrap();
        assert_eq!(inner.entry("number"), Some(&Value::Int(7)));
        assert_eq!(layer.numbers::<f64>(inner.entry("list").unwrap()).unwrap(), [1.0, 2.5]);
        let Value::List(layers) = layer.metadata("subLayers").unwrap() else { panic!("no list") };
        assert_eq!(layers.items().map(|layer| layer.text().unwrap()).collect::<Vec<_>>(), ["other.usda"]);
    });
}

#[test]
fn prims() {
    each(|layer| {
        let groom = layer.prim("/Groom").unwrap();
        assert_eq!((groom.specifier, &*groom.type_name), (Specifier::Def, "Xform"));
        let Some(Value::List(schemas)) = groom.metadata("apiSchemas") else { panic!("no list") };
        assert_eq!(
            schemas.prepended.iter().map(|schema| schema.text().unwrap()).collect::<Vec<_>>(),
            ["GroomAPI"]
        );
        let Some(Value::List(references)) = groom.metadata("references") else { panic!("no list") };
        let Value::Reference(reference) = &references.prepended[0] else { panic!("no reference") };
        assert_eq!((&*reference.asset, &*reference.prim), ("a@b.usda", "/Prim"));
        let children: Vec<_> = groom.children.iter().map(|prim| &*prim.name).collect();
        assert_eq!(children, ["Strands", "Other", "Kind", "Only"]);
        let other = layer.prim("/Groom/Other").unwrap();
        assert!(!other.is_active() && other.specifier == Specifier::Over);
        assert_eq!(other.relationship("many").unwrap().targets.as_ref().unwrap().items().count(), 2);
        assert_eq!(other.relationship("fewer").unwrap().targets.as_ref().unwrap().deleted.len(), 1);
        assert_eq!(layer.prim("/Groom/Kind").unwrap().specifier, Specifier::Class);
    });
}

#[test]
fn the_selected_variant_is_part_of_the_prim() {
    each(|layer| {
        let shade = value(layer, "/Groom", "shade").components().unwrap();
        assert_eq!(shade, [1.0, 0.0, 0.0]);
        assert_eq!(value(layer, "/Groom/Only", "a"), &Value::Int(-3));
        let left: Vec<_> =
            layer.prim("/Groom").unwrap().variant_sets.iter().flat_map(|set| &set.variants).collect();
        assert_eq!(left.iter().map(|variant| &*variant.name).collect::<Vec<_>>(), ["blue"]);
    });
}

#[test]
fn attributes() {
    each(|layer| {
        let strands = "/Groom/Strands";
        let prim = layer.prim(strands).unwrap();
        let points = prim.attribute("points").unwrap();
        assert_eq!(&*points.type_name, "point3f[]");
        assert_eq!(layer.values::<f32, 3>(points.default.as_ref().unwrap()).unwrap()[2], [0.5, 1e-3, -2.0]);
        let samples = points.samples.as_ref().unwrap();
        assert_eq!(samples.times, [0.0, 1.5, 2.0]);
        assert_eq!(layer.values::<f32, 3>(&samples.values[1]).unwrap(), [[0.0, 0.0, 1.0], [0.0, 1.0, 1.0]]);
        assert_eq!(samples.values[2], Value::Blocked);
        assert_eq!((points.held(Some(2.0)), points.held(Some(-1.0))), (None, Some(&samples.values[0])));
        assert_eq!(prim.attribute("primvars:displayColor").unwrap().interpolation(), Some("constant"));
        assert_eq!(layer.numbers::<i32>(value(layer, strands, "curveVertexCounts")).unwrap(), [3; 16]);
        let widths = layer.numbers::<f32>(value(layer, strands, "widths")).unwrap();
        assert_eq!(widths[16..], [0.5, 0.25, 1e-7, 0.125]);
        assert_eq!(
            layer.values::<f32, 3>(value(layer, strands, "primvars:halves")).unwrap()[1],
            [1.0, 2.0, 3.0]
        );
        assert_eq!(
            layer.values::<f64, 4>(value(layer, strands, "primvars:turns")).unwrap()[1],
            [0.5, 0.25, 0.0, -1.0]
        );
        assert_eq!(value(layer, strands, "turn").components().unwrap(), [1.0, 0.0, 0.5, 0.0]);
        assert_eq!(
            layer.numbers::<i64>(value(layer, strands, "primvars:long")).unwrap(),
            [1, -9_000_000_000, 3]
        );
        assert!(layer.numbers::<i32>(value(layer, strands, "primvars:long")).is_err());
        let names = layer.texts(value(layer, strands, "primvars:names")).unwrap();
        assert_eq!(names.iter().map(|name| &**name).collect::<Vec<_>>(), ["a]", "b\"", "c\n"]);
        assert!(prim.attribute("type").unwrap().uniform && !points.uniform);
        assert_eq!(value(layer, strands, "picture"), &Value::Asset("p.png".into()));
        let connections = prim.attribute("inputs:a").unwrap().connections.clone().unwrap();
        assert_eq!(connections.items().next().unwrap().text(), Some("/Groom/Looks/Hair.outputs:b"));
        assert!(!prim.attribute("empty").unwrap().has_value());
        let binding = prim.relationship("material:binding").unwrap().targets.clone().unwrap();
        assert_eq!(binding.items().next().unwrap().text(), Some("/Groom/Looks/Hair"));
        let matrix = value(layer, "/Groom", "xformOp:transform").components().unwrap();
        assert_eq!((matrix[0], &matrix[12..]), (1.0, &[4.0, 5.0, 6.0, 1.0][..]));
        let order = layer.texts(value(layer, "/Groom", "xformOpOrder")).unwrap();
        assert_eq!(&*order[1], "xformOp:transform");
    });
}

#[test]
fn packages_that_are_not_stored_are_refused() {
    let mut bytes = package(TEXT);
    bytes[8] = 8;
    let error = Layer::read(&bytes[..]).unwrap_err();
    assert_eq!((error.place, &*error.found), (Place::Byte(8), "compression 8"));
    let bytes = package(TEXT);
    assert!(Layer::read(&bytes[..bytes.len() - 40]).is_err());
}
