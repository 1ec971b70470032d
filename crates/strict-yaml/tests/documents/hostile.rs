use strict_yaml::{Document, DocumentError, Setting};

use crate::{lines, one, open, refused};

#[test]
fn variables_that_double_are_stopped() {
    let mut text = "variables:\n  a0: xxxxxxxxxx\n".to_owned();
    for i in 1..30 {
        text += &format!("  a{i}: ${{a{}}}${{a{}}}\n", i - 1, i - 1);
    }
    let told = lines(&one(&(text.clone() + "x: ${a29}\n")).with_variables().unwrap_err());
    assert_eq!(told.len(), 1, "{told:#?}");
    assert!(told[0].contains("comes to more than 1048576 letters by its variables"), "{told:#?}");
    let lists = text.replace("${a", "'${a").replace('}', "}',").replace(": '", ": ['").replace(",\n", "]\n");
    let told = lines(&one(&lists).with_variables().unwrap_err());
    assert!(told[0].contains("comes to more than 50000 values by its variables"), "{told:#?}");
    let mut deep = "variables:\n  a0: 1\n".to_owned();
    for i in 1..20 {
        deep += &format!("  a{i}: {}'${{a{}}}'{}\n", "[".repeat(20), i - 1, "]".repeat(20));
    }
    let told = lines(&one(&deep).with_variables().unwrap_err());
    assert!(told[0].contains("comes to more than 128 values below each other"), "{told:#?}");
    let mut chain = "variables:\n  a0: 1\n".to_owned();
    for i in 1..5000 {
        chain += &format!("  b{i}: ${{b{}}}\n", i + 1);
    }
    let told = lines(&one(&chain).with_variables().unwrap_err());
    assert!(told[0].contains("variables use each other more than 32 deep"), "{told:#?}");
}

#[test]
fn files_that_include_each_other_many_times_are_stopped() {
    let names: Vec<String> = (0..20).map(|i| format!("f{i}.yaml")).collect();
    let texts: Vec<String> = (1..=20).map(|i| format!("include: [f{i}.yaml, f{i}.yaml]\n")).collect();
    let files: Vec<(&str, &str)> =
        names.iter().map(String::as_str).zip(texts.iter().map(String::as_str)).collect();
    let told = refused(&files);
    assert!(told.iter().any(|t| t.contains("files include each other more than 16 deep")), "{told:#?}");
    let few = &files[..12];
    let told = refused(&[few, &[("f12.yaml", "x: 1\n")]].concat());
    assert_eq!(told.len(), 1, "{told:#?}");
    assert!(told[0].contains("more than 128 files are included"));
}

#[test]
fn aliases_brackets_and_long_texts_are_stopped() {
    let mut bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n".to_owned();
    for i in 1..30 {
        bomb += &format!("a{i}: &a{i} [{}]\n", vec![format!("*a{}", i - 1); 10].join(", "));
    }
    assert_eq!(refused(&[("a.yaml", &bomb)]).len(), 1);
    assert!(refused(&[("a.yaml", &"[".repeat(100_000))])[0].contains("brackets are open"));
    assert_eq!(refused(&[("a.yaml", &format!("x: {}a", "- ".repeat(100_000)))]).len(), 1);
    let many = format!("x: [{}]\n", "1,".repeat(60_000));
    assert!(refused(&[("a.yaml", &many)])[0].contains("comes to more than 50000 values"));
    let long = "#".repeat((1 << 20) + 1);
    assert!(refused(&[("a.yaml", &long)])[0].contains("more than 1048576 bytes"));
    let deep = vec!["x"; 100_000].join(".") + "=1";
    assert!(one("").lay(&Setting::set(&deep)).unwrap_err().message.contains("keys below each other"));
    let half = format!("x: [{}]\n", "1,".repeat(30_000));
    let told =
        refused(&[("a.yaml", &format!("include: b.yaml\n{half}")), ("b.yaml", &half.replace('x', "y"))]);
    assert_eq!(told, ["b.yaml: comes to more than 50000 values with the files that were read before it"]);
}

#[test]
fn texts_that_are_none_have_a_place() {
    let bytes = b"x: 1\nabc \xff".to_vec();
    let error = Document::open_with(std::path::Path::new("a.yaml"), &|_| Ok(bytes.clone())).unwrap_err();
    assert_eq!(error.to_string(), "a.yaml:2:5: byte 9 is not UTF-8, as YAML has to be");
    assert!(open(&[("a.yaml", "")]).is_ok());
    let none = Document::open(std::path::Path::new("/no/such/file.yaml"));
    assert!(matches!(none, Err(DocumentError::Io { .. })));
}

/// Each of these took time with the square of its length: minutes.
#[test]
fn long_lists_of_what_is_wrong_or_odd_end_soon() {
    #[derive(serde::Deserialize)]
    struct Names {
        names: Vec<String>,
    }
    let many = format!("names: [{}]\n", "0.10,".repeat(10_000));
    let names = one(&many).read::<Names>().value.unwrap().names;
    assert!(names.len() == 10_000 && names.iter().all(|name| name == "0.10"));
    let names: String = (0..8_000).map(|i| format!("  a{i:06}: 1\n")).collect();
    let uses = "- ${b000000}\n".repeat(8_000);
    let told = one(&format!("variables:\n{names}x:\n{uses}")).with_variables().unwrap_err();
    assert_eq!(told.len(), 100);
    let long = "x".repeat(400_000);
    let text = format!("variables:\n  ? {long}y\n  : 1\nx: ${{{long}z}}\n");
    let told = one(&text).with_variables().unwrap_err();
    assert_eq!(told.len(), 1);
    // Past some point what is wrong is told without its place.
    let told = refused(&[("a.yaml", &format!("include: [{}]\n", "1,".repeat(10_000)))]);
    assert_eq!(told.len(), 10_000);
    assert!(
        told[0].starts_with("a.yaml:1:11: include: is a whole number") && told[9_999].starts_with("a.yaml: ")
    );
}

#[test]
fn brackets_in_remarks_do_not_count() {
    let remarks = "x: 1 # in [0, 1)\n# {\n".replace("x", "x{}");
    let text: String = (0..200).map(|i| remarks.replace("{}", &i.to_string())).collect();
    assert_eq!(one(&text).values(), 201);
    // What looks like a remark within a text hides none.
    for hidden in ["x: \"a # \" \ny: ", "x: 'a # '\ny: ", "x: \"a\n # \"\ny: "] {
        let text = hidden.replace("\ny: ", &format!("{}\ny: 1\n", "[".repeat(200)));
        assert!(refused(&[("a.yaml", &text)])[0].contains("brackets are open"), "{hidden}");
    }
}
