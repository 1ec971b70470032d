//! The report: series of points, and JSON.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::{ReportError, csv, html};

/// Name and version of the file format; the number rises when old readers would misread a file.
pub const SCHEMA: &str = "error-report/1";

/// Error figures against cost, ready to be written.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// [`SCHEMA`].
    schema: String,
    /// What was measured, in words.
    pub title: String,
    /// What explains the numbers: machine, threads, command.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub about: BTreeMap<String, String>,
    /// The series, in the order of the legend.
    pub series: Vec<Series>,
}

/// Points that share a method, an error figure and a reference.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Name of the method or run.
    pub label: String,
    /// Name of the error figure, for example `relMSE`. Series of one metric share a plot.
    pub metric: String,
    /// What the error is measured against.
    pub reference: String,
    /// The error should fall as `seconds^-order`: 1 for MSE, 0.5 for RMSE; 0 draws no guide.
    pub order: f64,
    /// Whether the points are one method at rising cost, to be joined by a line.
    pub joined: bool,
    /// The measurements.
    pub points: Vec<Point>,
}

/// One measurement.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// Which setting or case.
    pub label: String,
    /// Samples (a pixel, a strand, ...), where the notion exists.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub samples: Option<f64>,
    /// What it cost, in seconds, at least 0.
    pub seconds: f64,
    /// How wrong it is, in the series' metric, at least 0.
    pub error: f64,
    /// Any other numbers worth a column, at least 0.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub more: BTreeMap<String, f64>,
}

impl Point {
    /// A point with no samples and no further numbers.
    #[must_use]
    pub fn new(label: impl Into<String>, seconds: f64, error: f64) -> Self {
        Point { label: label.into(), samples: None, seconds, error, more: BTreeMap::new() }
    }

    /// The point, with its sample count.
    #[must_use]
    pub fn with_samples(mut self, samples: f64) -> Self {
        self.samples = Some(samples);
        self
    }

    /// The point, with one more named number.
    #[must_use]
    pub fn with(mut self, name: impl Into<String>, value: f64) -> Self {
        self.more.insert(name.into(), value);
        self
    }
}

impl Series {
    /// An empty series of one method at rising cost, whose points a line joins.
    pub fn convergence(
        label: impl Into<String>,
        metric: impl Into<String>,
        reference: impl Into<String>,
        order: f64,
    ) -> Self {
        let (label, metric, reference) = (label.into(), metric.into(), reference.into());
        Series { label, metric, reference, order, joined: true, points: Vec::new() }
    }

    /// An empty series of separate cases, such as the frames of a film.
    pub fn cases(
        label: impl Into<String>,
        metric: impl Into<String>,
        reference: impl Into<String>,
        order: f64,
    ) -> Self {
        Series { joined: false, ..Series::convergence(label, metric, reference, order) }
    }
}

impl Report {
    /// An empty report.
    #[must_use]
    pub fn new(title: impl Into<String>) -> Self {
        Report { schema: SCHEMA.into(), title: title.into(), about: BTreeMap::new(), series: Vec::new() }
    }

    /// The report, with one more line about its origin.
    #[must_use]
    pub fn with_about(mut self, key: impl Into<String>, value: impl Into<String>) -> Self {
        self.about.insert(key.into(), value.into());
        self
    }

    /// The report, with one more series.
    #[must_use]
    pub fn with_series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Whether every number is finite and not negative, so that all formats can hold it.
    ///
    /// # Errors
    /// [`ReportError::Point`] names the first that is not.
    pub fn check(&self) -> Result<(), ReportError> {
        for series in &self.series {
            for (index, point) in series.points.iter().enumerate() {
                let named = [
                    ("seconds", Some(point.seconds)),
                    ("error", Some(point.error)),
                    ("samples", point.samples),
                ];
                let named = named.into_iter().filter_map(|(name, value)| Some((name, value?)));
                let more = point.more.iter().map(|(name, value)| (name.as_str(), *value));
                if let Some((field, found)) = named.chain(more).find(|(_, v)| !v.is_finite() || *v < 0.0) {
                    let (series, field) = (series.label.clone(), field.to_owned());
                    return Err(ReportError::Point { series, point: index, field, found });
                }
            }
        }
        Ok(())
    }

    /// The report as JSON, ending in a newline.
    ///
    /// # Errors
    /// As [`Report::check`].
    pub fn to_json(&self) -> Result<String, ReportError> {
        self.check()?;
        Ok(serde_json::to_string_pretty(self)? + "\n")
    }

    /// Reads what [`Report::to_json`] wrote.
    ///
    /// # Errors
    /// [`ReportError::Json`] for another layout, [`ReportError::Schema`] for another version,
    /// [`ReportError::Point`] for numbers no report may hold.
    pub fn from_json(text: &str) -> Result<Report, ReportError> {
        let value: serde_json::Value = serde_json::from_str(text)?;
        let schema = value.get("schema").and_then(serde_json::Value::as_str).unwrap_or_default();
        if schema != SCHEMA {
            return Err(ReportError::Schema { found: schema.to_owned() });
        }
        let report: Report = serde_json::from_value(value)?;
        report.check()?;
        Ok(report)
    }

    /// The report as CSV with a header line.
    ///
    /// # Errors
    /// As [`Report::check`].
    pub fn to_csv(&self) -> Result<String, ReportError> {
        self.check()?;
        Ok(csv::write(self))
    }

    /// The report as one self-contained HTML page: no script, no other file, no network.
    ///
    /// # Errors
    /// As [`Report::check`].
    pub fn to_html(&self) -> Result<String, ReportError> {
        self.check()?;
        Ok(html::write(self))
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn other_versions_and_layouts_are_refused() {
        let json = Report::new("x").to_json().unwrap();
        let newer = json.replace("error-report/1", "error-report/2");
        assert!(matches!(Report::from_json(&newer), Err(ReportError::Schema { .. })));
        assert!(matches!(Report::from_json("{}"), Err(ReportError::Schema { .. })));
        assert!(matches!(Report::from_json("{"), Err(ReportError::Json(_))));
        assert!(Report::from_json(&json.replacen('{', "{\"later\": 1,", 1)).is_ok());
    }

    #[test]
    fn numbers_no_file_can_hold_are_named() {
        for (seconds, error, extra, field) in
            [(f64::NAN, 0.0, 0.0, "seconds"), (1.0, -1.0, 0.0, "error"), (1.0, 1.0, f64::INFINITY, "rays")]
        {
            let mut series = Series::cases("s", "m", "r", 1.0);
            series.points.push(Point::new("p", seconds, error).with("rays", extra));
            let report = Report::new("t").with_series(series);
            for result in [report.to_json(), report.to_csv(), report.to_html()] {
                let Err(ReportError::Point { field: found, .. }) = result else { panic!("accepted") };
                assert_eq!(found, field);
            }
        }
    }

    proptest! {
        #[test]
        fn json_keeps_every_bit(
            title in any::<String>(),
            label in any::<String>(),
            numbers in prop::collection::vec((0.0..1e300f64, 0.0..1.0f64, prop::option::of(0.0..1e9f64)), 0..20),
        ) {
            let mut series = Series::convergence(&label, "relMSE", "ref", 1.0);
            for (i, (seconds, error, samples)) in numbers.into_iter().enumerate() {
                series.points.push(Point { samples, ..Point::new(i.to_string(), seconds, error).with("x", error) });
            }
            let report = Report::new(title).with_about("cpu", label).with_series(series);
            let json = report.to_json().unwrap();
            let back = Report::from_json(&json).unwrap();
            prop_assert_eq!(&back, &report);
            prop_assert_eq!(back.to_json().unwrap(), json);
        }
    }
}
