//! The page of the table of extreme cases.

use error_report::{Curve, Plot, plot_svg};

use super::document::{Document, cell, marked, word};
use super::{figure, report};
use crate::stability::Stability;

/// The table as a page.
pub(crate) fn html(table: &Stability) -> String {
    let mut page = Document::new("Fibre scattering on extreme cases");
    let failed = table.rows.iter().filter(|row| !row.faults.is_empty()).count();
    let words = if table.passes() {
        format!("All {} cases pass.", table.rows.len())
    } else {
        format!("{failed} of {} cases fail.", table.rows.len())
    };
    page.banner(table.passes(), &words);
    report::checks(&mut page, &table.checks);
    let about = table.about.iter().map(|(key, value)| format!("{key}: {value}"));
    page.note(&about.collect::<Vec<_>>().join("; "));
    plots(&mut page, table);
    for family in table.families() {
        page.heading(family);
        rows(&mut page, table, family);
    }
    page.finish()
}

fn plots(page: &mut Document, table: &Stability) {
    page.heading("Error against run time");
    page.note("Worst relative error of a value in single precision against the same formulas in double, over the time to prepare a fibre and evaluate it once.");
    let labels: Vec<String> = table.rows.iter().map(|row| format!("{}, {}", row.name, row.view)).collect();
    let curves = table.families().into_iter().map(|family| Curve {
        label: family,
        joined: false,
        points: table
            .rows
            .iter()
            .zip(&labels)
            .filter(|(row, _)| row.family == family)
            .filter_map(|(row, label)| Some((label.as_str(), row.evaluate_ns * 1e-9, row.value_error?)))
            .collect(),
    });
    let curves: Vec<Curve<'_>> = curves.filter(|curve| !curve.points.is_empty()).collect();
    page.raw(&plot_svg(&Plot { x_label: "seconds", y_label: "relative error of value", slope: 0.0, curves }));
}

fn rows(page: &mut Document, table: &Stability, family: &str) {
    let optional = |value: Option<f64>| value.map_or("-".to_owned(), figure);
    let rows = table.rows.iter().filter(|row| row.family == family).map(|row| {
        let p = match row.p_again {
            Some(again) => format!("{}, again {}", figure(row.p), figure(again)),
            None => figure(row.p),
        };
        vec![
            word(&row.name),
            word(&row.view),
            marked(if row.faults.is_empty() { "pass" } else { "FAIL" }),
            cell(&optional(row.value_error)),
            cell(&optional(row.pdf_error)),
            cell(&figure(row.energy_error)),
            cell(&figure(row.density_error)),
            cell(&p),
            cell(&row.not_numbers.to_string()),
            cell(&format!("{:.0}", row.evaluate_ns)),
            cell(&format!("{:.0}", row.sample_ns)),
            word(&row.faults.join(", ")),
        ]
    });
    page.table(
        &[
            "case",
            "<view",
            "<verdict",
            "value error",
            "density error",
            "energy error",
            "integral error",
            "chi-square p",
            "odd",
            "evaluate ns",
            "sample ns",
            "<fault",
        ],
        rows,
    );
}
