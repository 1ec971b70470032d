//! Laws of giving strands colours, widths and numbers.

use crate::support::{floats, from_strands, ints, vec3s, wavy};
use glam::{Vec2, Vec3};
use groom::{Attribute, Domain, Groom, GroomError, Texture, VAxis, Values, names};

fn set(groom: &mut Groom, name: &str, text: &str, seed: u64) -> Result<(), GroomError> {
    groom.set(name, &text.parse()?, seed)
}

fn domain(groom: &Groom, name: &str) -> Domain {
    groom.attribute(name).unwrap().domain
}

#[test]
fn widths_are_multiplied_along_the_length() {
    let points = [0.0, 1.0, 2.0, 6.0, 8.0].map(|x| Vec3::X * x).to_vec();
    let mut groom = from_strands(&[points, vec![Vec3::ONE]]);
    groom.set_width(4.0).unwrap();
    groom.multiply_width(&"0:1,0.25:0.5,1:0".parse().unwrap()).unwrap();
    let expected = [2.0, 1.5, 1.0, 1.0 / 3.0, 0.0, 2.0];
    for (found, expected) in floats(&groom, names::RADIUS).iter().zip(expected) {
        assert!((found - expected).abs() < 1e-6, "{found} {expected}");
    }
    // Once more multiplies again.
    groom.multiply_width(&"0:0.5".parse().unwrap()).unwrap();
    assert_eq!(floats(&groom, names::RADIUS)[..1], [1.0]);
}

#[test]
fn random_numbers_fill_their_range_and_stay_with_their_strand() {
    let mut groom = wavy(20_000, 2);
    set(&mut groom, "melanin", "0.6~0.1", 7).unwrap();
    let values = floats(&groom, "melanin");
    let mean = values.iter().map(|&v| f64::from(v)).sum::<f64>() / 20_000.0;
    // The deviation of the mean is 0.1 / sqrt(3 * 20000) = 0.0004.
    assert!((mean - 0.6).abs() < 0.002, "{mean}");
    assert!(values.iter().all(|v| (0.5..=0.7).contains(v)));
    let below = values.iter().filter(|&&v| v < 0.55).count();
    assert!((4700..5300).contains(&below), "{below}");
    let thinned = groom.subsample_by_stride(7).unwrap();
    let mut again = wavy(20_000, 2).subsample_by_stride(7).unwrap();
    set(&mut again, "melanin", "0.6~0.1", 7).unwrap();
    assert_eq!(floats(&again, "melanin"), floats(&thinned, "melanin"));
    set(&mut again, "melanin", "0.6~0.1", 8).unwrap();
    assert_ne!(floats(&again, "melanin"), floats(&thinned, "melanin"));
    set(&mut again, "redness", "0.6~0.1", 7).unwrap();
    assert_ne!(floats(&again, "redness"), floats(&thinned, "melanin"));
}

#[test]
fn expressions_take_the_type_of_their_text_and_name() {
    let mut groom = wavy(50, 3);
    set(&mut groom, "curl", " 2.5 ", 0).unwrap();
    assert_eq!((domain(&groom, "curl"), floats(&groom, "curl")), (Domain::Groom, &[2.5][..]));
    set(&mut groom, "wind", "1,-2, 3e1", 0).unwrap();
    assert_eq!(vec3s(&groom, "wind"), [Vec3::new(1.0, -2.0, 30.0)]);
    set(&mut groom, names::ROOT_UV, "0.5,0.25~0.25", 0).unwrap();
    assert_eq!(domain(&groom, names::ROOT_UV), Domain::Strand);
    set(&mut groom, "n", "int:-3", 0).unwrap();
    assert_eq!(ints(&groom, "n"), [-3]);
    set(&mut groom, names::GROUP, "2", 0).unwrap();
    assert_eq!(ints(&groom, names::GROUP), [2]);
    set(&mut groom, names::TRANSPARENCY, "int:1", 0).unwrap();
    assert_eq!(floats(&groom, names::TRANSPARENCY), [1.0]);
    set(&mut groom, "width", "0.5", 0).unwrap();
    assert_eq!(floats(&groom, names::RADIUS), [0.25]);
    set(&mut groom, "width", "0.5~0.25", 3).unwrap();
    let by_width = floats(&groom, names::RADIUS).to_vec();
    set(&mut groom, names::RADIUS, "0.25~0.125", 3).unwrap();
    assert_eq!(floats(&groom, names::RADIUS), by_width);
    set(&mut groom, names::COLOR, "0.5~0.5,0.5~0.5,0", 0).unwrap();
    let colors = vec3s(&groom, names::COLOR);
    assert!(colors.iter().all(|c| c.z == 0.0) && colors.iter().any(|c| (c.x - c.y).abs() > 0.1));
}

#[test]
fn what_is_no_value_is_refused() {
    let mut groom = wavy(2, 2);
    let before = groom.clone();
    for text in
        ["", "x", "1,", "1,2,3,4", "nan", "inf", "1~-1", "1~", "~1", "int:1.5", "int:", "1~2~3", "3e38~3e38"]
    {
        let told = set(&mut groom, "a", text, 0).unwrap_err().to_string();
        assert!(told.contains("a~b") && told.contains("int:3"), "{text}: {told}");
    }
    for (name, text, told) in [
        ("id", "1", "one of its own"),
        ("color", "1", "`color` holds float values, expected vec3"),
        ("color", "0,0,1.1", "0 to 1"),
        ("width", "0.1~0.2", "0 or more"),
        ("width", "int:-1", "0 or more"),
        ("melanin", "0.95~0.1", "melanin is 0.95~0.1, expected 0 to 1"),
        ("group", "1.5", "whole number"),
        ("guide", "1~1", "whole number"),
        ("root_uv", "0.5", "expected vec2"),
        ("velocity", "1,2", "expected vec3"),
    ] {
        let error = set(&mut groom, name, text, 0).unwrap_err().to_string();
        assert!(error.contains(told), "{name}={text}: {error}");
    }
    assert_eq!(groom, before);
}

#[test]
fn colours_come_from_the_picture_at_the_root() {
    // Red runs with the columns, green with the rows from the top.
    let pixel = |i: usize| Vec3::new((i % 16) as f32 / 15.0, (i / 16) as f32 / 7.0, 2.0);
    let pixels: Vec<Vec3> = (0..128).map(pixel).collect();
    let mut groom = wavy(100, 2);
    assert!(matches!(
        groom.color_from_texture(&Texture::new(16, &pixels, VAxis::Up).unwrap()),
        Err(GroomError::AttributeMissing { name: "root_uv", .. })
    ));
    // From the first column's centre to the last one's, and rows likewise.
    let inner = |i: usize, n: f32| 0.5 / n + (i as f32 / 9.0) * (1.0 - 1.0 / n);
    let uvs: Vec<Vec2> = (0..100).map(|i| Vec2::new(inner(i % 10, 16.0), inner(i / 10, 8.0))).collect();
    let attribute = Attribute { domain: Domain::Strand, values: Values::Vec2(uvs) };
    groom.set_attribute(names::ROOT_UV, attribute).unwrap();
    for (v_axis, up) in [(VAxis::Up, true), (VAxis::Down, false)] {
        groom.color_from_texture(&Texture::new(16, &pixels, v_axis).unwrap()).unwrap();
        assert_eq!(domain(&groom, names::COLOR), Domain::Strand);
        for (i, color) in vec3s(&groom, names::COLOR).iter().enumerate() {
            let (u, v) = ((i % 10) as f32 / 9.0, (i / 10) as f32 / 9.0);
            let expected = Vec3::new(u, if up { 1.0 - v } else { v }, 1.0);
            assert!(color.distance(expected) < 1e-5, "{i}: {color} {expected}");
        }
    }
}
