//! The report as one self-contained HTML page.

use std::fmt::Write as _;

use crate::plot::{Curve, Plot, svg};
use crate::{Point, Report, Series};

const STYLE: &str = "\
body{font:15px/1.5 system-ui,sans-serif;margin:2rem auto;max-width:60rem;padding:0 1rem;color:#222;background:#fff}\
svg{max-width:100%;height:auto;font-size:12px}\
.grid{stroke:#ddd}.guide{stroke:#888;stroke-dasharray:6 4}.note{fill:#666}\
table{border-collapse:collapse}th,td{padding:.2rem .7rem;border-bottom:1px solid #ddd;text-align:right}\
th:first-child,td:first-child,td.word{text-align:left}dt{font-weight:600}dd{margin:0 0 .3rem 1rem}";

/// Text made safe inside elements and quoted attributes.
///
/// Control characters no HTML or XML page may hold become U+FFFD.
#[must_use]
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\n' | '\t' => out.push(c),
            c if c.is_control() || matches!(c, '\u{fffe}' | '\u{ffff}') => out.push('\u{fffd}'),
            c => out.push(c),
        }
    }
    out
}

/// The page: plots (one a metric, over seconds and over samples), then the table of every point.
pub(crate) fn write(report: &Report) -> String {
    let title = escape(&report.title);
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<title>{title}</title>\n<style>{STYLE}</style>\n</head>\n<body>\n<h1>{title}</h1>\n"
    );
    push_about(&mut out, report);
    let mut metrics: Vec<&str> = Vec::new();
    for series in &report.series {
        if !metrics.contains(&series.metric.as_str()) {
            metrics.push(&series.metric);
        }
    }
    for metric in metrics {
        let series: Vec<&Series> = report.series.iter().filter(|s| s.metric == metric).collect();
        let _ = writeln!(out, "<h2>{}</h2>", escape(metric));
        push_plots(&mut out, metric, &series);
        for series in series {
            push_table(&mut out, series);
        }
    }
    out.push_str("</body>\n</html>\n");
    out
}

fn push_about(out: &mut String, report: &Report) {
    if report.about.is_empty() {
        return;
    }
    out.push_str("<dl>\n");
    for (key, value) in &report.about {
        let _ = writeln!(out, "<dt>{}</dt><dd>{}</dd>", escape(key), escape(value));
    }
    out.push_str("</dl>\n");
}

fn push_plots(out: &mut String, metric: &str, series: &[&Series]) {
    let slope = -series.first().map_or(0.0, |s| s.order);
    let plot = |x_label, x: fn(&Point) -> Option<f64>| {
        let curves = series.iter().map(|series| Curve {
            label: &series.label,
            joined: series.joined,
            points: series.points.iter().filter_map(|p| Some((p.label.as_str(), x(p)?, p.error))).collect(),
        });
        Plot { x_label, y_label: metric, slope, curves: curves.collect() }
    };
    out.push_str(&svg(&plot("seconds", |p| Some(p.seconds))));
    // Samples are worth a second plot only where a method was run at several counts.
    let counts = |s: &Series| s.points.windows(2).any(|w| w[0].samples != w[1].samples);
    if series.iter().any(|s| s.joined && counts(s)) {
        out.push_str(&svg(&plot("samples", |p| p.samples)));
    }
}

fn push_table(out: &mut String, series: &Series) {
    let _ = writeln!(
        out,
        "<h3>{}</h3>\n<p>{} against {}.</p>",
        escape(&series.label),
        escape(&series.metric),
        escape(&series.reference)
    );
    let more: std::collections::BTreeSet<&String> =
        series.points.iter().flat_map(|p| p.more.keys()).collect();
    let _ = write!(
        out,
        "<table>\n<tr><th>point</th><th>samples</th><th>seconds</th><th>{}</th>",
        escape(&series.metric)
    );
    for key in &more {
        let _ = write!(out, "<th>{}</th>", escape(key));
    }
    out.push_str("</tr>\n");
    for point in &series.points {
        let optional = |v: Option<f64>| v.map_or_else(String::new, |v| v.to_string());
        let (label, samples) = (escape(&point.label), optional(point.samples));
        let _ = write!(
            out,
            "<tr><td>{label}</td><td>{samples}</td><td>{:.3}</td><td>{:.4e}</td>",
            point.seconds, point.error
        );
        for &key in &more {
            let _ = write!(out, "<td>{}</td>", optional(point.more.get(key).copied()));
        }
        out.push_str("</tr>\n");
    }
    out.push_str("</table>\n");
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use crate::{Point, Report, Series};

    /// Checks that every element is closed in order and that no attribute or text holds a raw `<`
    /// or an unknown entity; the page is written as well-formed XML on purpose.
    fn assert_well_formed(page: &str) {
        let mut open: Vec<&str> = Vec::new();
        let mut rest = page.strip_prefix("<!DOCTYPE html>\n").expect("doctype");
        while let Some(start) = rest.find('<') {
            assert!(!rest[..start].contains('>'), "stray > in {:?}", &rest[..start]);
            assert_entities(&rest[..start]);
            let end = rest[start..].find('>').expect("an element without end") + start;
            let element = &rest[start + 1..end];
            assert!(!element.contains('<'), "raw < inside <{element}>");
            assert_eq!(element.matches('"').count() % 2, 0, "odd quotes in <{element}>");
            assert_entities(element);
            let name = element.trim_start_matches('/').split([' ', '/']).next().unwrap();
            assert!(name.chars().all(|c| c.is_ascii_alphanumeric()), "element name {name:?}");
            if element.starts_with('/') {
                assert_eq!(open.pop(), Some(name));
            } else if !element.ends_with('/') {
                open.push(name);
            }
            rest = &rest[end + 1..];
        }
        assert!(open.is_empty(), "left open: {open:?}");
    }

    fn assert_entities(text: &str) {
        for (i, _) in text.match_indices('&') {
            let entity = &text[i..];
            assert!(
                ["&amp;", "&lt;", "&gt;", "&quot;", "&#39;"].iter().any(|e| entity.starts_with(e)),
                "{entity}"
            );
        }
    }

    fn report(label: &str, values: &[(f64, f64)]) -> Report {
        let mut line = Series::convergence(label, "relMSE", label, 1.0);
        let mut dots = Series::cases("frames", "RMSE", "itself", 0.5);
        for (i, &(seconds, error)) in values.iter().enumerate() {
            line.points.push(Point::new(label, seconds, error).with_samples(i as f64 + 1.0));
            dots.points.push(Point::new("f", seconds, error).with(label, 1.0));
        }
        Report::new(label).with_about(label, label).with_series(line).with_series(dots)
    }

    #[test]
    fn the_page_is_whole_and_holds_every_part() {
        let page = report("a <b> & \"c\"", &[(0.1, 1e-2), (1.0, 1e-3), (10.0, 0.0)]).to_html().unwrap();
        assert_well_formed(&page);
        assert!(!page.contains("<b>"));
        for part in
            ["class=\"guide\"", "<polyline", "<circle", "slope -1", "slope -0.5", "<table>", "have no place"]
        {
            assert!(page.contains(part), "no {part}");
        }
        assert!(!page.contains("http") && !page.contains("<script"), "the page must stand alone");
    }

    #[test]
    fn a_slope_of_minus_one_lies_along_the_guide() {
        // Two points whose error falls tenfold as the time rises tenfold.
        let page = report("x", &[(1.0, 1e-2), (10.0, 1e-3)]).to_html().unwrap();
        let line = page.lines().find(|l| l.starts_with("<polyline")).unwrap();
        let points: Vec<f64> =
            line.split('"').nth(1).unwrap().split([' ', ',']).map(|n| n.parse().unwrap()).collect();
        let guide = page.lines().find(|l| l.contains("class=\"guide\"")).unwrap();
        let ends: Vec<f64> = guide.split('"').filter_map(|n| n.parse().ok()).collect();
        let slope = |p: &[f64]| (p[3] - p[1]) / (p[2] - p[0]);
        assert!((slope(&points) - slope(&ends)).abs() < 1e-3, "{points:?} {ends:?}");
    }

    #[test]
    fn empty_and_unplottable_reports_have_a_page() {
        assert_well_formed(&Report::new("nothing").to_html().unwrap());
        assert_well_formed(&report("zero", &[(0.0, 0.0)]).to_html().unwrap());
        assert_well_formed(&report("extreme", &[(1e-300, 1e300), (1e300, 1e-300)]).to_html().unwrap());
    }

    proptest! {
        #[test]
        fn no_label_breaks_the_page(label in any::<String>(), values in prop::collection::vec((0.0..1e3f64, 0.0..1.0f64), 0..8)) {
            let report = report(&label, &values);
            let page = report.to_html().unwrap();
            assert_well_formed(&page);
            prop_assert_eq!(page, report.to_html().unwrap());
        }
    }
}
