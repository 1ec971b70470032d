use proptest::prelude::*;
use serde_json::{Value, json};

use crate::{one, open, said};

/// Any value a document may hold, small.
fn any_value() -> impl Strategy<Value = Value> {
    let leaf = prop_oneof![
        Just(Value::Null),
        any::<bool>().prop_map(Value::from),
        any::<i64>().prop_map(Value::from),
        any::<u64>().prop_map(Value::from),
        (-1e6..1e6).prop_map(|x: f64| json!(x)),
        ".{0,8}".prop_map(Value::from),
        "[$x{}]{0,6}".prop_map(Value::from),
    ];
    leaf.prop_recursive(3, 24, 4, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..4).prop_map(Value::from),
            prop::collection::btree_map("[a-d]", inner, 0..4).prop_map(|m| json!(m)),
        ]
    })
}

fn any_map() -> impl Strategy<Value = Value> {
    prop::collection::btree_map("[a-d]", any_value(), 0..5).prop_map(|m| json!(m))
}

/// What merging comes to, told in another way.
fn merged(base: &Value, over: &Value) -> Value {
    match (base, over) {
        (Value::Object(base), Value::Object(over)) => {
            let mut all = base.clone();
            for (key, value) in over {
                let below = base.get(key).map_or_else(|| value.clone(), |base| merged(base, value));
                all.insert(key.clone(), below);
            }
            Value::Object(all)
        }
        _ => over.clone(),
    }
}

fn yaml(value: &Value) -> String {
    strict_yaml::write(value).unwrap()
}

proptest! {
    #[test]
    fn what_is_written_reads_back(value in any_map()) {
        let document = one(&yaml(&value));
        prop_assert_eq!(&said(&document.with_variables().unwrap().0), &value);
    }

    #[test]
    fn merging_does_not_care_about_brackets(a in any_map(), b in any_map(), c in any_map()) {
        let raw = |value: &Value| yaml(value).replace("$${", "$_{");
        let left = open(&[
            ("c.yaml", &format!("include: b.yaml\n{}", lines(&raw(&c)))),
            ("b.yaml", &format!("include: a.yaml\n{}", lines(&raw(&b)))),
            ("a.yaml", &raw(&a)),
        ]).unwrap();
        let flat = open(&[
            ("c.yaml", &format!("include: [a.yaml, b.yaml]\n{}", lines(&raw(&c)))),
            ("b.yaml", &raw(&b)),
            ("a.yaml", &raw(&a)),
        ]).unwrap();
        prop_assert_eq!(said(&left), said(&flat));
        let of = |value| said(&one(&raw(value)));
        prop_assert_eq!(said(&flat), merged(&merged(&of(&a), &of(&b)), &of(&c)));
    }

    #[test]
    fn no_text_brings_it_down(text in "[-a-c:{}\\[\\] \n&*!|>'\"$0-9.,#]{0,60}", more in ".{0,40}") {
        for text in [&text, &more] {
            if let Ok(document) = open(&[("a.yaml", text)]) {
                let _ = document.with_variables().map(|(document, _)| document.read::<Value>());
            }
        }
    }
}

/// A block of keys, or nothing for an empty mapping.
fn lines(yaml: &str) -> &str {
    if yaml == "{}\n" { "" } else { yaml }
}
