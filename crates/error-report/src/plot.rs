//! A log-log plot as an inline SVG.

use std::fmt::Write as _;

use crate::html::escape;

/// Colours that colour-blind eyes tell apart (Okabe and Ito 2008), then two more.
const COLORS: [&str; 9] =
    ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000", "#8a6d00", "#999999"];
const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 420.0;
const LEFT: f64 = 70.0;
const RIGHT: f64 = 24.0;
const TOP: f64 = 14.0;
const BOTTOM: f64 = 48.0;

/// One set of points of a plot.
#[derive(Debug, Clone)]
pub struct Curve<'a> {
    /// Its name in the legend.
    pub label: &'a str,
    /// Whether a line joins the points.
    pub joined: bool,
    /// Label, x and y; only points with x > 0 and y > 0 can be drawn.
    pub points: Vec<(&'a str, f64, f64)>,
}

/// What a plot shows.
#[derive(Debug, Clone)]
pub struct Plot<'a> {
    /// Below the axis.
    pub x_label: &'a str,
    /// Beside it.
    pub y_label: &'a str,
    /// Slope of the guide, -1 for MSE over seconds; none when 0.
    pub slope: f64,
    /// In the order of the legend.
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

    /// Values that get a line, with their labels: decades, at most about twelve, and where there are
    /// few of them 2 and 5 in between.
    fn ticks(&self) -> Vec<(f64, String)> {
        let decades = self.high - self.low;
        let step = (decades / 12).max(0) as usize + 1;
        let between: &[i32] = if decades <= 2 { &[1, 2, 5] } else { &[1] };
        let all = (self.low..=self.high).step_by(step);
        let all = all.flat_map(|decade| between.iter().map(move |&times| (decade, times)));
        all.filter(|&(decade, times)| decade < self.high || times == 1)
            .map(|(decade, times)| (f64::from(times) * 10f64.powi(decade), tick_label(decade, times)))
            .collect()
    }
}

/// The plot as SVG; a sentence instead when no point can be drawn.
#[must_use]
pub fn svg(plot: &Plot) -> String {
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
    for (value, label) in x_axis.ticks() {
        let x = x_axis.at(value);
        let _ =
            writeln!(out, "<line class=\"grid\" x1=\"{x:.2}\" y1=\"{TOP}\" x2=\"{x:.2}\" y2=\"{bottom}\"/>");
        let y = bottom + 18.0;
        let _ = writeln!(out, "<text x=\"{x:.2}\" y=\"{y}\" text-anchor=\"middle\">{label}</text>");
    }
    for (value, label) in y_axis.ticks() {
        let y = y_axis.at(value);
        let _ =
            writeln!(out, "<line class=\"grid\" x1=\"{LEFT}\" y1=\"{y:.2}\" x2=\"{right}\" y2=\"{y:.2}\"/>");
        let (x, y) = (LEFT - 8.0, y + 4.0);
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

fn tick_label(decade: i32, times: i32) -> String {
    match decade {
        0..=4 => format!("{times}{}", "0".repeat(decade as usize)),
        -3..0 => format!("0.{}{times}", "0".repeat(-decade as usize - 1)),
        _ => format!("{times}e{decade}"),
    }
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
        y1 - 4.0
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
        // Square, so that nobody takes it for a measurement.
        let (left, top) = (x - 5.0, y - 5.0);
        let _ = writeln!(out, "<rect x=\"{left}\" y=\"{top}\" width=\"10\" height=\"10\" fill=\"{color}\"/>");
        let _ =
            writeln!(out, "<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{label}</text>", x - 10.0, y + 4.0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_axes_have_lines_between_decades() {
        let labels = |low: f64, high: f64| -> Vec<String> {
            let axis = Axis::around([low, high].into_iter(), 0.0, 1.0).unwrap();
            axis.ticks().into_iter().map(|(_, label)| label).collect()
        };
        assert_eq!(labels(0.02, 0.7), ["0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"]);
        assert_eq!(labels(3.0, 4.0), ["1", "2", "5", "10"]);
        assert_eq!(labels(1e-5, 2.0), ["1e-5", "1e-4", "0.001", "0.01", "0.1", "1", "10"]);
        assert!(labels(1e-300, 1e300).len() < 20);
    }

    #[test]
    fn points_stand_where_their_ticks_say() {
        let axis = Axis::around([1.0, 100.0].into_iter(), 10.0, 50.0).unwrap();
        let at: Vec<f64> = [1.0, 10.0, 100.0].iter().map(|&v| axis.at(v)).collect();
        assert_eq!(at, [10.0, 30.0, 50.0]);
        for (value, label) in axis.ticks() {
            assert!((value - label.parse::<f64>().unwrap()).abs() < 1e-12 * value);
        }
    }
}
