//! Polar plots: where each lobe sends light around the fibre.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use crate::page::LOBE_COLORS;
use crate::report::LobeCurve;

const SIZE: f64 = 300.0;
const MARGIN: f64 = 30.0;
/// How far the plot stands below the middle, to leave room for its title.
const DOWN: f64 = 10.0;

/// A plot whose areas are shares of the light: the radius is the root of light per radian, drawn so that
/// `reach` (light per radian) touches the rim.
pub(crate) fn svg(title: &str, curve: &LobeCurve, reach: f64) -> String {
    let radius = 0.5 * SIZE - MARGIN;
    let (middle, level) = (0.5 * SIZE, 0.5 * SIZE + DOWN);
    let height = SIZE + DOWN;
    let mut out = format!(
        "<svg viewBox=\"0 0 {SIZE} {height}\" width=\"{SIZE}\" height=\"{height}\" font-size=\"12\" role=\"img\" aria-label=\"{title}\">\n"
    );
    let _ = writeln!(
        out,
        "<text x=\"{middle}\" y=\"12\" text-anchor=\"middle\" font-size=\"13\" font-weight=\"600\">{title}</text>"
    );
    for share in [0.25, 0.5, 1.0] {
        let r = radius * f64::sqrt(share);
        let _ = writeln!(
            out,
            "<circle stroke=\"#ddd\" fill=\"none\" cx=\"{middle}\" cy=\"{level}\" r=\"{r:.1}\"/>"
        );
    }
    for step in 0..12 {
        let (sin, cos) = (TAU * f64::from(step) / 12.0).sin_cos();
        let (x, y) = (middle + radius * cos, level - radius * sin);
        let _ = writeln!(
            out,
            "<line stroke=\"#eee\" x1=\"{middle}\" y1=\"{level}\" x2=\"{x:.1}\" y2=\"{y:.1}\"/>"
        );
        if step % 3 == 0 {
            let (x, y) = (middle + (radius + 13.0) * cos, level - (radius + 11.0) * sin + 4.0);
            let degrees = if step > 6 { 30 * step - 360 } else { 30 * step };
            let _ = writeln!(
                out,
                "<text fill=\"#666\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"middle\" font-size=\"10\">{degrees}°</text>"
            );
        }
    }
    for (lobe, color) in curve.lobes.iter().zip(LOBE_COLORS) {
        if lobe.iter().all(|&value| value <= 0.0) {
            continue;
        }
        let mut path = String::new();
        for (degrees, value) in curve.angles.iter().zip(lobe) {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let r = radius * (value.max(0.0) / reach).sqrt().min(1.0);
            let _ = write!(path, "{:.1},{:.1} ", middle + r * cos, level - r * sin);
        }
        let _ = writeln!(
            out,
            "<polygon points=\"{}\" fill=\"{color}\" fill-opacity=\"0.13\" stroke=\"{color}\" stroke-width=\"1.3\" stroke-linejoin=\"round\"/>",
            path.trim_end()
        );
    }
    // Where the viewer stands.
    let _ = writeln!(
        out,
        "<path stroke=\"#222\" fill=\"none\" d=\"M{:.1} {level}h18m-6 -4l6 4l-6 4\"/>",
        middle + radius - 20.0
    );
    out.push_str("</svg>\n");
    out
}
