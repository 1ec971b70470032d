//! The report as CSV (RFC 4180).

use std::collections::BTreeSet;

use crate::Report;

/// One line a point, under a header line.
pub(crate) fn write(report: &Report) -> String {
    let points = || report.series.iter().flat_map(|series| series.points.iter().map(move |p| (series, p)));
    let more: BTreeSet<&str> = points().flat_map(|(_, p)| p.more.keys()).map(String::as_str).collect();
    let mut text = String::new();
    let fixed = ["series", "metric", "reference", "order", "joined", "point", "samples", "seconds", "error"];
    push_line(&mut text, fixed.into_iter().chain(more.iter().copied()).map(str::to_owned));
    for (series, point) in points() {
        let optional = |value: Option<f64>| value.map_or_else(String::new, |v| v.to_string());
        let fixed = [
            series.label.clone(),
            series.metric.clone(),
            series.reference.clone(),
            series.order.to_string(),
            series.joined.to_string(),
            point.label.clone(),
            optional(point.samples),
            point.seconds.to_string(),
            point.error.to_string(),
        ];
        let more = more.iter().map(|&key| optional(point.more.get(key).copied()));
        push_line(&mut text, fixed.into_iter().chain(more));
    }
    text
}

fn push_line(text: &mut String, fields: impl Iterator<Item = String>) {
    for (i, field) in fields.enumerate() {
        if i > 0 {
            text.push(',');
        }
        if field.contains(['"', ',', '\n', '\r']) {
            text.push('"');
            text.push_str(&field.replace('"', "\"\""));
            text.push('"');
        } else {
            text.push_str(&field);
        }
    }
    text.push_str("\r\n");
}

#[cfg(test)]
mod tests {
    use crate::{Point, Report, Series};

    #[test]
    fn lines_and_quotes_are_as_the_standard_says() {
        let mut series = Series::cases("a, \"b\"", "MSE", "ref", 1.0);
        series.points.push(Point::new("p", 0.25, 1e-9).with_samples(4.0));
        series.points.push(Point::new("two\nlines", 1.0, 0.0).with("rays", 12.0));
        let csv = Report::new("t").with_series(series).to_csv().unwrap();
        assert_eq!(
            csv,
            "series,metric,reference,order,joined,point,samples,seconds,error,rays\r\n\
             \"a, \"\"b\"\"\",MSE,ref,1,false,p,4,0.25,0.000000001,\r\n\
             \"a, \"\"b\"\"\",MSE,ref,1,false,\"two\nlines\",,1,0,12\r\n"
        );
    }
}
