//! Files cut short, with bytes changed, or made of anything: refused with a place, and never more than refused.

#![allow(clippy::unwrap_used, clippy::expect_used, missing_docs)]

use proptest::prelude::*;
use usd_layer::{Layer, Place, Prim, ReadError, Value};

const TEXT: &[u8] = include_bytes!("data/small.usda");
/// `small.usda` exported by usd-core 26.11.
const CRATE: &[u8] = include_bytes!("data/small.usdc");

/// Everything the file holds; how many values there are.
fn read_all(bytes: &[u8]) -> Result<usize, ReadError> {
    let layer = Layer::read(bytes)?;
    layer.prims.iter().try_fold(0, |sum, prim| Ok(sum + read_prim(&layer, prim)?))
}

fn read_prim(layer: &Layer<&[u8]>, prim: &Prim) -> Result<usize, ReadError> {
    let mut sum = 0;
    for attribute in &prim.attributes {
        let samples = attribute.samples.iter().flat_map(|samples| &samples.values);
        for value in attribute.default.iter().chain(samples) {
            sum += read_value(layer, value)?;
        }
    }
    for child in prim.children.iter().chain(prim.variant_sets.iter().flat_map(|set| &set.variants)) {
        sum += read_prim(layer, child)?;
    }
    Ok(sum)
}

fn read_value(layer: &Layer<&[u8]>, value: &Value) -> Result<usize, ReadError> {
    let Value::Array(array) = value else { return Ok(1) };
    Ok(match (array.element.scalar.is_text(), array.element.components) {
        (true, _) => layer.texts(value)?.len(),
        (_, 1) => layer.numbers::<f64>(value)?.len(),
        (_, 2) => layer.values::<f64, 2>(value)?.len(),
        (_, 3) => layer.values::<f32, 3>(value)?.len(),
        (_, 4) => layer.values::<f32, 4>(value)?.len(),
        (_, 9) => layer.values::<f64, 9>(value)?.len(),
        _ => layer.values::<f64, 16>(value)?.len(),
    })
}

#[test]
fn the_files_are_whole() {
    assert_eq!(read_all(TEXT).unwrap(), read_all(CRATE).unwrap());
}

#[test]
fn every_shorter_text_is_refused_but_at_its_end() {
    let last = TEXT.iter().rposition(|&byte| byte == b'}').unwrap();
    for len in 0..=last {
        // What ends behind the first line or behind the layer's metadata is a layer.
        let kept = TEXT[..len].trim_ascii_end();
        match read_all(&TEXT[..len]) {
            Ok(_) => assert!(kept.len() <= 9 || kept.ends_with(b"\n)"), "{len}"),
            Err(error) => assert!(matches!(error.place, Place::Line { .. }), "{error}"),
        }
    }
}

#[test]
fn every_shorter_crate_is_refused() {
    for len in 0..CRATE.len() {
        let error = read_all(&CRATE[..len]).expect_err("a part of a crate");
        assert_eq!(matches!(error.place, Place::Byte(_)), len >= 8, "{len}: {error}");
    }
}

#[test]
fn changed_bytes_do_no_harm() {
    for file in [TEXT, CRATE] {
        let mut bytes = file.to_vec();
        for at in 0..bytes.len() {
            for change in [0xff, 0x01, 0x80, 0x20] {
                bytes[at] ^= change;
                if let Err(error) = read_all(&bytes) {
                    assert!(!error.found.is_empty() && !error.expected.is_empty());
                }
                bytes[at] ^= change;
            }
        }
    }
}

#[test]
fn errors_say_where() {
    let check = |text: &str, expected: &str| {
        let error = read_all(text.as_bytes()).expect_err(text).to_string();
        assert_eq!(error, expected, "{text}");
    };
    check("", "line 1, column 1: found the end, expected a USD layer: #usda, PXR-USDC or a package");
    check("#usda 1.0\ndef \"a\"\n{\n    int x = y\n}\n", "line 4, column 13: found `y`, expected a number");
    check(
        "#usda 1.0\ndef \"a\" {\n int[] x = [1, 2.5]\n}\n",
        "line 3, column 17: found `.5`, expected `,` or the end of the array",
    );
    check(
        "#usda 1.0\ndef \"a\" { float3[] x = [(1, 2)] }",
        "line 2, column 30: found `)`, expected `,` and another number",
    );
    check(
        "#usda 1.0\nfoo \"a\" {}",
        "line 2, column 1: found `foo \\\"a\\\" {}`, expected def, over or class",
    );
    check("PXR-USDC\0\x03\0\0\0\0\0\0........", "byte 8: found crate version 0.3.0, expected 0.4.0 to 0.13");
}

#[test]
fn depth_is_bounded() {
    let mut prims = String::from("#usda 1.0\n");
    for _ in 0..100_000 {
        prims.push_str("def \"a\" {");
    }
    let lists = format!("#usda 1.0\ndef \"a\" ( x = {}", "[".repeat(100_000));
    let dictionaries = format!("#usda 1.0\n( x = {}", "{ dictionary a = ".repeat(100_000));
    let variants = format!("#usda 1.0\ndef \"a\" {{ {}", "variantSet \"a\" = { \"b\" { ".repeat(100_000));
    for text in [prims, lists, dictionaries, variants] {
        assert!(read_all(text.as_bytes()).is_err());
    }
}

proptest! {
    #[test]
    fn anything_is_refused_or_read(bytes in proptest::collection::vec(any::<u8>(), 0..400)) {
        let _ = read_all(&bytes);
        for magic in [&b"#usda 1.0\n"[..], b"PXR-USDC\0\x08\0\0\0\0\0\0", b"PK\x03\x04"] {
            let _ = read_all(&[magic, &bytes].concat());
        }
    }

    #[test]
    fn parts_of_the_grammar_in_any_order(parts in proptest::collection::vec(0_usize..22, 0..40)) {
        const PARTS: [&str; 22] = [
            "def ", "\"a\" ", "{ ", "} ", "( ", ") ", "[ ", "] ", "= ", "int[] x ", "float3 y ", "1 ", "-2.5e3 ", ", ",
            "</a> ", "@b@ ", "None ", "rel z ", ".timeSamples ", ": ", "prepend ", "variantSet ",
        ];
        let text: String = parts.iter().map(|&part| PARTS[part]).collect();
        let _ = read_all(format!("#usda 1.0\n{text}").as_bytes());
    }

    #[test]
    fn crates_with_many_changes(changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..12)) {
        let mut bytes = CRATE.to_vec();
        for (at, value) in changes {
            let at = at.index(bytes.len());
            bytes[at] = value;
        }
        let _ = read_all(&bytes);
    }
}
