//! Plain structs as YAML.

use serde::Serialize;
use serde_yaml::Value;

/// The YAML of `value`, which reads back to the same: a `${` in its texts is written `$${`.
///
/// # Errors
/// Words, where `value` holds what YAML cannot say.
pub fn write(value: &impl Serialize) -> Result<String, String> {
    // By way of a text, so that a short decimal number stays the short one it was in 32 bits.
    let text = serde_yaml::to_string(value).map_err(|error| error.to_string())?;
    if !text.contains("${") {
        return Ok(text);
    }
    let mut tree: Value = serde_yaml::from_str(&text).map_err(|error| error.to_string())?;
    escape(&mut tree);
    serde_yaml::to_string(&tree).map_err(|error| error.to_string())
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
