//! A table of parameters and directions in, values out: how anyone compares us with another renderer.
//!
//! # Columns in
//!
//! CSV with one line of headings; the order is free, what is missing takes its default ([`COLUMNS`]).
//! Directions point away from the fibre; phi is the azimuth of the light less that of the viewer. A column `set`
//! may name rows; the answers of another renderer (`f_r`, `f_g`, `f_b`, `pdf`, `exact_r`, `exact_g`, `exact_b`)
//! may stand there for [`compare`](crate::compare).
//!
//! # Columns out
//!
//! Those of the input as they are, then for each of `f32` and `f64`: `f32_r`, `f32_g`, `f32_b` (f cos(theta_i), all
//! lobes), `f32_pdf` (per steradian), and each lobe, `f32_R_r` .. `f32_scattered_b`. Numbers are the shortest that
//! read back to the same bits. The columns of `f64` are empty where a model has no such path.

mod answer;
mod columns;
mod row;

pub use answer::{Answer, Answers, Both};
pub use columns::{COLUMNS, Column};
pub use row::{Reference, Row, Tilt, rows};

use std::io::{Read, Write};

use fibre_scattering::Lobe;

use crate::error::VerificationError;

/// Reads a table and writes it with its answers; returns how many rows there were.
///
/// # Errors
/// [`VerificationError`] names the line and the column of the first fault; nothing useful was written then.
pub fn eval(input: impl Read, output: impl Write, tilt: Tilt) -> Result<u64, VerificationError> {
    let (headings, rows) = rows(input, tilt)?;
    let mut writer = csv::Writer::from_writer(output);
    let mut head: Vec<String> = headings.iter().map(str::to_owned).collect();
    for path in ["f32", "f64"] {
        head.extend(["r", "g", "b", "pdf"].map(|what| format!("{path}_{what}")));
        for lobe in Lobe::ALL {
            head.extend(["r", "g", "b"].map(|channel| format!("{path}_{}_{channel}", lobe.name())));
        }
    }
    writer.write_record(&head)?;
    let mut answers = Answers::default();
    for row in &rows {
        let answer = answers.of(row)?;
        let mut record: Vec<String> = row.cells.iter().map(str::to_owned).collect();
        record.extend(answer.single.numbers().map(|x| shortest(x as f32)));
        match answer.double {
            Some(double) => record.extend(double.numbers().map(shortest)),
            None => record.extend(std::iter::repeat_n(String::new(), 19)),
        }
        writer.write_record(&record)?;
    }
    writer.flush().map_err(csv::Error::from)?;
    Ok(rows.len() as u64)
}

/// The shortest decimal that reads back to the same bits.
fn shortest<F: zmij::Float>(x: F) -> String {
    zmij::Buffer::new().format(x).to_owned()
}
