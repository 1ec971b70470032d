//! A pipeline as a list of keys and values.

use serde_json::Value;

use crate::schema::Pipeline;

/// Everything that a variant was made with, defaults spelled out; what is not there is left out.
pub(super) fn parameters(pipeline: &Pipeline) -> Vec<(String, String)> {
    let mut out = Vec::new();
    // Plain structs always serialise; without it the table is empty.
    if let Ok(value) = serde_json::to_value(pipeline) {
        flatten("", &value, &mut out);
    }
    out
}

fn flatten(key: &str, value: &Value, out: &mut Vec<(String, String)>) {
    let below = |name: &str| if key.is_empty() { name.to_owned() } else { format!("{key}.{name}") };
    match value {
        Value::Null => {}
        Value::Object(fields) => fields.iter().for_each(|(name, value)| flatten(&below(name), value, out)),
        Value::Array(items) if items.iter().any(|item| item.is_object() || item.is_array()) => {
            items.iter().enumerate().for_each(|(index, item)| flatten(&below(&index.to_string()), item, out));
        }
        Value::Array(items) if items.is_empty() => {}
        Value::Array(items) => {
            out.push((key.to_owned(), items.iter().map(words).collect::<Vec<_>>().join(", ")))
        }
        value => out.push((key.to_owned(), words(value))),
    }
}

fn words(value: &Value) -> String {
    match value {
        Value::String(words) => words.clone(),
        // A float that was read in single precision says no digits it does not have.
        Value::Number(number) => match number.as_f64() {
            Some(value) if !number.is_i64() && !number.is_u64() => format!("{}", value as f32),
            _ => number.to_string(),
        },
        value => value.to_string(),
    }
}
