//! What a pipeline file may say, as a JSON Schema (draft 2020-12): editors complete and check by it.
//!
//! The structs of this folder are where it comes from; added are the keys that put a file together (`include`,
//! `variables`, `matrix`) and that a `${name}` may stand for any value.

use schemars::generate::SchemaSettings;
use serde_json::{Map, Value, json};

use super::Pipeline;

/// The file the schema is kept in, beside the pipelines that name it.
const FILE: &str = "turntable.schema.json";

/// The schema of a pipeline file, its keys sorted.
#[must_use]
pub fn json_schema() -> Value {
    let generator = SchemaSettings::draft2020_12().into_generator();
    let mut root = generator.into_root_schema_for::<Pipeline>().to_value();
    let defs = take(&mut root, "$defs").unwrap_or_else(|| json!({}));
    let mut defs = match defs {
        Value::Object(defs) => defs,
        _ => Map::new(),
    };
    let known = defs.clone();
    defs.values_mut().for_each(|schema| open_to_variables(schema, &known));
    open_to_variables(&mut root, &known);
    defs.insert("patch".to_owned(), patch(&root));
    add_composing(&mut root);
    defs.extend(composing_defs());
    let (id, title) = (json!(FILE), json!("A turntable pipeline"));
    if let Value::Object(root) = &mut root {
        root.extend([("$id".to_owned(), id), ("title".to_owned(), title), ("$defs".to_owned(), defs.into())]);
    }
    sorted(root)
}

/// The schema as it is kept in a file.
#[must_use]
pub fn json_schema_text() -> String {
    format!("{:#}\n", json_schema())
}

fn take(schema: &mut Value, key: &str) -> Option<Value> {
    schema.as_object_mut()?.remove(key)
}

/// The keys of a pipeline that a setting of an axis may change.
fn patch(root: &Value) -> Value {
    let of_all = ["version", "name", "output", "sheet", "page"];
    let properties = root.get("properties").and_then(Value::as_object);
    let names = properties.into_iter().flat_map(Map::keys).filter(|key| !of_all.contains(&key.as_str()));
    let named = names.map(|key| (key.clone(), json!({"$ref": format!("#/properties/{key}")})));
    let mut properties: Map<String, Value> = named.collect();
    properties.insert("variables".to_owned(), json!({"$ref": "#/$defs/variables"}));
    json!({
        "description": "The keys of the pipeline that a setting changes; mappings are merged, anything else is replaced.",
        "type": ["object", "null"],
        "properties": properties,
        "additionalProperties": false,
    })
}

/// The keys that put a file together.
fn add_composing(root: &mut Value) {
    let Some(properties) = root.get_mut("properties").and_then(Value::as_object_mut) else { return };
    let path = json!({"type": "string", "minLength": 1});
    let include = json!({
        "description": "Files to lie below this one, relative to it: one path or a list. Keys of this file lie over \
            theirs, later files over earlier; mappings merge, lists and single values replace.",
        "anyOf": [path, {"type": "array", "items": path}, {"type": "null"}],
    });
    let matrix = json!({
        "description": "Axes of named settings: every combination of one setting of each axis is rendered. Each \
            setting changes keys of the pipeline.",
        "type": ["object", "null"],
        "properties": {"exclude": {"$ref": "#/$defs/exclude"}},
        "additionalProperties": {"$ref": "#/$defs/axis"},
    });
    properties.insert("include".to_owned(), include);
    properties.insert("variables".to_owned(), json!({"$ref": "#/$defs/variables"}));
    properties.insert("matrix".to_owned(), matrix);
}

fn composing_defs() -> Map<String, Value> {
    // As `expand::matrix` has it, in words that every dialect of patterns knows: no sign but `+`, `-` and `_`, and a
    // point only before a digit.
    let letter = r"[^\s!-*,./:-@\[-^`{-~]";
    let name = format!(r"^{letter}({letter}|\.[0-9])*$");
    let scalar = json!({"type": ["string", "number", "boolean"]});
    let defs = json!({
        "variable": {
            "description": "A variable in place of the value.",
            "type": "string",
            "pattern": "^\\$\\{[A-Za-z_][A-Za-z0-9_-]*\\}$",
        },
        "variables": {
            "description": "Names for values: `${name}` in any text stands for the value, `$${` for a plain `${`. A \
                text that is nothing but `${name}` takes the value's type. Variables may use each other.",
            "type": ["object", "null"],
            "propertyNames": {"pattern": "^[A-Za-z_][A-Za-z0-9_-]*$"},
        },
        "axis": {
            "description": "Names of settings with the keys each changes, or one key and the values it takes.",
            "anyOf": [
                {
                    "type": "object",
                    "required": ["key", "values"],
                    "properties": {
                        "key": {"description": "The key that changes, as `render.spp`.", "type": "string"},
                        "values": {
                            "description": "Its values, which are their own names; or names with values.",
                            "anyOf": [
                                {"type": "array", "minItems": 1, "items": scalar},
                                {"type": "object", "minProperties": 1, "propertyNames": {"pattern": &name}},
                            ],
                        },
                    },
                    "additionalProperties": false,
                },
                {
                    "type": "object",
                    "minProperties": 1,
                    "propertyNames": {"pattern": &name},
                    "additionalProperties": {"$ref": "#/$defs/patch"},
                },
            ],
        },
        "exclude": {
            "description": "Combinations to leave out: axes with the name of a setting, or a list of names.",
            "type": ["array", "null"],
            "items": {
                "type": "object",
                "minProperties": 1,
                "additionalProperties": {"anyOf": [scalar, {"type": "array", "items": scalar}]},
            },
        },
    });
    match defs {
        Value::Object(defs) => defs,
        _ => Map::new(),
    }
}

/// Lets a `${name}` stand for every value below `schema`, and nothing for keys and lists.
fn open_to_variables(schema: &mut Value, defs: &Map<String, Value>) {
    let Some(object) = schema.as_object_mut() else { return };
    for (key, below) in object.iter_mut() {
        match (key.as_str(), below) {
            ("properties", Value::Object(properties)) => {
                properties.values_mut().for_each(|schema| open(schema, defs));
            }
            ("items" | "additionalProperties", below @ Value::Object(_)) => open(below, defs),
            ("prefixItems", Value::Array(items)) => items.iter_mut().for_each(|schema| open(schema, defs)),
            ("anyOf" | "oneOf", Value::Array(kinds)) => {
                kinds.iter_mut().for_each(|schema| open_to_variables(schema, defs));
            }
            _ => {}
        }
    }
}

/// What is told of a value, whatever kind it is.
const TOLD: [&str; 2] = ["description", "default"];

fn open(schema: &mut Value, defs: &Map<String, Value>) {
    open_to_variables(schema, defs);
    if is_text(schema) {
        if schema.get("default").is_some_and(|default| !is_told(default)) {
            take(schema, "default");
        }
        return;
    }
    let Some(object) = schema.as_object_mut() else { return };
    let mut outer = Map::new();
    for key in TOLD {
        outer.extend(object.remove(key).filter(is_told).map(|value| (key.to_owned(), value)));
    }
    let mut kinds = match object.remove("anyOf") {
        Some(Value::Array(kinds)) if object.is_empty() => kinds,
        Some(kinds) => {
            object.insert("anyOf".to_owned(), kinds);
            vec![Value::Object(std::mem::take(object))]
        }
        None => vec![Value::Object(std::mem::take(object))],
    };
    let null = json!({"type": "null"});
    if kinds.iter().any(|kind| holds_more(kind, defs)) && !kinds.contains(&null) {
        kinds.push(null);
    }
    kinds.push(json!({"$ref": "#/$defs/variable"}));
    outer.insert("anyOf".to_owned(), Value::Array(kinds));
    *schema = Value::Object(outer);
}

/// Whether a default says more than its keys do.
fn is_told(default: &Value) -> bool {
    !default.is_null() && !default.is_object()
}

/// Whether any text will do: names with variables in them will, then.
fn is_text(schema: &Value) -> bool {
    let words = schema.get("enum").is_some() || schema.get("const").is_some();
    let kind = schema.get("type");
    !words && (kind == Some(&json!("string")) || kind == Some(&json!(["string", "null"])))
}

/// Whether it is keys and values or a list: nothing stands for an empty one.
fn holds_more(schema: &Value, defs: &Map<String, Value>) -> bool {
    let named = schema.get("$ref").and_then(Value::as_str).and_then(|path| path.strip_prefix("#/$defs/"));
    let schema = named.and_then(|name| defs.get(name)).unwrap_or(schema);
    // Lists of a fixed length cannot be empty.
    let open_list = schema.get("type") == Some(&json!("array")) && schema.get("minItems").is_none();
    schema.get("type") == Some(&json!("object")) || open_list
}

/// The same with its keys in order, whatever order the map keeps.
fn sorted(value: Value) -> Value {
    match value {
        Value::Object(map) => {
            let mut entries: Vec<(String, Value)> =
                map.into_iter().map(|(key, value)| (key, sorted(value))).collect();
            entries.sort_by(|(a, _), (b, _)| a.cmp(b));
            Value::Object(entries.into_iter().collect())
        }
        Value::Array(list) => Value::Array(list.into_iter().map(sorted).collect()),
        other => other,
    }
}

#[cfg(test)]
mod tests;
