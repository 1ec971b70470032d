//! Any texts as a document of files that may include each other, with variables, settings and a matrix of them.
#![no_main]

use std::path::Path;

use libfuzzer_sys::fuzz_target;
use strict_yaml::{Document, Setting};

/// The texts, apart by a byte that no text has: the file, those it may include as `b` and `c`, and a setting.
const NAMES: [&str; 3] = ["a", "b", "c"];

fuzz_target!(|bytes: &[u8]| {
    let texts: Vec<&[u8]> = bytes.splitn(4, |&byte| byte == 0xff).collect();
    let load = |path: &Path| {
        let index = NAMES.iter().position(|name| path == Path::new(name));
        let text = index.and_then(|index| texts.get(index));
        text.map(|text| text.to_vec()).ok_or_else(|| std::io::ErrorKind::NotFound.into())
    };
    let Ok(mut document) = Document::open_with(Path::new("a"), &load) else { return };
    if let Some(setting) = texts.get(3).and_then(|text| std::str::from_utf8(text).ok()) {
        let _ = document.lay(&Setting::set(setting));
    }
    if let Some(patch) = document.take("matrix") {
        document.lay_over(&patch);
        document.take("include");
    }
    let Ok((mut document, _)) = document.with_variables() else { return };
    document.join_folders(&["a", "b.*", "b.*.c"]);
    let reading = document.read::<serde_json::Value>();
    // What could be read can be written, and reads back to the same.
    if let Some(value) = reading.value.filter(|value| depth(value) < 100) {
        let written = strict_yaml::write(&value).expect("JSON is YAML");
        // Variables may make more of a text than a file may hold.
        if written.len() > 1 << 20 || written.matches(['[', '{']).count() > 128 {
            return;
        }
        let again = Document::open_with(Path::new("a"), &|_| Ok(written.clone().into_bytes()));
        let again = again.expect("what was written can be read").with_variables().expect("no variables").0;
        assert_eq!(again.read::<serde_json::Value>().value, Some(value), "{written}");
    }
});

/// The YAML library reads no more than 128 values below each other.
fn depth(value: &serde_json::Value) -> usize {
    match value {
        serde_json::Value::Array(list) => 1 + list.iter().map(depth).max().unwrap_or_default(),
        serde_json::Value::Object(map) => 1 + map.values().map(depth).max().unwrap_or_default(),
        _ => 0,
    }
}
