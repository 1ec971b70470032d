use serde_json::json;
use strict_yaml::Setting;

use crate::{lines, one, open, put_in, said, with};

#[test]
fn a_value_that_is_a_name_alone_takes_the_variables_type() {
    let document = one(
        "variables: {n: 4, half: 0.50, on: true, none: null, sky: {file: a.hdr, n: '${n}'}, path: 'x/${n}-${half}'}\n\
         a: ${n}\nb: ['${half}', '${on}']\nc: ${sky}\nd: ${path}.exr\ne: $${n} ${none}|\nf: ${none}\n${n}: key\n",
    );
    let (document, used) = document.with_variables().unwrap();
    assert_eq!(
        said(&document),
        json!({
            "a": 4, "b": [0.5, true], "c": {"file": "a.hdr", "n": 4}, "d": "x/4-0.50.exr", "e": "${n} |",
            "f": null, "${n}": "key"
        })
    );
    assert_eq!(used.into_iter().collect::<Vec<_>>(), ["half", "n", "none", "on", "path", "sky"]);
}

#[test]
fn settings_lie_over_variables_and_values() {
    let text = "variables: {n: 4, name: a}\nspp: ${n}\nfile: ${name}.exr\nlist: [{x: 1}]\n";
    let document = with(text, &[Setting::variable("n=16"), Setting::set("variables.name=b${n}")]);
    assert_eq!(put_in(&document), json!({"spp": 16, "file": "b16.exr", "list": [{"x": 1}]}));
    let document = with(text, &[Setting::set("list.0.x=${n}"), Setting::set("new.key=[1, 2]")]);
    assert_eq!(put_in(&document)["list"], json!([{"x": 4}]));
    assert_eq!(put_in(&document)["new"], json!({"key": [1, 2]}));
    for (setting, words) in [
        (Setting::set("spp"), "a.yaml: expected `key.key=value` (from `--set spp`)"),
        (Setting::variable("n"), "a.yaml: expected `name=value` (from `-D n`)"),
        (Setting::set("=1"), "a.yaml: a key is empty (from `--set =1`)"),
        (
            Setting::set("color=#fff"),
            "a.yaml: color: `#fff` is a remark to YAML; put it in quotes (from `--set color=#fff`)",
        ),
        (
            Setting::set("list.3.x=1"),
            "a.yaml: list.3.x: `3` is none of the 1 entries (0, 1, ...) (from `--set list.3.x=1`)",
        ),
        (
            Setting::set("spp.x=1"),
            "a.yaml: spp.x: there are no keys below the one before `x` (from `--set spp.x=1`)",
        ),
        (
            Setting::set("include=b.yaml"),
            "a.yaml: include: files are included by files alone (from `--set include=b.yaml`)",
        ),
    ] {
        assert_eq!(one(text).lay(&setting).unwrap_err().to_string(), words);
    }
    assert!(one(text).lay(&Setting::set("spp=[")).unwrap_err().to_string().ends_with("(from `--set spp=[`)"));
}

#[test]
fn faults_of_variables_are_told_once_each() {
    let document =
        one("variables:\n  quality: 4\n  loop: x${pool}\n  pool: ${loop}\n  bad: ${zzz}\n  2x: 1\n\
         a: ${qualty}\nb: [1, 'x ${quality']\nc: ${bad}\nd: ${bad}\n");
    assert_eq!(
        lines(&document.with_variables().unwrap_err()),
        [
            "a.yaml:6:3: variables: `2x` is no name for a variable: letters, digits, `_` and `-`",
            "a.yaml:4:9: variables.pool: the variable `loop` is made from itself, by `loop` -> `pool`",
            "a.yaml:5:8: variables.bad: unknown variable `zzz`, there are `quality`, `loop`, `pool`, `bad`, `2x`",
            "a.yaml:7:4: a: unknown variable `qualty`, did you mean `quality`?",
            "a.yaml:8:8: b.1: a `${` without its `}`; a plain one is written `$${`",
        ]
    );
    let told = |text: &str| lines(&one(text).with_variables().unwrap_err());
    assert_eq!(
        told("variables: 4\n"),
        ["a.yaml:1:12: variables: is a whole number `4`, expected names and values"]
    );
    assert_eq!(
        told("a: ${x}\n"),
        ["a.yaml:1:4: a: unknown variable `x`; give it under `variables` or by `-D x=...`"]
    );
    assert_eq!(
        told("variables: {l: [1]}\na: x${l}\n"),
        ["a.yaml:2:4: a: `${l}` is a list and cannot stand inside a text"]
    );
}

#[test]
fn an_included_file_may_use_what_the_including_one_says() {
    let document = open(&[
        ("a.yaml", "include: b.yaml\nvariables: {stem: curly}\n"),
        ("b.yaml", "variables: {stem: wavy, file: '${stem}.hair'}\ngroom: ${file}\n"),
    ])
    .unwrap();
    assert_eq!(put_in(&document), json!({"groom": "curly.hair"}));
}

#[test]
fn a_bare_name_in_brackets_is_explained() {
    let told = crate::refused(&[("a.yaml", "variables: {x: 1}\na: [${x}, 2]\n")]);
    assert!(
        told[0].starts_with("a.yaml:2:")
            && told[0].ends_with("within brackets a `${name}` is written in quotes"),
        "{told:?}"
    );
}
