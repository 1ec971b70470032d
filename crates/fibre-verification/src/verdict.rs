//! What a check found.

use serde::Serialize;

/// How a check ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// The law holds.
    Pass,
    /// It does not.
    Fail,
    /// The model does not promise it; the figure is told.
    Told,
    /// It could not be judged, for the reason in the words.
    Unjudged,
}

impl Verdict {
    /// In a word.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Pass => "pass",
            Verdict::Fail => "FAIL",
            Verdict::Told => "told",
            Verdict::Unjudged => "unjudged",
        }
    }
}

/// One law and how well it was kept.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Check {
    /// The law, in a few words.
    pub name: String,
    /// Pass or fail, or neither.
    pub verdict: Verdict,
    /// The worst figure found.
    pub figure: f64,
    /// What the figure is.
    pub measure: String,
    /// The bound it was held against; none where nothing is promised.
    pub bound: Option<f64>,
    /// Whether the figure must lie above the bound (a chance) and not below it (an error).
    pub above: bool,
    /// Where the worst was found.
    pub at: String,
    /// How it was measured.
    pub words: String,
}

impl Check {
    /// A check whose figure, an error, must not exceed `bound`. A figure that is no number fails.
    #[must_use]
    pub fn at_most(name: &str, measure: &str, figure: f64, bound: f64) -> Check {
        let verdict = if figure <= bound { Verdict::Pass } else { Verdict::Fail };
        Check { verdict, bound: Some(bound), ..Check::told(name, measure, figure) }
    }

    /// A check whose figure, a chance, must not fall below `bound`. A figure that is no number fails.
    #[must_use]
    pub fn at_least(name: &str, measure: &str, figure: f64, bound: f64) -> Check {
        let verdict = if figure >= bound { Verdict::Pass } else { Verdict::Fail };
        Check { verdict, bound: Some(bound), above: true, ..Check::told(name, measure, figure) }
    }

    /// A figure without a promise.
    #[must_use]
    pub fn told(name: &str, measure: &str, figure: f64) -> Check {
        Check {
            name: name.to_owned(),
            verdict: Verdict::Told,
            figure,
            measure: measure.to_owned(),
            bound: None,
            above: false,
            at: String::new(),
            words: String::new(),
        }
    }

    /// The check, with where its worst was found.
    #[must_use]
    pub fn found_at(mut self, at: impl Into<String>) -> Check {
        self.at = at.into();
        self
    }

    /// The check, with how it was measured.
    #[must_use]
    pub fn because(mut self, words: impl Into<String>) -> Check {
        self.words = words.into();
        self
    }
}

/// The largest of some figures and where it was found; a figure that is no number is the largest of all.
#[must_use]
pub fn worst<A: Clone + Default>(figures: impl IntoIterator<Item = (f64, A)>) -> (f64, A) {
    figures.into_iter().fold((0.0, A::default()), |worst, found| {
        if found.0 > worst.0 || (found.0.is_nan() && !worst.0.is_nan()) { found } else { worst }
    })
}
