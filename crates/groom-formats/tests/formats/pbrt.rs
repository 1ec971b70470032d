//! pbrt's curves, read back by a parser of this test's own and evaluated as pbrt does.

#![allow(clippy::unwrap_used, clippy::panic)] // helpers and strategies of tests

use std::collections::BTreeMap;

use crate::support::{any_groom, full_groom, set};
use glam::{DVec3, Vec3};
use groom::{Attribute, Domain, Groom, Values, names};
use groom_formats::{Format, FormatError, Look, Warning, WriteOptions, write_to};
use proptest::prelude::*;

/// One statement: its name, its kind and the words of each parameter.
struct Statement {
    name: String,
    kind: String,
    parameters: BTreeMap<String, Vec<String>>,
}

/// Statements of a file: names in the open, kinds and parameters in quotes, values in brackets.
fn parse(text: &str) -> Vec<Statement> {
    let text: String =
        text.lines().filter(|line| !line.starts_with('#')).map(|line| format!("{line}\n")).collect();
    let mut words = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let end = match first {
            '"' => rest[1..].find('"').unwrap() + 2,
            '[' | ']' => 1,
            _ => rest.find(|c: char| c.is_whitespace()).unwrap_or(rest.len()),
        };
        words.push(&rest[..end]);
        rest = rest[end..].trim_start();
    }
    let mut statements: Vec<Statement> = Vec::new();
    let mut words = words.into_iter().peekable();
    while let Some(word) = words.next() {
        let Some(quoted) = word.strip_prefix('"') else {
            assert!(word.chars().all(char::is_alphabetic), "{word}");
            let kind = match words.peek() {
                Some(kind) if kind.starts_with('"') => words.next().unwrap().trim_matches('"').to_owned(),
                _ => String::new(),
            };
            statements.push(Statement { name: word.to_owned(), kind, parameters: BTreeMap::new() });
            continue;
        };
        let parameter = quoted.trim_end_matches('"').to_owned();
        assert!(parameter.contains(' '), "a parameter has a type: {parameter}");
        let values = match words.next().unwrap() {
            "[" => words.by_ref().take_while(|word| *word != "]").map(str::to_owned).collect(),
            word => vec![word.trim_matches('"').to_owned()],
        };
        let old = statements.last_mut().unwrap().parameters.insert(parameter, values);
        assert!(old.is_none(), "a parameter is given twice");
    }
    statements
}

impl Statement {
    fn floats(&self, name: &str) -> Vec<f32> {
        let words = self.parameters.get(name).unwrap_or_else(|| panic!("no {name} in {}", self.name));
        words.iter().map(|word| word.parse().unwrap()).collect()
    }

    fn word(&self, name: &str) -> &str {
        &self.parameters[name][0]
    }
}

/// A span as pbrt makes it: four control points, and the widths at both ends.
struct Span {
    controls: [DVec3; 4],
    widths: [f64; 2],
}

impl Span {
    fn at(&self, t: f64) -> DVec3 {
        let [a, b, c, d] = self.controls;
        let s = 1.0 - t;
        a * s * s * s + b * 3.0 * s * s * t + c * 3.0 * s * t * t + d * t * t * t
    }
}

fn spans(shape: &Statement) -> Vec<Span> {
    assert_eq!((shape.word("string type"), shape.word("string basis")), ("cylinder", "bezier"));
    let values = shape.floats("point3 P");
    let points: Vec<DVec3> = values.chunks(3).map(|p| Vec3::new(p[0], p[1], p[2]).as_dvec3()).collect();
    assert_eq!((values.len() % 3, (points.len() - 1) % 3), (0, 0), "3 n + 1 points of three numbers");
    let count = (points.len() - 1) / 3;
    let [from, to] = ["float width0", "float width1"].map(|name| f64::from(shape.floats(name)[0]));
    let width = |i: usize| from + (to - from) * i as f64 / count as f64;
    (0..count)
        .map(|i| Span {
            controls: std::array::from_fn(|k| points[3 * i + k]),
            widths: [width(i), width(i + 1)],
        })
        .collect()
}

fn written(groom: &Groom, options: &WriteOptions) -> (Vec<Statement>, Vec<Warning>) {
    let mut bytes = Vec::new();
    let warnings = write_to(Format::Pbrt, groom, &mut bytes, "memory", options).unwrap();
    let statements = parse(std::str::from_utf8(&bytes).unwrap());
    assert_eq!(statements.first().unwrap().name, "AttributeBegin");
    assert_eq!(statements[1].name, "Material");
    assert_eq!(statements.last().unwrap().name, "AttributeEnd");
    (statements, warnings)
}

/// Holds every span against the groom's strands; returns how many shapes each strand took.
fn check(groom: &Groom, statements: &[Statement]) -> Vec<usize> {
    let mut shapes = statements.iter().filter(|s| s.name == "Shape" && s.kind == "curve");
    let mut taken = Vec::new();
    for strand in (0..groom.strand_count()).filter(|&strand| groom.strand(strand).len() > 1) {
        let points = groom.strand(strand);
        let mut all: Vec<Span> = Vec::new();
        let mut count = 0;
        while all.len() < points.len() - 1 {
            all.extend(spans(shapes.next().unwrap()));
            count += 1;
        }
        taken.push(count);
        assert_eq!(all.len(), points.len() - 1, "shapes end where strands end");
        // What is promised of widths that are nearly even, and the last bit.
        let largest = groom.strand_range(strand).map(|v| groom.radii().get(strand, v)).fold(0.0, f32::max);
        let allowed = (2e-3 + 1e-6) * f64::from(largest);
        for (i, span) in all.iter().enumerate() {
            // The curve passes the points to the bit.
            assert_eq!(span.at(0.0), points[i].as_dvec3());
            assert_eq!(span.at(1.0), points[i + 1].as_dvec3());
            let start = groom.strand_range(strand).start;
            for (end, width) in span.widths.into_iter().enumerate() {
                let expected = 2.0 * f64::from(groom.radii().get(strand, start + i + end));
                assert!((width - expected).abs() <= allowed, "{width} {expected}");
            }
        }
    }
    assert!(shapes.next().is_none(), "no shape but the strands'");
    taken
}

/// As [`any_groom`], of sizes whose curves fit f32.
fn groom() -> impl Strategy<Value = Groom> {
    any_groom().prop_filter("a line", |groom| groom.strands().any(|strand| strand.len() > 1)).prop_map(
        |mut groom| {
            groom
                .positions_mut()
                .iter_mut()
                .for_each(|p| *p = p.clamp(Vec3::splat(-1e30), Vec3::splat(1e30)));
            let Some(Attribute { values: Values::Float(radii), .. }) = groom.remove_attribute(names::RADIUS)
            else {
                panic!("a radius")
            };
            let radii = radii.into_iter().map(|radius| radius.min(1e30)).collect();
            set(&mut groom, names::RADIUS, Domain::Vertex, Values::Float(radii));
            groom
        },
    )
}

proptest! {
    #[test]
    fn curves_pass_every_point_with_its_width(groom in groom()) {
        check(&groom, &written(&groom, &WriteOptions::default()).0);
    }
}

fn strand(points: &[[f32; 3]]) -> Groom {
    Groom::new(vec![0, points.len() as u32], points.iter().map(|&p| p.into()).collect()).unwrap()
}

#[test]
fn curves_are_smooth_and_straight_strands_stay_straight() {
    let groom = strand(&[[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 2.0, 0.5], [1.0, 3.0, 2.0]]);
    let (statements, _) = written(&groom, &WriteOptions::default());
    assert_eq!(check(&groom, &statements), [1], "one radius: one shape");
    let all = spans(statements.iter().find(|s| s.name == "Shape").unwrap());
    for pair in all.windows(2) {
        let (into, out) =
            (pair[0].controls[3] - pair[0].controls[2], pair[1].controls[1] - pair[1].controls[0]);
        assert!((into - out).length() < 1e-6, "the tangent is the same on both sides");
    }
    // Catmull-Rom: along the neighbours at inner points, along the segments at the ends.
    assert!((all[1].controls[1] - DVec3::new(1.0 / 6.0, 1.0 + 2.0 / 6.0, 0.5 / 6.0)).length() < 1e-6);
    assert!((all[0].controls[1] - DVec3::new(0.0, 1.0 / 3.0, 0.0)).length() < 1e-6);
    let line = strand(&[[0.0; 3], [0.0, 0.0, 1.0], [0.0, 0.0, 2.0]]);
    for span in spans(written(&line, &WriteOptions::default()).0.iter().find(|s| s.name == "Shape").unwrap())
    {
        let third = (span.controls[3] - span.controls[0]) / 3.0;
        for (i, control) in span.controls.into_iter().enumerate() {
            assert!((control - span.controls[0] - third * i as f64).length() < 1e-6);
        }
    }
}

#[test]
fn uneven_widths_take_a_shape_a_segment() {
    let mut groom = strand(&[[0.0; 3], [0.0, 1.0, 0.0], [0.0, 2.0, 0.0], [0.0, 3.0, 0.0]]);
    for (radii, shapes) in [([0.4, 0.3, 0.2, 0.1], 1), ([0.4, 0.4, 0.2, 0.1], 3), ([0.0; 4], 1)] {
        set(&mut groom, names::RADIUS, Domain::Vertex, Values::Float(radii.to_vec()));
        assert_eq!(check(&groom, &written(&groom, &WriteOptions::default()).0), [shapes], "{radii:?}");
    }
}

#[test]
fn the_text_is_as_documented() {
    let groom = strand(&[[0.0; 3], [0.0, 3.0, 0.0]]);
    let mut bytes = Vec::new();
    write_to(Format::Pbrt, &groom, &mut bytes, "memory", &WriteOptions::default()).unwrap();
    let expected = format!(
        "# Written by groomkit {}\nAttributeBegin\nMaterial \"hair\"\n\
         Shape \"curve\" \"string type\" \"cylinder\" \"string basis\" \"bezier\" \
         \"point3 P\" [ 0 0 0 0 1 0 0 2 0 0 3 0 ] \"float width0\" [ 1 ] \"float width1\" [ 1 ]\nAttributeEnd\n",
        env!("CARGO_PKG_VERSION")
    );
    assert_eq!(String::from_utf8(bytes).unwrap(), expected);
}

#[test]
fn the_material_is_the_look_or_the_mean_colour() {
    let mut groom = strand(&[[0.0; 3], [0.0, 1.0, 0.0]]);
    let look = Look {
        color: [0.5; 3],
        absorption: [0.25, 0.5, 1.0],
        beta_m: 0.25,
        beta_n: 0.75,
        roughness: [[0.0; 2]; 3],
        alpha: 2.0_f32.to_radians(),
        eta: 1.5,
        melanin: None,
    };
    set(&mut groom, names::COLOR, Domain::Vertex, Values::Vec3(vec![Vec3::ZERO, Vec3::ONE]));
    let options = WriteOptions { look: Some(look), ..WriteOptions::default() };
    let (statements, warnings) = written(&groom, &options);
    let material = &statements[1];
    assert_eq!(material.kind, "hair");
    assert_eq!(material.floats("rgb sigma_a"), [0.25, 0.5, 1.0]);
    let numbers = ["float beta_m", "float beta_n", "float eta"].map(|name| material.floats(name)[0]);
    assert_eq!(numbers, [0.25, 0.75, 1.5]);
    // pbrt's tilt is over 0 towards the tip, ours towards the root.
    assert!((material.floats("float alpha")[0] + 2.0).abs() < 1e-5);
    let (format, name) = (Format::Pbrt, names::COLOR);
    assert_eq!(warnings, [Warning::AttributeLeftOut { format, name: name.to_owned() }]);
    let (statements, warnings) = written(&groom, &WriteOptions::default());
    assert_eq!(warnings, [Warning::Averaged { format, name }]);
    let sigma = statements[1].floats("rgb sigma_a");
    // pbrt's polynomial at a roughness of 0.3 is 5.87; half grey: (ln 0.5 / 5.87)^2.
    assert!(sigma.iter().all(|sigma| (sigma - 0.01394).abs() < 2e-4), "{sigma:?}");
}

#[test]
fn what_pbrt_cannot_hold_is_told() {
    let (statements, warnings) = written(&full_groom(), &WriteOptions::default());
    let format = Format::Pbrt;
    let left_out = |name: &str| Warning::AttributeLeftOut { format, name: name.into() };
    let mut expected = vec![
        Warning::OnePointStrandsLeftOut { format, strands: 1 },
        Warning::Averaged { format, name: "color" },
    ];
    expected.extend(["clump weight", "id", "root_uv", "transparency"].map(left_out));
    assert_eq!(warnings, expected);
    assert_eq!(check(&full_groom(), &statements).len(), 2);
    let dot = strand(&[[0.0; 3]]);
    let error = write_to(format, &dot, Vec::new(), "memory", &WriteOptions::default()).unwrap_err();
    assert!(matches!(error, FormatError::Empty { points: 2, .. }));
}
