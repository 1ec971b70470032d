//! `--stability`: how binding and carrying stand meshes that do what no mesh should.

use std::io::{self, Write};

use anyhow::Result;
use command_line::Outcome;
use groom_binding::stability::{StabilityRow, cases};
use serde_json::json;

/// What a row must keep: sizes of the mesh for distances, shares for lengths.
const HEIGHT: f64 = 1e-5;
const LENGTH: f64 = 1e-6;

/// Runs every case and prints the table; found wanting when one is not stood.
pub(crate) fn run(is_json: bool) -> Result<Outcome> {
    let rows = cases()?.iter().map(|case| case.run()).collect::<Result<Vec<_>, _>>()?;
    let mut stdout = io::stdout().lock();
    if is_json {
        let rows: Vec<_> = rows
            .iter()
            .map(|row| {
                json!({
                    "case": row.case,
                    "strands": row.strands,
                    "poses": row.poses,
                    "height_error": row.height_error,
                    "length_error": row.length_error,
                    "rounded_length_error": row.rounded_length_error,
                    "misplaced": row.misplaced,
                    "not_finite": row.not_finite,
                    "flips": row.flips,
                    "held": row.held,
                    "stood": is_stood(row),
                })
            })
            .collect();
        writeln!(stdout, "{}", serde_json::to_string_pretty(&rows)?)?;
    } else {
        writeln!(
            stdout,
            "{:<44} {:>7} {:>5}  {:>8} {:>8} {:>9} {:>5} {:>5} {:>6}  stood",
            "case", "strands", "poses", "height", "length", "misplaced", "nan", "flips", "held"
        )?;
        for row in &rows {
            let misplaced = row.misplaced.map_or_else(|| "-".to_owned(), |part| format!("{part:.1e}"));
            writeln!(
                stdout,
                "{:<44} {:>7} {:>5}  {:>8.1e} {:>8.1e} {misplaced:>9} {:>5} {:>5} {:>6}  {}",
                row.case,
                row.strands,
                row.poses,
                row.height_error,
                row.length_error,
                row.not_finite,
                row.flips,
                row.held,
                if is_stood(row) { "yes" } else { "NO" }
            )?;
        }
        writeln!(
            stdout,
            "\nheight: how far a root is from its bound height, misplaced: how far a point is from where the mesh's \
             motion has it, both in sizes of the mesh; length: change of a segment, as a share; held: times a strand \
             kept its last rotation. Stood: height below {HEIGHT:e}, length below {LENGTH:e}, no nan and no flip."
        )?;
    }
    Ok(if rows.iter().all(is_stood) { Outcome::Good } else { Outcome::Wanting })
}

fn is_stood(row: &StabilityRow) -> bool {
    row.height_error <= HEIGHT && row.length_error <= LENGTH && row.not_finite == 0 && row.flips == 0
}
