//! Line charts with plain axes.

use std::fmt::Write as _;

use error_report::escape;

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 300.0;
const LEFT: f64 = 56.0;
const RIGHT: f64 = 16.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 44.0;

/// One line of a chart.
pub(crate) struct Line<'a> {
    pub label: &'a str,
    pub color: &'a str,
    pub points: Vec<(f64, f64)>,
    /// Whether the area below is tinted.
    pub filled: bool,
}

/// What a chart shows.
pub(crate) struct Chart<'a> {
    /// Whether heights are roots, so that small values are seen beside large ones.
    pub root: bool,
    pub x_label: &'a str,
    pub y_label: &'a str,
    pub x: (f64, f64),
    pub x_step: f64,
    pub lines: Vec<Line<'a>>,
}

impl Chart<'_> {
    /// The chart as SVG; the vertical axis begins at 0.
    pub fn svg(&self) -> String {
        let highest = self.lines.iter().flat_map(|line| &line.points).map(|point| point.1);
        let highest = highest.filter(|y| y.is_finite()).fold(0.0, f64::max);
        let step = nice_step(highest);
        let top = (highest / step).ceil().max(1.0) * step;
        let at_x = |x: f64| LEFT + (x - self.x.0) / (self.x.1 - self.x.0) * (WIDTH - LEFT - RIGHT);
        let share = |y: f64| if self.root { (y / top).max(0.0).sqrt() } else { y / top };
        let at_y = |y: f64| (HEIGHT - BOTTOM) - share(y) * (HEIGHT - BOTTOM - TOP);
        let mut out = format!(
            "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" font-size=\"12\" role=\"img\" aria-label=\"{} over {}\">\n",
            escape(self.y_label),
            escape(self.x_label)
        );
        let (bottom, right) = (HEIGHT - BOTTOM, WIDTH - RIGHT);
        let count = (top / step).round() as u32;
        let small = if self.root { vec![0.02 * step, 0.2 * step] } else { Vec::new() };
        for value in (0..=count).map(|i| step * f64::from(i)).chain(small) {
            let y = at_y(value);
            let _ = writeln!(
                out,
                "<line stroke=\"#ddd\" x1=\"{LEFT}\" y1=\"{y:.1}\" x2=\"{right}\" y2=\"{y:.1}\"/>"
            );
            let label = short(value);
            let _ = writeln!(
                out,
                "<text x=\"{}\" y=\"{:.1}\" text-anchor=\"end\">{label}</text>",
                LEFT - 7.0,
                y + 4.0
            );
        }
        let mut x = (self.x.0 / self.x_step).ceil() * self.x_step;
        while x <= self.x.1 + 1e-9 {
            let place = at_x(x);
            let _ = writeln!(
                out,
                "<line stroke=\"#ddd\" x1=\"{place:.1}\" y1=\"{TOP}\" x2=\"{place:.1}\" y2=\"{bottom}\"/>\n<text x=\"{place:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
                bottom + 16.0,
                short(x)
            );
            x += self.x_step;
        }
        let (x, y) = (0.5 * (LEFT + right), 0.5 * (TOP + bottom));
        let _ = writeln!(
            out,
            "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\">{}</text>",
            HEIGHT - 8.0,
            escape(self.x_label)
        );
        let _ = writeln!(
            out,
            "<text x=\"14\" y=\"{y:.1}\" text-anchor=\"middle\" transform=\"rotate(-90 14 {y:.1})\">{}</text>",
            escape(self.y_label)
        );
        for (index, line) in self.lines.iter().enumerate() {
            let color = line.color;
            let drawn = line.points.iter().filter(|point| point.1.is_finite());
            let path: Vec<String> = drawn.map(|&(x, y)| format!("{:.1},{:.1}", at_x(x), at_y(y))).collect();
            let path = path.join(" ");
            if line.filled
                && let (Some(first), Some(last)) = (line.points.first(), line.points.last())
            {
                let (left, end) = (at_x(first.0), at_x(last.0));
                let _ = writeln!(
                    out,
                    "<polygon points=\"{left:.1},{bottom} {path} {end:.1},{bottom}\" fill=\"{color}\" fill-opacity=\"0.13\"/>"
                );
            }
            let _ = writeln!(
                out,
                "<polyline points=\"{path}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\" stroke-linejoin=\"round\"/>"
            );
            let (x, y) = (right - 12.0, TOP + 14.0 + 17.0 * index as f64);
            let _ = writeln!(
                out,
                "<rect x=\"{:.1}\" y=\"{:.1}\" width=\"10\" height=\"10\" fill=\"{color}\"/>\n<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{}</text>",
                x - 5.0,
                y - 5.0,
                x - 10.0,
                y + 4.0,
                escape(line.label)
            );
        }
        out.push_str("</svg>\n");
        out
    }
}

/// 1, 2 or 5 times a power of ten, so that there are about five lines.
fn nice_step(highest: f64) -> f64 {
    if highest <= 0.0 {
        return 1.0;
    }
    let raw = highest / 5.0;
    let power = 10f64.powf(raw.log10().floor());
    let times = [1.0, 2.0, 5.0, 10.0].into_iter().find(|times| times * power >= raw * 0.999);
    times.unwrap_or(10.0) * power
}

/// Without the noise of a sum of steps.
fn short(value: f64) -> String {
    let text = format!("{value:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text.is_empty() || text == "-0" { "0".to_owned() } else { text.to_owned() }
}
