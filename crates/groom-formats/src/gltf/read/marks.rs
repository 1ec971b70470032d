//! What `extras.groomkit` of a mesh says of its attributes.

use std::collections::BTreeMap;

use gltf::Document;
use gltf::json::{Value, deserialize};
use groom::Domain;

/// What an attribute was before it was written.
#[derive(Debug, PartialEq)]
pub(super) struct Mark {
    pub(super) name: String,
    pub(super) domain: Domain,
    pub(super) is_int: bool,
}

/// The marks of all meshes by the name in the file; none where extras are somebody else's.
pub(super) fn of(document: &Document) -> BTreeMap<String, Mark> {
    let mut marks = BTreeMap::new();
    for extras in document.meshes().filter_map(|mesh| mesh.extras().as_ref()) {
        let value: Option<Value> = deserialize::from_str(extras.get()).ok();
        let Some(Value::Object(found)) = value.as_ref().and_then(|value| value.get("groomkit")) else {
            continue;
        };
        for (written, mark) in found {
            if let Some(mark) = one(mark) {
                marks.entry(written.clone()).or_insert(mark);
            }
        }
    }
    marks
}

fn one(mark: &Value) -> Option<Mark> {
    let word = |key: &str| mark.get(key).and_then(Value::as_str);
    let domain = match word("domain")? {
        "groom" => Domain::Groom,
        "strand" => Domain::Strand,
        "vertex" => Domain::Vertex,
        _ => return None,
    };
    Some(Mark { name: word("name")?.to_owned(), domain, is_int: word("type") == Some("int") })
}
