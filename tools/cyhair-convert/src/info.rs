//! `cyhair-convert IN --info`.

use anyhow::Result;
use groom::{Attribute, Domain, Groom, Range, Statistics, UpAxis, Values, names};
use groom_formats::HairExtras;
use serde_json::{Value, json};

use crate::args::Args;
use crate::load::{Input, load};
use crate::report;

pub(crate) fn run(args: &Args) -> Result<()> {
    args.refuse_misread()?;
    let input = load(args)?;
    let figures = Statistics::of(&input.loaded.groom);
    if args.json {
        report::print_json(&as_json(&input, &figures))
    } else {
        report::print(&as_text(&input, &figures))
    }
}

fn as_json(input: &Input, figures: &Statistics) -> Value {
    let groom = &input.loaded.groom;
    let range = |r: Option<Range>| r.map(|r| json!({ "min": r.min, "mean": r.mean, "max": r.max }));
    json!({
        "file": input.name,
        "format": input.format.name(),
        "bytes": input.bytes,
        "hair": input.loaded.hair.as_ref().map(|extras| hair_json(groom, extras)),
        "up_axis": up(groom),
        "meters_per_unit": groom.meters_per_unit,
        "strands": figures.strands,
        "points": figures.points,
        "segments": figures.segments,
        "strand_points": figures.strand_points.map(|(min, max)| json!({ "min": min, "max": max })),
        "strand_length": range(figures.strand_length),
        "segment_length": range(figures.segment_length),
        "radius": figures.radius.map(radius_json),
        "bounds": figures.bounds.map(|(min, max)| json!({ "min": floats::<3>(min), "max": floats::<3>(max) })),
        "zero_length_segments": figures.zero_length_segments,
        "one_point_strands": figures.one_point_strands,
        "sharp_bends": figures.sharp_bends,
        "attributes": groom.attributes().map(attribute_json).collect::<Vec<_>>(),
        "warnings": input.loaded.warnings.iter().map(ToString::to_string).collect::<Vec<_>>(),
        "repairs": input.loaded.repairs,
    })
}

/// The header's own words: which arrays there are, and what stands in for those that are not.
fn hair_json(groom: &Groom, extras: &HairExtras) -> Value {
    json!({
        "info": info_text(extras),
        "arrays": arrays(groom, extras),
        "default_segments": extras.default_segments,
        "default_thickness": shortest(extras.default_thickness),
        "default_transparency": shortest(extras.default_transparency),
        "default_color": floats::<3>(extras.default_color),
    })
}

/// The 64-bit number with the fewest digits that is this one in 32 bits: JSON has no other, and 0.05
/// widened would read 0.05000000074505806.
fn shortest(value: f32) -> f64 {
    value.to_string().parse().unwrap_or(value.into())
}

fn floats<const N: usize>(values: impl Into<[f32; N]>) -> Value {
    values.into().map(shortest).to_vec().into()
}

/// Radii have 32 bits, and so must their mean, or it could lie beyond both ends.
fn radius_json(range: Range) -> Value {
    let [min, mean, max] = [range.min, range.mean, range.max].map(|value| shortest(value as f32));
    json!({ "min": min, "mean": mean, "max": max })
}

fn arrays(groom: &Groom, extras: &HairExtras) -> Vec<&'static str> {
    let is_array = |name| groom.attribute(name).is_some_and(|a| a.domain == Domain::Vertex);
    let all = [
        (extras.segments_array, "segments"),
        (true, "points"),
        (is_array(names::RADIUS), "thickness"),
        (is_array(names::TRANSPARENCY), "transparency"),
        (is_array(names::COLOR), "colors"),
    ];
    all.into_iter().filter_map(|(present, name)| present.then_some(name)).collect()
}

fn info_text(extras: &HairExtras) -> String {
    let end = extras.info.iter().position(|&byte| byte == 0).unwrap_or(extras.info.len());
    String::from_utf8_lossy(&extras.info[..end]).into_owned()
}

fn attribute_json((name, attribute): (&str, &Attribute)) -> Value {
    json!({
        "name": name,
        "type": attribute.values.type_name(),
        "domain": domain(attribute.domain),
        "value": if attribute.domain == Domain::Groom { first(&attribute.values) } else { Value::Null },
    })
}

fn first(values: &Values) -> Value {
    match values {
        Values::Float(v) => json!(v.first().copied().map(shortest)),
        Values::Vec2(v) => json!(v.first().map(|&v| floats::<2>(v))),
        Values::Vec3(v) => json!(v.first().map(|&v| floats::<3>(v))),
        Values::Int(v) => json!(v.first()),
    }
}

fn domain(domain: Domain) -> &'static str {
    match domain {
        Domain::Groom => "constant",
        Domain::Strand => "per strand",
        Domain::Vertex => "per point",
    }
}

fn up(groom: &Groom) -> &'static str {
    match groom.up_axis {
        UpAxis::Y => "y",
        UpAxis::Z => "z",
    }
}

fn as_text(input: &Input, figures: &Statistics) -> String {
    let groom = &input.loaded.groom;
    let mut lines = vec![
        format!("{}: {}, {} bytes", input.name, input.format, input.bytes),
        line("strands", figures.strands),
        line("points", figures.points),
        line("segments", figures.segments),
    ];
    lines.extend(figures.strand_points.map(|(min, max)| line("points a strand", format!("{min} .. {max}"))));
    lines.extend(figures.strand_length.map(|r| line("strand length", range_text(r))));
    lines.extend(figures.segment_length.map(|r| line("segment length", range_text(r))));
    lines.extend(figures.radius.map(|r| line("radius", range_text(r))));
    lines.extend(figures.bounds.map(|(min, max)| line("bounds", format!("{min} .. {max}"))));
    lines.push(line("up axis, unit", format!("{}, {} m", up(groom), groom.meters_per_unit)));
    if let Some(extras) = &input.loaded.hair {
        lines.extend(hair_lines(groom, extras));
    }
    for (name, attribute) in groom.attributes() {
        let constant = if attribute.domain == Domain::Groom {
            format!(" {}", first(&attribute.values))
        } else {
            String::new()
        };
        let text =
            format!("{name} ({}, {}){constant}", attribute.values.type_name(), domain(attribute.domain));
        lines.push(line("attribute", text));
    }
    let oddities = [
        ("segments have no length", figures.zero_length_segments),
        ("strands have one point", figures.one_point_strands),
        ("bends are sharper than 90 degrees", figures.sharp_bends),
    ];
    lines.extend(
        oddities.into_iter().filter(|o| o.1 > 0).map(|(what, n)| line("note", format!("{n} {what}"))),
    );
    lines.extend(input.loaded.repairs.iter().map(|repair| line("repaired", repair)));
    lines.extend(input.loaded.warnings.iter().map(|warning| line("warning", warning)));
    lines.join("\n")
}

fn hair_lines(groom: &Groom, extras: &HairExtras) -> Vec<String> {
    let [r, g, b] = extras.default_color;
    vec![
        line("arrays", arrays(groom, extras).join(", ")),
        line(
            "defaults",
            format!(
                "{} segments, thickness {}, transparency {}, colour {r} {g} {b}",
                extras.default_segments, extras.default_thickness, extras.default_transparency
            ),
        ),
        line("info", format!("{:?}", info_text(extras))),
    ]
}

fn line(name: &str, value: impl std::fmt::Display) -> String {
    format!("  {name:<16} {value}")
}

/// In 32 bits, which is as many digits as mean something, however small the unit.
fn range_text(range: Range) -> String {
    format!("{} .. {}, mean {}", range.min as f32, range.max as f32, range.mean as f32)
}
