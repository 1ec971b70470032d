//! Texts that are made to do harm.

use proptest::prelude::*;

use super::*;

#[test]
fn hostile_texts_end_soon() {
    let bracket = words(of_text(&format!("convert: {}", "[".repeat(100_000)), &[]));
    assert!(bracket[0].contains("brackets are open"));
    assert!(!words(of_text(&format!("convert: {}a", "- ".repeat(100_000)), &[])).is_empty());
    let setting = format!("convert={}", "[".repeat(100_000));
    assert!(words(of_text(GOOD, &[&setting]))[0].contains("brackets are open"));
    let aliases = format!("{GOOD}video: [&a {{file: a.mp4}}, {{file: b.mp4}}]\n");
    assert_eq!(of_text(&aliases, &[]).unwrap()[0].pipeline.video.len(), 2);
}

/// Each of these took time with the square of its length: minutes.
#[test]
fn long_lists_of_what_is_wrong_end_soon() {
    let bad = told(&format!("convert: [{}]\n", "1,".repeat(40_000)));
    assert_eq!(bad.len(), 200);
    assert!(bad[0].contains("convert.0: `1` has no ending that can be written"), "{}", bad[0]);
    let axis: String = (0..20_000).map(|i| format!("    /{i}: {{}}\n")).collect();
    let many = told(&format!("matrix:\n  a:\n{axis}  exclude: [{}]\n", "{a: x},".repeat(10_000)));
    assert!(many[0].contains("matrix.a: comes to 20000 variants"), "{}", many[0]);
}

proptest! {
    #[test]
    fn no_text_brings_the_expansion_down(
        text in "(version: 1\n)?(matrix|include|variables|render|groom|x):[-a-c:{}\\[\\] \n&*!|>'\"$0-9.,#]{0,60}",
        setting in "(matrix|include|variables|render)?[.a-z0-9=${}\\[\\]]{0,12}",
    ) {
        let _ = of_text(&text, &[]);
        let _ = of_text(&text, &[&setting]);
    }
}
