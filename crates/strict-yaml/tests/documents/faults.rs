use serde::Deserialize;
use strict_yaml::{Reading, Setting};

use crate::{lines, one, open};

#[derive(Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Film {
    width: u32,
    name: String,
    color: Option<[f32; 3]>,
    mode: Mode,
    lights: Vec<Light>,
    ramp: Vec<(f32, [f32; 3])>,
    inner: Option<Box<Film>>,
}

#[derive(Debug, Default, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct Light {
    size: f32,
}

#[derive(Debug, Default, PartialEq, Deserialize)]
#[serde(rename_all = "lowercase")]
enum Mode {
    #[default]
    Fast,
    Slow,
    By {
        step: f32,
    },
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Strict {
    must: u32,
    #[serde(default)]
    may: u32,
}

#[test]
fn everything_is_told_at_once_where_it_was_written() {
    let mut document = open(&[
        ("dir/a.yaml", "include: b.yaml\nvariables: {w: wide}\nwidth: ${w}\nlights:\n  - size: 1\n  - {size: big}\n  - {siz: 2}\nmode: slwo\n"),
        ("dir/b.yaml", "# below\ncolor: [1, 2]\ninner:\n  widht: 4\n  ramp: [[0, [1, 1, 1, 1]]]\n  lights: 7\n"),
    ])
    .unwrap();
    document.lay(&Setting::set("inner.width=-4")).unwrap();
    document.lay(&Setting::set("inner.nam=x")).unwrap();
    let reading: Reading<Film> = document.with_variables().unwrap().0.read();
    assert_eq!(
        lines(&reading.faults),
        [
            "dir/b.yaml:2:8: color: is a list of 2, expected 3 entries",
            "dir/b.yaml:4:3: inner: unknown key `widht`, did you mean `width`?",
            "dir/b.yaml:5:14: inner.ramp.0.1: is a list of 4, expected 3 entries",
            "dir/b.yaml:6:11: inner.lights: is a whole number `7`, expected a list",
            "dir/a.yaml: inner.width: is a whole number `-4`, expected a whole number in 0..=4294967295 (from `--set inner.width=-4`)",
            "dir/a.yaml: inner: unknown key `nam`, did you mean `name`? (from `--set inner.nam=x`)",
            "dir/a.yaml:3:8: width: is text \"wide\", expected a whole number in 0..=4294967295 (by `${w}`, dir/a.yaml:2:16)",
            "dir/a.yaml:6:12: lights.1.size: is text \"big\", expected a number",
            "dir/a.yaml:7:6: lights.2: unknown key `siz`, did you mean `size`?",
            "dir/a.yaml:8:7: mode: unknown word `slwo`, did you mean `slow`?",
        ]
    );
    let value = reading.value.unwrap();
    assert_eq!(value.lights, [Light { size: 1.0 }, Light::default(), Light::default()]);
    assert_eq!(value.inner, Some(Box::default()));
    assert_eq!(reading.left_out[..2], ["color", "inner.widht"]);
}

#[test]
fn what_is_there_is_read() {
    let text = "width: 4\nname: 0.50\ncolor: [1, 0.5, 1e-3]\nmode: {by: {step: 2}}\nlights:\ninner: {name: yes, mode: slow, ramp: [[0, [1, 2, 3]]]}\n";
    let reading: Reading<Film> = one(text).read();
    assert_eq!(lines(&reading.faults), [""; 0]);
    let inner =
        Film { name: "yes".into(), mode: Mode::Slow, ramp: vec![(0.0, [1.0, 2.0, 3.0])], ..Film::default() };
    let expect = Film {
        width: 4,
        name: "0.50".into(),
        color: Some([1.0, 0.5, 1e-3]),
        mode: Mode::By { step: 2.0 },
        inner: Some(Box::new(inner)),
        ..Film::default()
    };
    assert_eq!(reading.value, Some(expect));
}

#[test]
fn what_a_struct_must_have_is_missed_once() {
    let reading: Reading<Strict> = one("may: x\n").read();
    assert_eq!(
        lines(&reading.faults),
        [
            "a.yaml:1:6: may: is text \"x\", expected a whole number in 0..=4294967295",
            "a.yaml: missing field `must`"
        ]
    );
    assert!(reading.value.is_none());
    let reading: Reading<Strict> = one("must: x\n").read();
    assert_eq!(reading.faults.len(), 1);
    let reading: Reading<Strict> = one("must: 1\n").read();
    let Strict { must, may } = reading.value.unwrap();
    assert_eq!((must, may), (1, 0));
}

#[test]
fn faults_found_later_have_their_place_too() {
    let mut document =
        open(&[("a.yaml", "include: b.yaml\nx: 1\n"), ("b.yaml", "r:\n  spp: 0\n  l: [1, 2]\n")]).unwrap();
    document.lay(&Setting::set("r.depth=9")).unwrap();
    let told = |key: &str| document.fault(key, "is bad".into()).to_string();
    assert_eq!(told("r.spp"), "b.yaml:2:8: r.spp: is bad");
    assert_eq!(told("r.l.1"), "b.yaml:3:10: r.l.1: is bad");
    assert_eq!(told("r.l.7"), "b.yaml:3:6: r.l.7: is bad");
    assert_eq!(told("r.none"), "b.yaml:2:3: r.none: is bad");
    assert_eq!(told("none"), "a.yaml: none: is bad");
    assert_eq!(told("r.depth"), "a.yaml: r.depth: is bad (from `--set r.depth=9`)");
    // A setting may be what makes keys disagree.
    assert_eq!(told("r"), "b.yaml:2:3: r: is bad (from `--set r.depth=9`)");
}
