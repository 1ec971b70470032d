//! What the check says.

use std::fmt;

use serde::Deserialize;

/// Something that a validator of usd-core or a rule of ours finds wrong with a stage.
#[derive(Clone, Debug, PartialEq, Eq, Deserialize)]
pub struct Finding {
    /// How bad it is.
    pub severity: Severity,
    /// Who found it.
    pub rule: String,
    /// A path in the stage.
    pub place: String,
    /// What was found and what would be right.
    pub message: String,
}

/// How bad a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Readers go wrong.
    Error,
    /// Some readers may.
    Warning,
    /// Good to know.
    Info,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity {
            Severity::Error => "error",
            Severity::Warning => "warning",
            Severity::Info => "info",
        };
        write!(f, "{severity} {} <{}> {}", self.rule, self.place, self.message)
    }
}
