use std::path::Path;

use super::*;
use crate::expand::of_text;

#[test]
fn the_schema_that_is_kept_is_what_the_structs_say() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../pipelines").join(FILE);
    if std::env::var_os("GROOMKIT_BLESS").is_some() {
        std::fs::write(&path, json_schema_text()).unwrap();
    }
    let kept = std::fs::read_to_string(&path).unwrap_or_default().replace('\r', "");
    assert!(
        kept == json_schema_text(),
        "run `turntable schema > pipelines/{FILE}`: the keys of pipelines have changed"
    );
}

/// Every number of the schema that stands alone at its key: the key and its bounds (least, most, whether they are in
/// it themselves).
fn bounds() -> Vec<(String, Value)> {
    let root = json_schema();
    let mut found = Vec::new();
    walk(&root, &root, "", 0, &mut found);
    found
}

fn walk(root: &Value, schema: &Value, key: &str, depth: u32, found: &mut Vec<(String, Value)>) {
    if depth > 12 {
        return;
    }
    if let Some(name) = schema["$ref"].as_str() {
        let name = name.strip_prefix("#/$defs/").unwrap();
        return walk(root, &root["$defs"][name], key, depth + 1, found);
    }
    let bounded = ["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"];
    if bounded.iter().any(|bound| schema.get(bound).is_some()) {
        found.push((key.to_owned(), schema.clone()));
    }
    for kind in schema["anyOf"].as_array().into_iter().flatten() {
        walk(root, kind, key, depth + 1, found);
    }
    let composing = ["matrix", "include", "variables"];
    for (name, below) in schema["properties"].as_object().into_iter().flatten() {
        if !composing.contains(&name.as_str()) {
            let key = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
            walk(root, below, &key, depth + 1, found);
        }
    }
}

#[test]
fn the_bounds_an_editor_knows_are_those_the_program_holds_to() {
    let good = "version: 1\ngroom: {sample: {}}\nlights: {environment: {studio: true}}\n";
    let faults = |key: &str, value: f64| {
        // Some keys are nothing without another.
        let beside = match key {
            "groom.sample.length" | "groom.sample.lean" | "groom.sample.curl" | "groom.sample.clump" => {
                "groom.sample.style=fur"
            }
            "material.groom.redness" => "material.groom.melanin=0.5",
            "material.nodes" => "material.field=far",
            "material.redness" | "material.variation.redness" => "material.melanin=0.5",
            "material.variation.hue" => "material.color=[0.5, 0.4, 0.3]",
            _ => "name=bounds",
        };
        let found = of_text(good, &[beside, &format!("{key}={value}")]).err().unwrap_or_default();
        let at = |fault: &&crate::Fault| fault.key == key && !fault.message.starts_with("needs");
        found.iter().filter(at).map(ToString::to_string).collect::<Vec<_>>()
    };
    let bounds = bounds();
    assert!(bounds.len() > 40, "{}", bounds.len());
    for (key, schema) in bounds {
        let whole = schema["type"] == "integer" || schema["type"][0] == "integer";
        let beside = if whole { 1.0 } else { 1e-3 };
        let hold = |bound: &str, inside: f64| {
            let Some(limit) = schema[bound].as_f64() else { return };
            let (limit_is_in, outside) = (!bound.starts_with("exclusive"), limit - inside * beside);
            assert_ne!(faults(&key, outside), [""; 0], "{key}: {outside} is out of bounds");
            let in_it = if limit_is_in { limit } else { limit + inside * beside };
            assert_eq!(faults(&key, in_it), [""; 0], "{key}: {in_it} is within bounds");
            if !limit_is_in {
                assert_ne!(faults(&key, limit), [""; 0], "{key}: {limit} is out of bounds");
            }
        };
        hold("minimum", 1.0);
        hold("exclusiveMinimum", 1.0);
        hold("maximum", -1.0);
        hold("exclusiveMaximum", -1.0);
    }
}

#[test]
fn every_object_is_closed_and_every_key_is_described() {
    let root = json_schema();
    let named = root["$defs"].as_object().unwrap().iter().map(|(name, schema)| (name.as_str(), schema));
    for (name, schema) in named.chain([("the pipeline", &root)]) {
        let Some(properties) = schema["properties"].as_object() else { continue };
        assert_eq!(schema["additionalProperties"], false, "{name}");
        for (key, below) in properties {
            let described = below.get("description").is_some() || below.get("$ref").is_some();
            assert!(described, "{name}: {key}");
        }
    }
}
