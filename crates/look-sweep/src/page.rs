//! A page that shows the sheets with their captions.

use std::fmt::Write;

use crate::{CellReport, RowReport};

const STYLE: &str = "body{font:15px/1.45 system-ui,sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;\
color:#222;background:#fff}h2{margin-bottom:0}p{margin:.3em 0 .8em}img{width:100%;display:block}\
.row{display:grid;gap:0;text-align:center;font-size:13px}.row small{color:#666;display:block}";

/// An HTML page of rows whose sheets lie beside it as `NAME.png`. `subject` says what they show.
#[must_use]
pub fn page(subject: &str, rows: &[RowReport]) -> String {
    let mut out = format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n<title>Sweeps</title>\n\
         <style>{STYLE}</style>\n</head>\n<body>\n<h1>Sweeps</h1>\n<p>{}</p>\n",
        escaped(subject)
    );
    for row in rows {
        section(&mut out, row);
    }
    out.push_str("</body>\n</html>\n");
    out
}

fn section(out: &mut String, row: &RowReport) {
    let figure = row.figure.map(|figure| format!(" <small>(thesis, figure {figure})</small>"));
    // Writing to a string does not fail.
    let _ = write!(
        out,
        "<h2 id=\"{name}\">{}{}</h2>\n<p>{}</p>\n<img src=\"{name}.png\" alt=\"{}\"/>\n\
         <div class=\"row\" style=\"grid-template-columns:repeat({},1fr)\">\n",
        escaped(row.title),
        figure.unwrap_or_default(),
        escaped(row.shows),
        escaped(row.title),
        row.cells.len().max(1),
        name = row.name,
    );
    for cell in &row.cells {
        let _ = writeln!(out, "<div>{}<small>{}</small></div>", escaped(&cell.caption), figures(cell));
    }
    out.push_str("</div>\n");
}

fn figures(cell: &CellReport) -> String {
    let error = cell.relative_error.map(|error| format!(", error {:.1} %", 100.0 * error));
    let [r, g, b] = cell.mean;
    format!("{:.2} s{}, mean {r:.3} {g:.3} {b:.3}", cell.seconds, error.unwrap_or_default())
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
