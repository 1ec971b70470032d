//! What can keep a page from being made.

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// A picture has not as many values as its size asks for.
    #[error("frame {frame}: {found} values of {what}, expected {expected} for {width} x {height} pixels")]
    Size {
        /// Its number.
        frame: u32,
        /// Which values.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: u64,
        /// Pixels across.
        width: u32,
        /// Pixels down.
        height: u32,
    },
    /// There is no such variant on the page.
    #[error("variant {found}: the page has {count}")]
    Variant {
        /// Its place, from 0.
        found: usize,
        /// How many there are.
        count: usize,
    },
    /// A picture could not be encoded.
    #[error("a picture cannot be encoded: {0}")]
    Encode(#[from] image::ImageError),
    /// The error report has values that no plot can show.
    #[error(transparent)]
    Report(#[from] error_report::ReportError),
    /// The page's data could not be written down.
    #[error("the page's data cannot be written: {0}")]
    Json(#[from] serde_json::Error),
    /// The page could not be put in its place.
    #[error(transparent)]
    WholeFile(#[from] whole_file::WholeFileError),
}
