//! What the model says of a row.

use fibre_scattering::FurParameters;

use super::row::Row;
use crate::error::VerificationError;
use crate::scatterer::{Model, direction, narrow};
use crate::subject::Subject;

/// Values of one precision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Answer {
    /// f cos(theta_i), per lobe and channel.
    pub lobes: [[f64; 3]; 5],
    /// Density per steradian.
    pub pdf: f64,
}

impl Answer {
    /// All lobes, per channel.
    #[must_use]
    pub fn total(&self) -> [f64; 3] {
        [0, 1, 2].map(|channel| self.lobes.iter().map(|lobe| lobe[channel]).sum())
    }

    /// Total, density and lobes, in the order of the columns.
    pub(super) fn numbers(&self) -> impl Iterator<Item = f64> {
        self.total().into_iter().chain([self.pdf]).chain(self.lobes.into_iter().flatten())
    }
}

/// Both precisions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Both {
    /// What a renderer gets. The direction is rounded to single precision, too.
    pub single: Answer,
    /// The same in double precision, where there is such a path.
    pub double: Option<Answer>,
}

/// Answers rows, keeping the last material: rows of one stand together.
#[derive(Debug, Default)]
pub struct Answers {
    last: Option<(FurParameters, Subject)>,
}

impl Answers {
    /// The answer to a row.
    ///
    /// # Errors
    /// [`VerificationError`] where the table of a medulla cannot be had.
    pub fn of(&mut self, row: &Row) -> Result<Both, VerificationError> {
        if self.last.as_ref().is_none_or(|(parameters, _)| *parameters != row.parameters) {
            let fault = |fault| VerificationError::Row { line: row.line, fault: Box::new(fault) };
            let subject = Subject::new(&row.parameters, None).map_err(fault)?;
            self.last = Some((row.parameters, subject));
        }
        let Some((_, subject)) = &self.last else { return Err(VerificationError::FarFur) };
        let wo = direction(row.outgoing.0, row.outgoing.1);
        let wi = direction(row.incoming.0, row.outgoing.1 + row.incoming.1);
        let scatter = subject.bcsdf().at(narrow(wo), row.h as f32, subject.absorption());
        let (values, pdf) = scatter.evaluate_with_pdf(narrow(wi));
        let lobes = values.0.map(|value| value.to_array().map(f64::from));
        let single = Answer { lobes, pdf: f64::from(pdf) };
        let double = subject.double_of(wo, row.h, subject.absorption());
        let double = double.map(|double| {
            let (lobes, pdf) = double.evaluate_with_pdf(wi);
            Answer { lobes, pdf }
        });
        Ok(Both { single, double })
    }
}
