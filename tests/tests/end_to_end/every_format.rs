//! The law of attributes: what goes in comes out, or a warning names it. In every format, there and back.

use std::path::{Path, PathBuf};

use end_to_end_tests::{data_file, samples_dir};
use glam::{Vec2, Vec3};
use groom::{Attribute, Domain, Groom, UpAxis, Values, names};
use groom_formats::{Format, Loaded, ReadOptions, Warning, WriteOptions, read, write};

/// Strands of 2 to 5 points with every attribute a groom can have, on every domain it can be on.
fn full_groom() -> Groom {
    let counts = [4_u32, 2, 5, 3];
    let offsets: Vec<u32> = std::iter::once(0)
        .chain(counts.iter().scan(0, |end, count| {
            *end += count;
            Some(*end)
        }))
        .collect();
    let points = offsets[counts.len()] as usize;
    let number = |i: usize| (i as f32 * 0.618_034).fract();
    let positions = (0..points).map(|i| Vec3::new(i as f32 * 0.25, number(i), -number(i + 9))).collect();
    let mut groom = Groom::new(offsets, positions).unwrap();
    groom.up_axis = UpAxis::Y;
    let mut set =
        |name: &str, domain, values| groom.set_attribute(name, Attribute { domain, values }).unwrap();
    let strands = counts.len();
    set(names::RADIUS, Domain::Vertex, Values::Float((0..points).map(|i| 0.01 + 0.01 * number(i)).collect()));
    set(
        names::COLOR,
        Domain::Strand,
        Values::Vec3((0..strands).map(|i| Vec3::splat(i as f32 / 255.0)).collect()),
    );
    set(names::TRANSPARENCY, Domain::Groom, Values::Float(vec![0.25]));
    set(names::ID, Domain::Strand, Values::Int(vec![7, 3, 1000, 0]));
    set(
        names::ROOT_UV,
        Domain::Strand,
        Values::Vec2((0..strands).map(|i| Vec2::new(number(i), 0.5)).collect()),
    );
    set(names::GROUP, Domain::Strand, Values::Int(vec![0, 1, 1, 0]));
    set(names::GUIDE, Domain::Strand, Values::Int(vec![1, 0, 0, 1]));
    set(names::VELOCITY, Domain::Vertex, Values::Vec3((0..points).map(|i| Vec3::X * number(i)).collect()));
    set("rest_length", Domain::Strand, Values::Float(vec![1.0, 2.0, 3.0, 4.0]));
    set("tension", Domain::Vertex, Values::Float((0..points).map(number).collect()));
    set("wind", Domain::Groom, Values::Vec3(vec![Vec3::new(1.0, 0.5, 0.25)]));
    groom
}

fn both_ways() -> impl Iterator<Item = Format> {
    Format::ALL.into_iter().filter(|format| format.can_read() && format.can_write())
}

fn there_and_back(
    groom: &Groom,
    format: Format,
    folder: &Path,
    options: &WriteOptions,
) -> (Groom, Vec<Warning>) {
    let path = folder.join(format!("groom.{format}"));
    let warnings = write(groom, &path, options).unwrap();
    let options = ReadOptions { up_axis: Some(groom.up_axis), ..ReadOptions::default() };
    let Loaded { groom, .. } = read(&path, &options).unwrap();
    (groom, warnings)
}

/// An attribute as one value a vertex, each as numbers.
fn spread(groom: &Groom, name: &str) -> Option<Vec<Vec<f64>>> {
    let Attribute { domain, values } = groom.attribute(name)?;
    let at = |index: usize| match values {
        Values::Float(v) => vec![f64::from(v[index])],
        Values::Vec2(v) => v[index].to_array().map(f64::from).to_vec(),
        Values::Vec3(v) => v[index].to_array().map(f64::from).to_vec(),
        Values::Int(v) => vec![f64::from(v[index])],
    };
    let each =
        (0..groom.strand_count()).flat_map(|strand| groom.strand_range(strand).map(move |v| (strand, v)));
    let index = |(strand, vertex)| match domain {
        Domain::Groom => 0,
        Domain::Strand => strand,
        Domain::Vertex => vertex,
    };
    Some(each.map(|place| at(index(place))).collect())
}

fn is_close(a: &[Vec<f64>], b: &[Vec<f64>]) -> bool {
    a.len() == b.len() && a.iter().flatten().zip(b.iter().flatten()).all(|(a, b)| (a - b).abs() <= 1e-6)
}

fn names_it(warnings: &[Warning], name: &str) -> bool {
    warnings.iter().any(|warning| {
        let words = warning.to_string();
        words.contains(&format!("`{name}`")) || words.contains(&format!(" {name} "))
    })
}

#[test]
fn what_goes_in_comes_out_or_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let groom = full_groom();
    // What is written unasked, and everything the format can hold.
    let options =
        [false, true].map(|all_attributes| WriteOptions { all_attributes, ..WriteOptions::default() });
    for (format, options) in
        both_ways().flat_map(|format| options.iter().map(move |options| (format, options)))
    {
        let (back, warnings) = there_and_back(&groom, format, folder.path(), options);
        assert_eq!(back.offsets(), groom.offsets(), "{format}");
        assert_eq!(back.positions(), groom.positions(), "{format}");
        for (name, _) in groom.attributes() {
            let before = spread(&groom, name).unwrap();
            let survives = spread(&back, name).is_some_and(|after| is_close(&before, &after));
            assert!(
                survives || names_it(&warnings, name),
                "{format} lost `{name}` without a word: {:?}, warnings {warnings:?}",
                back.attribute(name)
            );
        }
    }
}

#[test]
fn unit_and_axis_survive_or_are_told() {
    let folder = tempfile::tempdir().unwrap();
    for (up_axis, meters_per_unit) in [(UpAxis::Z, 1.0), (UpAxis::Y, 1.0), (UpAxis::Y, 0.5), (UpAxis::Z, 0.5)]
    {
        let mut groom = full_groom();
        (groom.up_axis, groom.meters_per_unit) = (up_axis, meters_per_unit);
        for format in both_ways() {
            let path = folder.path().join(format!("groom.{format}"));
            let warnings = write(&groom, &path, &WriteOptions::default()).unwrap();
            let back = read(&path, &ReadOptions::default()).unwrap().groom;
            if matches!(format, Format::Gltf | Format::Glb) {
                // Turned and scaled instead.
                let is_upright = back.up_axis == UpAxis::Y && back.meters_per_unit == 1.0;
                let at = |v: Vec3| if up_axis == UpAxis::Y { v } else { Vec3::new(v.x, v.z, -v.y) };
                let pairs = groom.positions().iter().zip(back.positions());
                let near =
                    pairs.into_iter().all(|(&a, &b)| (at(a) * meters_per_unit as f32).abs_diff_eq(b, 1e-6));
                assert!(is_upright && near, "{format} {up_axis:?} {meters_per_unit}");
                continue;
            }
            let axis_told = warnings.iter().any(|w| matches!(w, Warning::UpAxisNotStored { .. }));
            let unit_told = warnings.iter().any(|w| matches!(w, Warning::UnitNotStored { .. }));
            assert!(back.up_axis == up_axis || axis_told, "{format}: {up_axis:?}");
            assert!(back.meters_per_unit == meters_per_unit || unit_told, "{format}: {meters_per_unit}");
        }
    }
}

#[test]
fn formats_that_hold_everything_lose_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let mut groom = full_groom();
    groom.up_axis = UpAxis::Z;
    groom.meters_per_unit = 0.00254;
    for format in [Format::Usda, Format::Usdc, Format::Usdz, Format::Alembic] {
        let path = folder.path().join(format!("groom.{format}"));
        let warnings = write(&groom, &path, &WriteOptions::default()).unwrap();
        assert_eq!(warnings, [], "{format}");
        let back = read(&path, &ReadOptions::default()).unwrap().groom;
        assert_eq!((back.up_axis, back.meters_per_unit), (UpAxis::Z, 0.00254), "{format}");
        for (name, attribute) in groom.attributes() {
            assert_eq!(back.attribute(name), Some(attribute), "{format}: {name}");
        }
        assert_eq!(back, groom, "{format}");
    }
}

/// The samples and the real grooms that are there.
fn inputs() -> Vec<PathBuf> {
    let samples =
        ["straight.hair", "wavy.hair", "curly.hair", "arrays/all.hair"].map(|name| samples_dir().join(name));
    let real = ["hair/straight.hair", "hair/bear_fur.hair"].into_iter().filter_map(data_file);
    samples.into_iter().chain(real).collect()
}

#[test]
fn real_grooms_keep_their_points_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    for input in inputs() {
        let mut groom = read(&input, &ReadOptions::default()).unwrap().groom;
        // Not turned on the way to glTF.
        groom.up_axis = UpAxis::Y;
        for format in both_ways() {
            let (back, _) = there_and_back(&groom, format, folder.path(), &WriteOptions::default());
            assert_eq!(back.offsets(), groom.offsets(), "{} in {format}", input.display());
            assert!(back.positions() == groom.positions(), "{} in {format}", input.display());
        }
    }
}
