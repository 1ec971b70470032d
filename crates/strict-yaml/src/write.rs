//! Plain structs as YAML.

use serde::Serialize;
use serde_yaml::Value;

/// The YAML of `value`, which reads back to the same: a `${` in its texts is written `$${`.
///
/// # Errors
/// Words, where `value` holds what YAML cannot say.
pub fn write(value: &impl Serialize) -> Result<String, String> {
    changed(value, escape)
}

/// As [`write()`], without the keys that hold nothing: it reads back to the same where absent keys mean nothing.
///
/// # Errors
/// As [`write()`].
pub fn write_brief(value: &impl Serialize) -> Result<String, String> {
    changed(value, |tree| {
        drop_empty(tree);
        escape(tree);
    })
}

fn changed(value: &impl Serialize, change: impl Fn(&mut Value)) -> Result<String, String> {
    // By way of a text, so that a short decimal number stays the short one it was in 32 bits.
    let text = serde_yaml::to_string(value).map_err(|error| error.to_string())?;
    let mut tree: Value = serde_yaml::from_str(&text).map_err(|error| error.to_string())?;
    change(&mut tree);
    serde_yaml::to_string(&tree).map_err(|error| error.to_string())
}

fn drop_empty(value: &mut Value) {
    match value {
        Value::Mapping(map) => {
            map.retain(|_, value| !value.is_null());
            map.iter_mut().for_each(|(_, value)| drop_empty(value));
        }
        Value::Sequence(list) => list.iter_mut().for_each(drop_empty),
        _ => {}
    }
}

fn escape(value: &mut Value) {
    match value {
        Value::String(text) => *text = text.replace("${", "$${"),
        Value::Sequence(list) => list.iter_mut().for_each(escape),
        Value::Mapping(map) => map.iter_mut().for_each(|(_, value)| escape(value)),
        Value::Tagged(tagged) => escape(&mut tagged.value),
        Value::Null | Value::Bool(_) | Value::Number(_) => {}
    }
}
