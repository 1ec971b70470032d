//! A log-log plot as an inline SVG.

use std::fmt::Write as _;

use crate::html::escape;

/// Colours that colour-blind eyes tell apart (Okabe and Ito 2008).
const COLORS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 16.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 48.0;

/// One set of points of a plot.
pub(crate) struct Curve<'a> {
    pub label: &'a str,
    pub joined: bool,
    /// Label, x and y; only points with x > 0 and y > 0 can be drawn.
    pub points: Vec<(&'a str, f64, f64)>,
}

/// What a plot shows.
pub(crate) struct Plot<'a> {
    pub x_label: &'a str,
    pub y_label: &'a str,
    /// Slope of the guide, -1 for MSE over seconds; none when 0.
    pub slope: f64,
    pub curves: Vec<Curve<'a>>,
}

/// Decades that an axis covers, and where it lies on the page.
struct Axis {
    low: i32,
    high: i32,
    start: f64,
    end: f64,
}

impl Axis {
    fn around(values: impl Iterator<Item = f64>, start: f64, end: f64) -> Option<Axis> {
        let (low, high) = values.fold((f64::INFINITY, 0.0_f64), |(low, high), v| (low.min(v), high.max(v)));
        (high > 0.0).then(|| {
            let (low, high) = (low.log10().floor() as i32, high.log10().ceil() as i32);
            Axis { low, high: high.max(low + 1), start, end }
        })
    }

    fn at(&self, value: f64) -> f64 {
        let share = (value.log10() - f64::from(self.low)) / f64::from(self.high - self.low);
        self.start + share * (self.end - self.start)
    }

    /// Decades that get a line: at most about twelve.
    fn ticks(&self) -> impl Iterator<Item = i32> {
        let step = ((self.high - self.low) / 12).max(0) as usize + 1;
        (self.low..=self.high).step_by(step)
    }
}

/// The plot as SVG; a sentence instead when no point can be drawn.
pub(crate) fn svg(plot: &Plot) -> String {
    let drawn = || plot.curves.iter().flat_map(|c| c.points.iter()).filter(|p| p.1 > 0.0 && p.2 > 0.0);
    let x_axis = Axis::around(drawn().map(|p| p.1), LEFT, WIDTH - RIGHT);
    let y_axis = Axis::around(drawn().map(|p| p.2), HEIGHT - BOTTOM, TOP);
    let (Some(x_axis), Some(y_axis)) = (x_axis, y_axis) else {
        return "<p>No point lies above 0 on both axes, so there is nothing to draw.</p>\n".into();
    };
    let mut out = format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" width=\"{WIDTH}\" height=\"{HEIGHT}\" role=\"img\" aria-label=\"{} over {}\">\n",
        escape(plot.y_label),
        escape(plot.x_label)
    );
    push_grid(&mut out, plot, &x_axis, &y_axis);
    if plot.slope != 0.0 {
        push_guide(&mut out, plot.slope, &x_axis, &y_axis);
    }
    for (index, curve) in plot.curves.iter().enumerate() {
        push_curve(&mut out, curve, COLORS[index % COLORS.len()], &x_axis, &y_axis);
    }
    push_legend(&mut out, &plot.curves);
    out.push_str("</svg>\n");
    let hidden = plot.curves.iter().map(|c| c.points.len()).sum::<usize>() - drawn().count();
    if hidden > 0 {
        let _ = writeln!(
            out,
            "<p>{hidden} point(s) with a 0 have no place on logarithmic axes; see the table.</p>"
        );
    }
    out
}

fn push_grid(out: &mut String, plot: &Plot, x_axis: &Axis, y_axis: &Axis) {
    let (bottom, right) = (HEIGHT - BOTTOM, WIDTH - RIGHT);
    for decade in x_axis.ticks() {
        let x = x_axis.at(10f64.powi(decade));
        let _ =
            writeln!(out, "<line class=\"grid\" x1=\"{x:.2}\" y1=\"{TOP}\" x2=\"{x:.2}\" y2=\"{bottom}\"/>");
        let y = bottom + 18.0;
        let label = decade_label(decade);
        let _ = writeln!(out, "<text x=\"{x:.2}\" y=\"{y}\" text-anchor=\"middle\">{label}</text>");
    }
    for decade in y_axis.ticks() {
        let y = y_axis.at(10f64.powi(decade));
        let _ =
            writeln!(out, "<line class=\"grid\" x1=\"{LEFT}\" y1=\"{y:.2}\" x2=\"{right}\" y2=\"{y:.2}\"/>");
        let (x, y, label) = (LEFT - 8.0, y + 4.0, decade_label(decade));
        let _ = writeln!(out, "<text x=\"{x}\" y=\"{y:.2}\" text-anchor=\"end\">{label}</text>");
    }
    let (x, y) = ((LEFT + right) / 2.0, HEIGHT - 8.0);
    let _ = writeln!(out, "<text x=\"{x}\" y=\"{y}\" text-anchor=\"middle\">{}</text>", escape(plot.x_label));
    let y = (TOP + bottom) / 2.0;
    let _ = writeln!(
        out,
        "<text x=\"16\" y=\"{y}\" text-anchor=\"middle\" transform=\"rotate(-90 16 {y})\">{}</text>",
        escape(plot.y_label)
    );
}

fn decade_label(decade: i32) -> String {
    if (-3..=4).contains(&decade) { 10f64.powi(decade).to_string() } else { format!("1e{decade}") }
}

/// A dashed line of the expected slope through the middle of the plot, cut at its frame.
fn push_guide(out: &mut String, slope: f64, x_axis: &Axis, y_axis: &Axis) {
    let middle = |axis: &Axis| f64::from(axis.low + axis.high) / 2.0;
    let (x_middle, y_middle) = (middle(x_axis), middle(y_axis));
    let reach_x = f64::from(x_axis.high - x_axis.low) / 2.0;
    let reach_y = f64::from(y_axis.high - y_axis.low) / 2.0 / slope.abs();
    let reach = reach_x.min(reach_y);
    let end = |sign: f64| {
        let (x, y) = (x_middle + sign * reach, y_middle + sign * reach * slope);
        (x_axis.at(10f64.powf(x)), y_axis.at(10f64.powf(y)))
    };
    let ((x1, y1), (x2, y2)) = (end(-1.0), end(1.0));
    let _ = writeln!(
        out,
        "<line class=\"guide\" x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\"><title>slope {slope}</title></line>"
    );
    let _ = writeln!(
        out,
        "<text class=\"note\" x=\"{:.2}\" y=\"{:.2}\">slope {slope}</text>",
        x1 + 6.0,
        y1 + 14.0
    );
}

fn push_curve(out: &mut String, curve: &Curve, color: &str, x_axis: &Axis, y_axis: &Axis) {
    let mut points: Vec<_> = curve.points.iter().filter(|p| p.1 > 0.0 && p.2 > 0.0).collect();
    if curve.joined {
        points.sort_by(|a, b| a.1.total_cmp(&b.1));
        let mut path = String::new();
        for point in &points {
            let _ = write!(path, "{:.2},{:.2} ", x_axis.at(point.1), y_axis.at(point.2));
        }
        let path = path.trim_end();
        let _ = writeln!(
            out,
            "<polyline points=\"{path}\" fill=\"none\" stroke=\"{color}\" stroke-width=\"1.5\"/>"
        );
    }
    for (label, x, y) in points {
        let (cx, cy, label) = (x_axis.at(*x), y_axis.at(*y), escape(label));
        let _ = writeln!(
            out,
            "<circle cx=\"{cx:.2}\" cy=\"{cy:.2}\" r=\"3.5\" fill=\"{color}\"><title>{label}: {x:.4e}, {y:.4e}</title></circle>"
        );
    }
}

fn push_legend(out: &mut String, curves: &[Curve]) {
    for (index, curve) in curves.iter().enumerate() {
        let (x, y, color) =
            (WIDTH - RIGHT - 12.0, TOP + 16.0 + 18.0 * index as f64, COLORS[index % COLORS.len()]);
        let label = escape(curve.label);
        let _ = writeln!(out, "<circle cx=\"{x}\" cy=\"{y}\" r=\"4\" fill=\"{color}\"/>");
        let _ =
            writeln!(out, "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{label}</text>", x - 10.0, y + 4.0);
    }
}
