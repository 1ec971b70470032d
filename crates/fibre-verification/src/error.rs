//! Why a verification could not be made.

/// What kept a check from being made. That a check failed is no error: see [`Verdict`](crate::Verdict).
#[derive(Debug, thiserror::Error)]
pub enum VerificationError {
    /// A parameter of the model is out of range.
    #[error(transparent)]
    Scattering(#[from] fibre_scattering::ScatteringError),
    /// The table of a medulla cannot be had.
    #[error(transparent)]
    Table(#[from] medulla_tables::TableError),
    /// A far field of fur was asked for.
    #[error("a medulla that scatters has no far field: leave out the nodes, or the medulla")]
    FarFur,
    /// A table of numbers cannot be read.
    #[error("line {line}, column `{column}`: found `{found}`, expected {expected}")]
    Cell {
        /// Line of the file, from 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// What stands there.
        found: String,
        /// What should.
        expected: &'static str,
    },
    /// A row describes a fibre that cannot be.
    #[error("line {line}: {fault}")]
    Row {
        /// Line of the file, from 1.
        line: u64,
        /// What is wrong with it.
        fault: Box<VerificationError>,
    },
    /// A heading is not known, or is there twice.
    #[error("column `{column}`: {fault}")]
    Heading {
        /// Name of the column.
        column: String,
        /// What is wrong with it.
        fault: String,
    },
    /// The file is no table: quoting, encoding, rows of unequal length.
    #[error(transparent)]
    Csv(#[from] csv::Error),
    /// A report could not be put into JSON.
    #[error(transparent)]
    Json(#[from] serde_json::Error),
    /// Figures for an error-against-time report are not finite.
    #[error(transparent)]
    Report(#[from] error_report::ReportError),
}
