//! What can be wrong with figures and reports.

/// Why a comparison or a report was refused.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReportError {
    /// The two slices do not have one value each for every place.
    #[error(
        "cannot compare {test} values with a reference of {reference}; the lengths must be equal and not 0"
    )]
    Lengths {
        /// Values under test.
        test: usize,
        /// Values of the reference.
        reference: usize,
    },
    /// A value is NaN or infinite, so that no mean exists.
    #[error("value {index} of the {which} is {found}; a figure needs finite values")]
    NotFinite {
        /// `"test"` or `"reference"`.
        which: &'static str,
        /// Where in the slice.
        index: usize,
        /// What stands there.
        found: f32,
    },
    /// A point of a series cannot be stored or plotted.
    #[error("series `{series}`, point {point}: {field} is {found}; expected a finite number of at least 0")]
    Point {
        /// Label of the series.
        series: String,
        /// Index of the point.
        point: usize,
        /// Which number.
        field: String,
        /// What was found.
        found: f64,
    },
    /// The text is no JSON of the expected layout.
    #[error("not an error report: {0}")]
    Json(#[from] serde_json::Error),
    /// The file is of another version.
    #[error("schema is `{found}`; this program reads `error-report/1`")]
    Schema {
        /// What the file says.
        found: String,
    },
}
